#include "trajet/law/program_builder.hpp"

#include <cassert>
#include <utility>

#include "foreign_words.hpp"
#include "graph.hpp"
#include "syntax.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {
namespace detail {
namespace {

using Value = ProgramBuilder::Value;

std::string_view shape(const Value& value) { return value.is_vector ? "a vector" : "a scalar"; }

Value scalar(int node) { return {false, {node, 0, 0}}; }

/// Gives a syntax tree its meaning, node by node.
class Compiler {
 public:
  Compiler(Graph& graph, const Symbols& symbols) : graph_(graph), symbols_(symbols) {}

  Value compile(const SyntaxNode& node) {
    switch (node.kind) {
      case SyntaxNode::Kind::number:
        return scalar(graph_.constant(node.value));
      case SyntaxNode::Kind::name:
        return name(node);
      case SyntaxNode::Kind::vector:
        return vector(node);
      case SyntaxNode::Kind::operation:
        break;
    }
    std::vector<Value> arguments;
    for (const SyntaxNode& child : node.children) arguments.push_back(compile(child));
    return operation(node, arguments);
  }

 private:
  Value name(const SyntaxNode& node) {
    const Symbols::Meaning* meaning = symbols_.find(node.text);
    if (meaning == nullptr) {
      const std::string remedy = remedy_for_name(node.text);
      throw InputError(node.where, "unknown name '" + node.text + "'" +
                                       (remedy.empty() ? did_you_mean(node.text, symbols_.names()) : remedy));
    }
    return std::visit([&](const auto& m) { return bind(node, m); }, *meaning);
  }
  Value bind(const SyntaxNode&, const ExtendedConstant& value) { return scalar(graph_.constant(value)); }
  Value bind(const SyntaxNode&, const Symbols::ConstantVector& v) {
    return {true, {graph_.constant(v[0]), graph_.constant(v[1]), graph_.constant(v[2])}};
  }
  Value bind(const SyntaxNode&, const Symbols::Scalar& s) { return scalar(s.node); }
  Value bind(const SyntaxNode&, const Symbols::Vector& v) { return {true, v.nodes}; }
  Value bind(const SyntaxNode& node, const Symbols::Forbidden& f) { throw InputError(node.where, f.reason); }

  Value vector(const SyntaxNode& node) {
    Value result{true, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const Value component = compile(node.children[i]);
      if (component.is_vector)
        throw InputError(node.children[i].where, "a component of a vector must be a scalar, this is a vector");
      result.nodes[i] = component.nodes[0];
    }
    return result;
  }

  Value operation(const SyntaxNode& node, const std::vector<Value>& arguments) {
    switch (node.operation) {
      case Operation::negate:
        return each(arguments[0], [this](int a) { return graph_.negate(a); });
      case Operation::add:
        return pairwise(node, arguments, [this](int a, int b) { return graph_.add(a, b); });
      case Operation::subtract:
        return pairwise(node, arguments, [this](int a, int b) { return graph_.subtract(a, b); });
      case Operation::multiply:
        return multiply(node, arguments[0], arguments[1]);
      case Operation::divide:
        if (arguments[1].is_vector) fail(node, "the divisor must be a scalar, it is a vector");
        return each(arguments[0], [&](int a) { return graph_.divide(a, arguments[1].nodes[0]); });
      case Operation::where:
        return where(node, arguments);
      case Operation::dot:
        require_vectors(node, arguments);
        return scalar(dot(arguments[0], arguments[1]));
      case Operation::cross:
        require_vectors(node, arguments);
        return cross(arguments[0], arguments[1]);
      case Operation::norm:
        require_vectors(node, arguments);
        return scalar(norm(arguments[0]));
      case Operation::unit:
        require_vectors(node, arguments);
        return each(arguments[0], [&](int a) { return graph_.divide(a, norm(arguments[0])); });
      default:
        return scalar_operation(node, arguments);
    }
  }

  Value scalar_operation(const SyntaxNode& node, const std::vector<Value>& arguments) {
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (arguments[i].is_vector) fail(node, "'" + node.text + "' takes scalars, got a vector" + hint(node.operation));
    }
    const int a = arguments[0].nodes[0];
    const int b = arguments.size() > 1 ? arguments[1].nodes[0] : 0;
    switch (node.operation) {
      case Operation::power:
      case Operation::pow:
        return scalar(graph_.power(a, b));
      case Operation::sqrt:
        return scalar(graph_.sqrt(a));
      case Operation::abs:
        return scalar(graph_.abs(a));
      case Operation::min:
        return fold_left(Opcode::min, arguments);
      case Operation::max:
        return fold_left(Opcode::max, arguments);
      case Operation::table:
        return scalar(table(node, a));
      case Operation::greater:
        return scalar(graph_.compare(Opcode::less, b, a));
      case Operation::greater_equal:
        return scalar(graph_.compare(Opcode::less_equal, b, a));
      case Operation::not_equal:
        return scalar(graph_.subtract(graph_.constant(1.0), graph_.compare(Opcode::equal, a, b)));
      case Operation::less:
        return scalar(graph_.compare(Opcode::less, a, b));
      case Operation::less_equal:
        return scalar(graph_.compare(Opcode::less_equal, a, b));
      case Operation::equal:
        return scalar(graph_.compare(Opcode::equal, a, b));
      case Operation::logical_and:  // a and b: b if a holds, else 0
        return scalar(graph_.where(a, b, graph_.constant(0.0)));
      case Operation::logical_or:  // a or b: 1 if a holds, else b
        return scalar(graph_.where(a, graph_.constant(1.0), b));
      case Operation::logical_not:
        return scalar(graph_.apply(Opcode::equal, a, graph_.constant(0.0)));
      default:
        return scalar(graph_.apply(opcode(node.operation), a, b));
    }
  }

  /// The opcode of an operation that is one instruction.
  static Opcode opcode(Operation operation) {
    switch (operation) {
      case Operation::cbrt:
        return Opcode::cbrt;
      case Operation::exp:
        return Opcode::exp;
      case Operation::log:
        return Opcode::log;
      case Operation::log10:
        return Opcode::log10;
      case Operation::sin:
        return Opcode::sin;
      case Operation::cos:
        return Opcode::cos;
      case Operation::tan:
        return Opcode::tan;
      case Operation::asin:
        return Opcode::asin;
      case Operation::acos:
        return Opcode::acos;
      case Operation::atan:
        return Opcode::atan;
      case Operation::atan2:
        return Opcode::atan2;
      case Operation::sinh:
        return Opcode::sinh;
      case Operation::cosh:
        return Opcode::cosh;
      case Operation::tanh:
        return Opcode::tanh;
      case Operation::sign:
        return Opcode::sign;
      case Operation::floor:
        return Opcode::floor;
      default:
        break;
    }
    assert(false && "an operation that is several instructions");
    return Opcode::add;
  }

  static std::string hint(Operation operation) {
    switch (operation) {
      case Operation::power:
      case Operation::pow:
        return "; the square of a vector is dot(v, v)";
      case Operation::abs:
        return "; the length of a vector is norm(v)";
      default:
        return "";
    }
  }

  template <class F>
  static Value each(const Value& value, const F& f) {
    Value result = value;
    for (std::size_t i = 0; i < (value.is_vector ? 3 : 1); ++i) result.nodes[i] = f(value.nodes[i]);
    return result;
  }

  template <class F>
  Value pairwise(const SyntaxNode& node, const std::vector<Value>& arguments, const F& f) {
    const Value &a = arguments[0], &b = arguments[1];
    if (a.is_vector != b.is_vector) {
      fail(node, "'" + node.text + "' needs two scalars or two vectors, got " + std::string(shape(a)) + " and " +
                     std::string(shape(b)));
    }
    Value result = a;
    for (std::size_t i = 0; i < (a.is_vector ? 3 : 1); ++i) result.nodes[i] = f(a.nodes[i], b.nodes[i]);
    return result;
  }

  Value multiply(const SyntaxNode& node, const Value& a, const Value& b) {
    if (a.is_vector && b.is_vector) fail(node, "'*' of two vectors: write dot(a, b) or cross(a, b)");
    if (b.is_vector) return multiply(node, b, a);
    if (!a.is_vector) return scalar(graph_.multiply(a.nodes[0], b.nodes[0]));
    return each(a, [&](int component) { return component_times(component, b.nodes[0]); });
  }

  /// A component that is 0 has no direction to contribute to: it stays 0 whatever the factor, infinite or not-a-number,
  /// which shows in the other components and in the state that gave it.
  int component_times(int component, int factor) {
    return graph_.is_constant(component, 0.0) ? component : graph_.multiply(component, factor);
  }
  int component_product(int a, int b) { return graph_.is_constant(b, 0.0) ? b : component_times(a, b); }

  int dot(const Value& a, const Value& b) {
    int sum = component_product(a.nodes[0], b.nodes[0]);
    for (std::size_t i = 1; i < 3; ++i) sum = graph_.add(sum, component_product(a.nodes[i], b.nodes[i]));
    return sum;
  }

  Value cross(const Value& a, const Value& b) {
    Value result{true, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      result.nodes[i] =
          graph_.subtract(component_product(a.nodes[j], b.nodes[k]), component_product(a.nodes[k], b.nodes[j]));
    }
    return result;
  }

  int norm(const Value& v) { return graph_.norm(v.nodes[0], v.nodes[1], v.nodes[2]); }

  Value where(const SyntaxNode& node, const std::vector<Value>& arguments) {
    if (arguments[0].is_vector) fail(node, "the condition of 'where' must be a scalar, it is a vector");
    return pairwise(node, {arguments[1], arguments[2]},
                    [&](int then, int otherwise) { return graph_.where(arguments[0].nodes[0], then, otherwise); });
  }

  Value fold_left(Opcode opcode, const std::vector<Value>& arguments) {
    int result = arguments[0].nodes[0];
    for (std::size_t i = 1; i < arguments.size(); ++i) result = graph_.apply(opcode, result, arguments[i].nodes[0]);
    return scalar(result);
  }

  int table(const SyntaxNode& node, int x) {
    const auto table = symbols_.find_table(node.table);
    if (table == nullptr) fail(node, "there is no table '" + node.table + "' here");
    return graph_.table(table, x);
  }

  static void require_vectors(const SyntaxNode& node, const std::vector<Value>& arguments) {
    for (const Value& argument : arguments) {
      if (!argument.is_vector) fail(node, "'" + node.text + "' takes vectors, got a scalar");
    }
  }

  [[noreturn]] static void fail(const SyntaxNode& node, const std::string& message) {
    throw InputError(node.where, message);
  }

  Graph& graph_;
  const Symbols& symbols_;
};

[[noreturn]] void fail_as_vector(const Expression& formula) {
  constexpr std::size_t kLongest = 40;  // what one reads at a glance
  const std::string component = formula.text().size() <= kLongest ? formula.text() : "…";
  throw InputError(formula.where(),
                   "a vector is expected, this is a scalar: write its direction too, [0, 0, " + component + "]");
}

}  // namespace
}  // namespace detail

ProgramBuilder::ProgramBuilder(int input_count) : graph_(std::make_unique<detail::Graph>(input_count)) {}
ProgramBuilder::ProgramBuilder(const Program& base) : graph_(std::make_unique<detail::Graph>(base)) {}
ProgramBuilder::~ProgramBuilder() = default;
ProgramBuilder::ProgramBuilder(ProgramBuilder&&) noexcept = default;
ProgramBuilder& ProgramBuilder::operator=(ProgramBuilder&&) noexcept = default;

ProgramBuilder::Value ProgramBuilder::compile(const Expression& formula, const Symbols& symbols) {
  return detail::Compiler(*graph_, symbols).compile(*formula.tree());
}

ProgramBuilder::Value ProgramBuilder::compile_scalar(const Expression& formula, const Symbols& symbols) {
  const Value value = compile(formula, symbols);
  if (value.is_vector) throw InputError(formula.where(), "a scalar is expected, this is a vector");
  return value;
}

ProgramBuilder::Value ProgramBuilder::compile_vector(const Expression& formula, const Symbols& symbols) {
  const Value value = compile(formula, symbols);
  if (!value.is_vector) detail::fail_as_vector(formula);
  return value;
}

ProgramBuilder::Value ProgramBuilder::inputs(const std::array<int, 3>& indices) const { return {true, indices}; }
int ProgramBuilder::clock(double epoch) { return graph_->clock(epoch); }
ProgramBuilder::Value ProgramBuilder::constant(double value) { return {false, {graph_->constant(value), 0, 0}}; }

ProgramBuilder::Value ProgramBuilder::divide(const Value& numerator, const Value& denominator) {
  assert(!denominator.is_vector);
  Value result = numerator;
  for (int& node : result.nodes) node = graph_->divide(node, denominator.nodes[0]);
  return result;
}

int ProgramBuilder::constant_node(const ExtendedConstant& value) { return graph_->constant(value); }

int ProgramBuilder::output_of_base(int index) const {
  return graph_->reopened_outputs()[static_cast<std::size_t>(index)];
}

int ProgramBuilder::combine(Opcode opcode, int a, int b) {
  switch (opcode) {
    case Opcode::add:
      return graph_->add(a, b);
    case Opcode::subtract:
      return graph_->subtract(a, b);
    case Opcode::multiply:
      return graph_->is_constant(a, 0.0) ? a : graph_->is_constant(b, 0.0) ? b : graph_->multiply(a, b);
    case Opcode::divide:
      return graph_->divide(a, b);
    case Opcode::negate:
      return graph_->negate(a);
    case Opcode::sqrt:
      return graph_->sqrt(a);
    default:
      return detail::operand_count(opcode) > 1 ? graph_->apply(opcode, a, b) : graph_->apply(opcode, a);
  }
}

std::vector<int> ProgramBuilder::insert(const Program& program) { return graph_->insert(program); }

std::optional<int> ProgramBuilder::derivative(int node, std::span<const int> of_inputs) {
  return graph_->derivative(node, of_inputs);
}

void ProgramBuilder::add_output(const Value& value) {
  outputs_.insert(outputs_.end(), value.nodes.begin(), value.nodes.begin() + (value.is_vector ? 3 : 1));
}

Program ProgramBuilder::build() const { return graph_->build(outputs_); }
Program ProgramBuilder::build(std::span<const int> nodes) const { return graph_->build(nodes); }

std::variant<ExtendedConstant, Symbols::ConstantVector> evaluate_constant(const Expression& formula,
                                                                          const Symbols& constants) {
  const Expression::Numbers numbers = formula.numbers();
  if (numbers.count == 1) return numbers.values[0];
  if (numbers.count == 3) return Symbols::ConstantVector{numbers.values};
  detail::Graph graph(0);
  const ProgramBuilder::Value value = detail::Compiler(graph, constants).compile(*formula.tree());
  const auto number = [&](int i) { return graph.constant_value(value.nodes[static_cast<std::size_t>(i)]).value(); };
  if (!value.is_vector) return number(0);
  return Symbols::ConstantVector{number(0), number(1), number(2)};
}

double evaluate_scalar(const Expression& formula, const Symbols& constants) {
  const auto value = evaluate_constant(formula, constants);
  const auto* number = std::get_if<ExtendedConstant>(&value);
  if (number == nullptr) throw InputError(formula.where(), "a scalar is expected, this is a vector");
  return number->value;
}

Vector3 evaluate_vector(const Expression& formula, const Symbols& constants) {
  const auto value = evaluate_constant(formula, constants);
  const auto* vector = std::get_if<Symbols::ConstantVector>(&value);
  if (vector == nullptr) detail::fail_as_vector(formula);
  return {(*vector)[0].value, (*vector)[1].value, (*vector)[2].value};
}

}  // namespace trajet
