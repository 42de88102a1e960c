#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "trajet/law/program.hpp"

namespace trajet::detail {

/// Scalar computations as a graph without duplicates: asking for a node that exists already returns it.
///
/// Every function simplifies what it is asked for; operands are nodes. Operands always precede their users.
class Graph {
 public:
  explicit Graph(int input_count);
  /// The computations of a program, as it has them: nothing is simplified.
  explicit Graph(const Program& program);

  /// Adds the computations of a program over the same inputs, or the first of them; the nodes of its outputs.
  std::vector<int> insert(const Program& program);
  /// The derivative of a node where the inputs change at the rates that the nodes `of_inputs` have; none where an
  /// operation on the way has no derivative that is one of ours.
  std::optional<int> derivative(int node, std::span<const int> of_inputs);

  int constant(const ExtendedConstant& value);
  /// The value of a node that is a constant.
  std::optional<ExtendedConstant> constant_value(int node) const;
  bool is_constant(int node, double value) const {
    const auto k = constant_value(node);
    return k && k->value == value;
  }
  /// The nodes of the outputs of the program that the graph was made of.
  const std::vector<int>& reopened_outputs() const { return reopened_outputs_; }

  int add(int a, int b);
  int subtract(int a, int b);
  int multiply(int a, int b);
  int divide(int a, int b);
  int negate(int a);
  int power(int a, int b);
  int sqrt(int a);
  int abs(int a);
  int norm(int x, int y, int z);
  /// `then` where the condition is not 0.
  int where(int condition, int then, int otherwise);
  int table(const std::shared_ptr<const LookupTable>& table, int x);
  /// The sum of input 0 and a number; what is compared to it or taken from it is so without rounding the sum.
  int clock(double epoch);
  int compare(Opcode opcode, int a, int b);
  /// Any other opcode of one or two operands.
  int apply(Opcode opcode, int a, int b = 0);

  Program build(std::span<const int> outputs) const;

 private:
  struct Node {
    enum class Kind : std::uint8_t { input, constant, operation };
    Kind kind = Kind::operation;
    Opcode opcode = Opcode::add;
    std::array<int, 3> operands{};
    ExtendedConstant constant{};
  };
  /// What tells two nodes apart: of constants the bits, so that 0 and -0 stay two.
  struct Key {
    Opcode opcode;
    std::array<int, 3> operands;
    std::array<std::uint64_t, 2> constant_bits;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };

  const Node& node(int index) const { return nodes_[static_cast<std::size_t>(index)]; }
  bool is(int index, Opcode opcode) const {
    return node(index).kind == Node::Kind::operation && node(index).opcode == opcode;
  }
  int operand(int index, int which = 0) const { return node(index).operands[static_cast<std::size_t>(which)]; }

  /// The node of that operation, a constant if all its operands are.
  int operation(Opcode opcode, std::array<int, 3> operands, const ExtendedConstant& constant = {});
  int fold(const Node& node);
  /// The value of an operation on constants, computed in numbers of type T.
  template <class T>
  T computed(const Node& node) const;
  /// The slope of a table at x; none where it has too many points.
  std::optional<int> slope_of(const LookupTable& values, int x);
  /// The derivative of an operation from those of its operands.
  std::optional<int> derivative_of(int node, const std::array<int, 3>& of_operands);
  int add_constant(int a, const ExtendedConstant& k);
  int multiply_constant(int a, const ExtendedConstant& k);
  int divide_constant(int a, const ExtendedConstant& k);
  int integer_power(int a, int exponent);
  /// Appends the x_i of a sum of squares x_0^2 + x_1^2 + …; false if `index` is anything else or has too many terms.
  bool collect_squares(int index, std::vector<int>& terms) const;

  std::vector<bool> find_live(std::span<const int> outputs) const;
  /// The operations that are to be computed, operands first. What lies equally deep and is of one opcode stands
  /// together: an interpreter goes from opcode to opcode less often, and neighbours do not wait for each other.
  std::vector<int> schedule(const std::vector<bool>& live) const;
  /// The cosine of what the node is the sine of, or the other way round, if it is computed too; else -1.
  int find_twin(const Node& node, const std::vector<bool>& live) const;
  Instruction make_instruction(int index, int twin, const std::vector<std::int32_t>& slots) const;

  int input_count_;
  std::optional<int> clock_;  // the node, where it is not input 0 itself
  std::vector<Node> nodes_;
  std::unordered_map<Key, int, KeyHash> known_;
  std::unordered_map<Key, int, KeyHash> known_constants_;
  std::vector<std::shared_ptr<const LookupTable>> tables_;
  std::vector<int> reopened_outputs_;
};

/// How many of its operands a, b, c an opcode reads from slots.
int operand_count(Opcode opcode);

}  // namespace trajet::detail
