#include "trajet/io/variation_text.hpp"

#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "../scene/scene_numbers.hpp"
#include "../scene/scene_symbols.hpp"
#include "formula_text.hpp"
#include "scene_keys.hpp"
#include "trajet/io/scene_overrides.hpp"
#include "trajet/portable.hpp"
#include "trajet/scene/scene_units.hpp"
#include "trajet/text/decimal_number.hpp"
#include "trajet/text/did_you_mean.hpp"
#include "trajet/text/outer_parts.hpp"

namespace trajet {
namespace {

constexpr double kMostOfAxis = 1e15;

/// "1deg" as "1 deg": in a command line a blank costs quotes.
std::string with_unit_apart(const std::string& text) {
  const std::optional<DecimalNumber> number = leading_number(text);
  if (!number || number->length == text.size()) return text;
  const char next = text[number->length];
  const bool is_letter =
      (next >= 'a' && next <= 'z') || (next >= 'A' && next <= 'Z') || next == '%' || (next & 0x80) != 0;
  return is_letter ? text.substr(0, number->length) + " " + text.substr(number->length) : text;
}

/// A name of the scene with what stands behind `=`.
struct Assignment {
  std::string name;
  std::string value;
  SourceLocation where;
};

Assignment split_assignment(const std::string& text, const std::string& option, const std::string& expected) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw InputError({option}, expected + " expected, got '" + text + "'");
  std::string name(trimmed(std::string_view(text).substr(0, equals)));
  std::string value(trimmed(std::string_view(text).substr(equals + 1)));
  SourceLocation where{option + " " + name};
  return {std::move(name), std::move(value), std::move(where)};
}

/// A quantity of the scene, and how texts of its values are read.
class QuantityReader {
 public:
  QuantityReader(const Assignment& assignment, Scene& scene)
      : name_(assignment.name), where_(assignment.where), scene_(scene) {
    if (name_.find('.') != std::string::npos) {
      const detail::SceneKey key = detail::find_key(scene, name_, where_);
      if (!key.set) throw InputError(where_, "'" + name_ + "' is a word: only numbers can be varied");
      dimension_ = key.dimension;
      return;
    }
    const auto parameter = ranges::find(scene.parameters, name_, &NamedExpression::name);
    if (parameter == scene.parameters.end()) {
      std::vector<std::string_view> known;
      for (const NamedExpression& each : scene.parameters) known.push_back(each.name);
      throw InputError(where_, "the scene has no parameter '" + name_ + "'" + did_you_mean(name_, known));
    }
    const Measure measure = parameter_measures(scene).find(name_)->second;
    if (measure.kind == Measure::Kind::known && measure.is_written) dimension_ = measure.dimension;
    asks_for_unit_ = dimension_.has_value() && dimension_ != kDimensionless;
  }

  /// A finite number, SI.
  double number(const std::string& text, const std::string& what) {
    detail::FormulaReader formulas(scene_.file, scene_.tables);
    for (const NamedExpression& parameter : scene_.parameters) formulas.add_name(parameter.name);
    Expression formula = formulas.read(with_unit_apart(text), where_, dimension_);
    const std::map<std::string, Measure, std::less<>> measures = parameter_measures(scene_);
    const Measure measured = measure(formula, [&](std::string_view name) {
      const auto found = measures.find(name);
      return found == measures.end() ? Measure{} : found->second;
    });
    if (dimension_) {
      const std::string fault = dimension_fault(measured, *dimension_);
      if (!fault.empty()) throw InputError(where_, fault);
    } else if (measured.kind == Measure::Kind::known && measured.is_written) {
      dimension_ = measured.dimension;
    }
    if (asks_for_unit_ && measured.kind != Measure::Kind::known) {
      scene_.warnings.push_back(where_.file.str() + ": " + text + " has no unit, where the scene has one: taken as " +
                                describe(*dimension_));
      asks_for_unit_ = false;  // once is enough
    }
    const ParameterSet parameters = evaluate_parameters(scene_);
    return SceneNumbers(parameters.symbols).scalar(formula, what);
  }

  VariedQuantity quantity() const {
    const auto value = [dimension = dimension_, where = where_](double number) {
      return dimension ? Expression::quantity(number, *dimension, where) : Expression::number(number, where);
    };
    if (name_.find('.') != std::string::npos)
      return {name_, [name = name_, where = where_, value](Scene& scene) -> VariedQuantity::Setter {
                const bool is_step = name == "method.step";
                return [set = detail::find_key(scene, name, where).set, value, is_step, &scene](double number) {
                  set(value(number));
                  if (is_step) scene.method.steps.clear();
                };
              }};
    return {name_, [name = name_, value](Scene& scene) -> VariedQuantity::Setter {
              NamedExpression& parameter = *ranges::find(scene.parameters, name, &NamedExpression::name);
              return [&parameter, value](double number) { parameter.value = value(number); };
            }};
  }

 private:
  std::string name_;
  SourceLocation where_;
  Scene& scene_;
  std::optional<Dimension> dimension_;
  bool asks_for_unit_ = false;
};

std::uint64_t count_of(const std::string& text, const SourceLocation& where) {
  const std::optional<double> count = finite_number(text);
  if (!count || *count < 1.0 || *count != std::floor(*count) || *count > kMostOfAxis)
    throw InputError(where, "a whole number of values from 1 on expected, got '" + text + "'");
  return static_cast<std::uint64_t>(*count);
}

}  // namespace

GridAxis read_range(const std::string& text, const std::string& option, Scene& scene) {
  const Assignment assignment = split_assignment(text, option, "NAME=LOW:HIGH:COUNT");
  const std::vector<std::string> ends = outer_parts(assignment.value, ':');
  if (ends.size() < 2 || ends.size() > 3)
    throw InputError(assignment.where, "LOW:HIGH:COUNT expected, got '" + assignment.value + "'");
  QuantityReader reader(assignment, scene);
  GridAxis axis{};
  axis.low = reader.number(ends[0], "low end of '" + assignment.name + "'");
  axis.high = reader.number(ends[1], "high end of '" + assignment.name + "'");
  axis.count = ends.size() == 3 ? count_of(ends[2], assignment.where) : 0;
  axis.quantity = reader.quantity();
  return axis;
}

SampledQuantity read_sample(const std::string& text, const std::string& option, Scene& scene) {
  constexpr std::pair<std::string_view, std::size_t> kKinds[] = {
      {"normal", 2}, {"uniform", 2}, {"lognormal", 2}, {"truncated", 4}};
  const Assignment assignment = split_assignment(text, option, "NAME=normal(MEAN,SD)");
  const SourceLocation& where = assignment.where;
  const std::size_t open = assignment.value.find('(');
  if (open == std::string::npos || assignment.value.back() != ')')
    throw InputError(where,
                     "normal(MEAN,SD), uniform(LOW,HIGH), lognormal(MEAN,SD) or truncated(MEAN,SD,LOW,HIGH) "
                     "expected, got '" +
                         assignment.value + "'");
  const std::string kind(trimmed(std::string_view(assignment.value).substr(0, open)));
  const auto known = ranges::find(kKinds, kind, &std::pair<std::string_view, std::size_t>::first);
  if (known == std::end(kKinds)) {
    std::vector<std::string_view> names;
    for (const auto& [name, count] : kKinds) names.push_back(name);
    throw InputError(where, "unknown distribution '" + kind + "'" + did_you_mean(kind, names));
  }
  const std::vector<std::string> texts =
      outer_parts(std::string_view(assignment.value).substr(open + 1, assignment.value.size() - open - 2), ',');
  if (texts.size() != known->second)
    throw InputError(
        where, kind + " takes " + std::to_string(known->second) + " numbers, got " + std::to_string(texts.size()));
  QuantityReader reader(assignment, scene);
  std::vector<double> numbers;
  for (const std::string& each : texts) numbers.push_back(reader.number(each, "a number of " + kind));
  const bool has_limits = kind == "uniform" || kind == "truncated";
  if (kind != "uniform" && !(numbers[1] > 0.0)) throw InputError(where, "the standard deviation must be positive");
  if (kind == "lognormal" && !(numbers[0] > 0.0))
    throw InputError(where, "the mean of a lognormal quantity must be positive");
  if (has_limits && !(numbers[numbers.size() - 2] < numbers.back()))
    throw InputError(where, "the low end must lie below the high one");
  const Distribution distribution = kind == "normal"    ? Distribution::normal(numbers[0], numbers[1])
                                    : kind == "uniform" ? Distribution::uniform(numbers[0], numbers[1])
                                    : kind == "lognormal"
                                        ? Distribution::lognormal(numbers[0], numbers[1])
                                        : Distribution::truncated(numbers[0], numbers[1], numbers[2], numbers[3]);
  if (kind == "truncated" && !std::isfinite(distribution.quantile(0.5)))
    throw InputError(where, "between the ends lies no part of the normal distribution that numbers can tell from none");
  return {reader.quantity(), distribution};
}

Vector3 read_point(const std::string& text, const std::string& option, const Scene& scene) {
  std::string_view inside = trimmed(text);
  if (inside.size() >= 2 && inside.front() == '[' && inside.back() == ']') inside = inside.substr(1, inside.size() - 2);
  const std::vector<std::string> coordinates = outer_parts(inside, ',');
  const SourceLocation where{option};
  if (coordinates.size() != 3) throw InputError(where, "a point x,y,z expected, got '" + text + "'");
  detail::FormulaReader formulas(scene.file, scene.tables);
  for (const NamedExpression& parameter : scene.parameters) formulas.add_name(parameter.name);
  const ParameterSet parameters = evaluate_parameters(scene);
  Vector3 point;
  for (int i = 0; i < 3; ++i) {
    const std::string& coordinate = coordinates[static_cast<std::size_t>(i)];
    point[i] = SceneNumbers(parameters.symbols)
                   .scalar(formulas.read(with_unit_apart(coordinate), where, kLength), "a coordinate");
  }
  return point;
}

Correlation read_correlation(const std::string& text, const std::string& option,
                             const std::vector<SampledQuantity>& samples) {
  const Assignment assignment = split_assignment(text, option, "NAME,NAME=COEFFICIENT");
  const std::vector<std::string> names = outer_parts(assignment.name, ',');
  if (names.size() != 2 || names[0] == names[1])
    throw InputError({option}, "two sampled quantities expected: NAME,NAME=COEFFICIENT, got '" + text + "'");
  const auto find = [&](const std::string& name) {
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (samples[i].quantity.name == name) return i;
    throw InputError(assignment.where, "'" + name + "' is not sampled");
  };
  const std::optional<double> coefficient = finite_number(assignment.value);
  if (!coefficient || std::abs(*coefficient) > 1.0)
    throw InputError(assignment.where, "a correlation between -1 and 1 expected, got '" + assignment.value + "'");
  return {find(names[0]), find(names[1]), *coefficient};
}

}  // namespace trajet
