#include "trajet/law/measure.hpp"

#include <cmath>
#include <tuple>
#include <vector>

#include "syntax.hpp"

namespace trajet {
namespace {

using detail::Operation;
using detail::SyntaxNode;
using Kind = Measure::Kind;

/// 2, 1/2, 3/4, 10, pi: numbers of geometry and of series. What has more digits may be a constant of nature.
bool is_factor(const SyntaxNode& number) {
  constexpr double kLargest = 16.0;
  const double quarters = 4.0 * number.value.value;
  return number.text == "pi" || (quarters == std::floor(quarters) && quarters <= 4.0 * kLargest);
}

/// The number of a literal with or without sign; not-a-number if it is anything else.
double literal(const SyntaxNode& node) {
  if (node.kind == SyntaxNode::Kind::number && !node.dimension) return node.value.value;
  const bool is_negated = node.kind == SyntaxNode::Kind::operation && node.operation == Operation::negate;
  return is_negated ? -literal(node.children[0]) : std::nan("");
}

/// Where a formula begins.
SourceLocation begin_of(const SyntaxNode& node) {
  SourceLocation begin = node.where;
  for (const SyntaxNode& child : node.children) {
    const SourceLocation place = begin_of(child);
    if (std::tie(place.line, place.column) < std::tie(begin.line, begin.column)) begin = place;
  }
  return begin;
}

/// Finds dimensions from the leaves of a syntax tree up.
class Surveyor {
 public:
  explicit Surveyor(const MeasureOfName& names) : names_(names) {}

  Measure measure(const SyntaxNode& node) const {
    switch (node.kind) {
      case SyntaxNode::Kind::number:
        return number(node);
      case SyntaxNode::Kind::name:
        return names_(node.text);
      case SyntaxNode::Kind::vector:
      case SyntaxNode::Kind::operation:
        break;
    }
    std::vector<Measure> parts;
    for (const SyntaxNode& child : node.children) parts.push_back(measure(child));
    return node.kind == SyntaxNode::Kind::vector ? alike(node, parts) : operation(node, parts);
  }

 private:
  static Measure number(const SyntaxNode& node) {
    if (!node.dimension) return {.kind = is_factor(node) ? Kind::factor : Kind::any};
    Measure result = Measure::known(*node.dimension, true);
    result.is_frequency = *node.dimension == kFrequency;
    return result;
  }

  static Measure operation(const SyntaxNode& node, const std::vector<Measure>& parts) {
    switch (node.operation) {
      case Operation::negate:
      case Operation::abs:
      case Operation::floor:
      case Operation::norm:
        return parts[0];
      case Operation::add:
      case Operation::subtract:
      case Operation::min:
      case Operation::max:
        return alike(node, parts);
      case Operation::where:
        return alike(node, {parts[1], parts[2]});
      case Operation::multiply:
      case Operation::dot:
      case Operation::cross:
        return times(node, parts[0], parts[1]);
      case Operation::divide:
        return divided(parts[0], parts[1]);
      case Operation::power:
      case Operation::pow:
        return power(node, parts[0], parts[1]);
      case Operation::sqrt:
        return root(parts[0], 2);
      case Operation::cbrt:
        return root(parts[0], 3);
      case Operation::table:
        return {};
      case Operation::sign:
      case Operation::unit:
      case Operation::logical_and:
      case Operation::logical_or:
      case Operation::logical_not:
        return pure(parts);
      case Operation::atan2:
      case Operation::less:
      case Operation::less_equal:
      case Operation::greater:
      case Operation::greater_equal:
      case Operation::equal:
      case Operation::not_equal:
        alike(node, parts);
        return pure(parts);
      default:
        return of_pure_number(node, parts);
    }
  }

  /// A number without unit that is computed from the parts.
  static Measure pure(const std::vector<Measure>& parts) {
    Measure result = Measure::known(kDimensionless, false);
    for (const Measure& part : parts) result.moves = result.moves || part.moves;
    return result;
  }

  /// What parts of one dimension make together.
  static Measure alike(const SyntaxNode& node, const std::vector<Measure>& parts) {
    Measure result = parts[0];
    for (std::size_t i = 1; i < parts.size(); ++i) result = alike(node, result, parts[i]);
    return result;
  }

  static Measure alike(const SyntaxNode& node, const Measure& a, const Measure& b) {
    if (a.kind != Kind::known && b.kind != Kind::known) return a.kind == Kind::any ? a : b;
    if (a.kind != Kind::known) return b;
    if (b.kind != Kind::known) return a;
    if (interchangeable(a.dimension, b.dimension)) {
      Measure result = a;
      result.is_written = a.is_written || b.is_written;
      result.moves = a.moves || b.moves;
      result.is_frequency = a.is_frequency && b.is_frequency;
      return result;
    }
    if (!a.is_written && !b.is_written) return {};
    const bool is_vector = node.kind == SyntaxNode::Kind::vector;
    throw InputError(node.where, (is_vector ? "the components of a vector" : "what '" + node.text + "' takes") +
                                     " must have one dimension, got " + describe(a.dimension) + " and " +
                                     describe(b.dimension));
  }

  /// A factor leaves constants what they are; beside what moves it may be a constant of the law.
  static Measure scaled(Measure a) {
    if (a.kind == Kind::known && (a.moves || !a.is_written)) return {};
    a.is_frequency = false;
    return a;
  }

  static Measure times(const SyntaxNode& node, const Measure& a, const Measure& b) {
    if (a.kind == Kind::any || b.kind == Kind::any) return {};
    if (b.kind == Kind::factor) {
      // an axis only gives a direction: f*[0, 0, 1]
      const bool is_direction = node.children[1].kind == SyntaxNode::Kind::vector;
      return is_direction && a.is_frequency ? a : scaled(a);
    }
    if (a.kind == Kind::factor) return scaled(b);
    return combined(a, b, 1);
  }

  static Measure divided(const Measure& a, const Measure& b) {
    if (a.kind == Kind::any || b.kind == Kind::any) return {};
    if (b.kind == Kind::factor) return scaled(a);
    if (a.kind == Kind::factor && (b.moves || !b.is_written)) return {};
    return combined(a.kind == Kind::factor ? Measure::known(kDimensionless, false) : a, b, -1);
  }

  static Measure combined(const Measure& a, const Measure& b, int power) {
    Measure result = Measure::known(product(a.dimension, b.dimension, power), a.is_written || b.is_written);
    result.moves = a.moves || b.moves;
    return result;
  }

  static Measure root(const Measure& a, int degree) { return raised(a, 1, degree); }

  static Measure raised(const Measure& a, int numerator, int denominator) {
    if (a.kind != Kind::known) return a;
    const auto dimension = power_of(a.dimension, numerator, denominator);
    if (!dimension) return {};
    Measure result = Measure::known(*dimension, a.is_written);
    result.moves = a.moves;
    return result;
  }

  static Measure power(const SyntaxNode& node, const Measure& base, const Measure& exponent) {
    if (exponent.contradicts(kDimensionless) && !exponent.moves)
      throw InputError(begin_of(node.children[1]),
                       "an exponent is a number without unit, got " + describe(exponent.dimension));
    constexpr double kLargest = 12.0;
    const double k = literal(node.children[1]);
    for (const int denominator : {1, 2})
      if (std::abs(k) <= kLargest && k * denominator == std::floor(k * denominator))
        return raised(base, static_cast<int>(k * denominator), denominator);
    return {};
  }

  /// Functions that a power series defines. What moves may have left a constant of 1 out: log(1 + t/tau).
  static Measure of_pure_number(const SyntaxNode& node, const std::vector<Measure>& parts) {
    if (parts[0].contradicts(kDimensionless) && !parts[0].moves)
      throw InputError(node.where, "'" + node.text + "' takes a number without unit" +
                                       (is_of_angle(node.operation) ? " or an angle" : "") + ", got " +
                                       describe(parts[0].dimension));
    return pure(parts);
  }

  static bool is_of_angle(Operation operation) {
    return operation == Operation::sin || operation == Operation::cos || operation == Operation::tan;
  }

  const MeasureOfName& names_;
};

}  // namespace

Measure measure(const Expression& formula, const MeasureOfName& names) {
  return Surveyor(names).measure(*formula.tree());
}

std::string dimension_fault(const Measure& measure, const Dimension& expected) {
  if (measure.is_frequency && expected == kAngularVelocity)
    return describe(expected) + " expected, got " + describe(measure.dimension) +
           ": write rev/s where turns are meant, else rad/s";
  if (measure.contradicts(expected)) return describe(expected) + " expected, got " + describe(measure.dimension);
  return {};
}

void require_dimension(const Expression& formula, const Dimension& expected, const MeasureOfName& names) {
  if (formula.numbers().count > 0) return;  // numbers without units are of any dimension
  const Surveyor surveyor(names);
  const std::shared_ptr<const SyntaxNode> tree = formula.tree();
  const SyntaxNode& root = *tree;
  surveyor.measure(root);  // its own contradictions first
  const auto check = [&](const SyntaxNode& node) {
    const std::string fault = dimension_fault(surveyor.measure(node), expected);
    if (!fault.empty()) throw InputError(begin_of(node), fault);
  };
  if (root.kind != SyntaxNode::Kind::vector) return check(root);
  for (const SyntaxNode& component : root.children) check(component);
}

}  // namespace trajet
