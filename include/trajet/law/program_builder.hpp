#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "trajet/law/expression.hpp"
#include "trajet/law/program.hpp"
#include "trajet/law/symbols.hpp"

namespace trajet {

namespace detail {
class Graph;
}

/// Compiles formulas into one Program. What two formulas have in common is computed once; constants fold.
///
/// Everything it rewrites keeps the result to the last bit, but for these, which only gain accuracy or cost nothing:
/// integer powers become products, half-integer ones products with a square root; the root of a sum of two or three
/// squares becomes the length of a vector, that of one square the absolute value, since these have a power series where
/// the argument vanishes; a component of a vector that is the constant 0 stays 0 whatever it is multiplied by.
class ProgramBuilder {
 public:
  /// A compiled formula: nodes of the builder's graph, one or three.
  struct Value {
    bool is_vector = false;
    std::array<int, 3> nodes{};
  };

  /// Programs over the inputs 0 … input_count - 1; 0 is t, the time elapsed.
  explicit ProgramBuilder(int input_count);
  /// Opens a program again, to compute more from what it computes. It has no outputs yet: see `output_of_base`.
  explicit ProgramBuilder(const Program& base);
  ~ProgramBuilder();
  ProgramBuilder(ProgramBuilder&&) noexcept;
  ProgramBuilder& operator=(ProgramBuilder&&) noexcept;

  /// Throws InputError that points into the formula: unknown names and tables, scalar + vector, ….
  Value compile(const Expression& formula, const Symbols& symbols);
  /// As `compile`; what has the wrong shape is an InputError.
  Value compile_scalar(const Expression& formula, const Symbols& symbols);
  Value compile_vector(const Expression& formula, const Symbols& symbols);

  /// The node of a clock that shows `epoch` where input 0, the time elapsed, is 0. A difference between it and a
  /// constant, and a comparison, keep the digits of the time elapsed.
  int clock(double epoch);
  Value inputs(const std::array<int, 3>& indices) const;
  Value constant(double value);
  /// numerator / denominator, scalar or vector by scalar: a force and a mass make an acceleration.
  Value divide(const Value& numerator, const Value& denominator);

  /// The node of an operation on nodes of this builder, as a ProgramNumber uses it. A product with the constant 0 is 0,
  /// as that of a component of a vector.
  int combine(Opcode opcode, int a, int b = 0);
  int constant_node(const ExtendedConstant& value);
  /// The node of an output of the program that was opened again.
  int output_of_base(int index) const;

  /// Adds the computations of a program over the same inputs, or the first of them; the nodes of its outputs.
  std::vector<int> insert(const Program& program);
  /// The derivative of a node where the inputs change at the rates that the nodes `of_inputs` have; none where an
  /// operation on the way has no derivative that is one of ours (a table).
  std::optional<int> derivative(int node, std::span<const int> of_inputs);

  /// Appends one or three outputs.
  void add_output(const Value& value);

  /// The program that computes the outputs added so far, and nothing else.
  Program build() const;
  /// The program that computes some nodes.
  Program build(std::span<const int> nodes) const;

 private:
  std::unique_ptr<detail::Graph> graph_;
  std::vector<int> outputs_;
};

/// The value of a formula over constants, such as a parameter. Throws InputError that points at what is wrong: a name
/// that is not a constant, a vector where a scalar is expected. The value may be infinite or not-a-number.
double evaluate_scalar(const Expression& formula, const Symbols& constants);
Vector3 evaluate_vector(const Expression& formula, const Symbols& constants);
/// One number or three.
std::variant<ExtendedConstant, Symbols::ConstantVector> evaluate_constant(const Expression& formula,
                                                                          const Symbols& constants);

}  // namespace trajet
