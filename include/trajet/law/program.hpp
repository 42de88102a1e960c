#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "trajet/law/lookup_table.hpp"
#include "trajet/math/extended_constant.hpp"

namespace trajet {

/// What one instruction of a Program computes. a, b, c are operand slots, k its constant.
enum class Opcode : std::uint8_t {
  add,                ///< a + b
  add_constant,       ///< a + k
  subtract,           ///< a - b
  constant_minus,     ///< k - a
  multiply,           ///< a b
  multiply_constant,  ///< k a
  divide,             ///< a / b
  divide_constant,    ///< a / k
  constant_over,      ///< k / a
  negate,             ///< -a
  square,             ///< a^2
  power,              ///< a^b
  power_constant,     ///< a^k, k neither a small integer nor a half of one
  sqrt,
  cbrt,
  exp,
  log,
  log10,
  sin,
  cos,
  sin_cos,  ///< sin a into the result, cos a into the slot b
  tan,
  asin,
  acos,
  atan,
  atan2,  ///< angle of the point (b, a)
  sinh,
  cosh,
  sinh_cosh,  ///< sinh a into the result, cosh a into the slot b
  tanh,
  abs,
  sign,
  floor,
  min,  ///< of a and b
  max,
  less,  ///< 1 where a < b, else 0
  less_equal,
  equal,
  where,  ///< b where a is not 0, else c
  norm,   ///< length of (a, b, c)
  table,  ///< the table of index b at a
};

/// One operation on scalars. Slots that the opcode does not use are 0.
struct Instruction {
  Opcode opcode = Opcode::add;
  std::int32_t result = 0;
  std::int32_t a = 0;
  std::int32_t b = 0;
  std::int32_t c = 0;
  ExtendedConstant constant{};
};

/// Formulas compiled into a flat list of scalar instructions in which nothing is computed twice.
///
/// It works on an array of slots, of any number type: first the inputs (0 is the time t, then the state), then the
/// constants, then the results in the order of the instructions; each slot is written once. Alike instructions that do
/// not need each other stand together. Plain data: read it, evaluate it (law/evaluate.hpp), expand it into power series
/// (law/program_expansion.hpp). `ProgramBuilder` makes it, and opens it again to add to it.
struct Program {
  struct Constant {
    std::int32_t slot;
    ExtendedConstant value;
  };

  int input_count = 0;
  int slot_count = 0;
  std::vector<Constant> constants;
  std::vector<Instruction> instructions;
  std::vector<std::int32_t> outputs;  ///< slots: of results, constants or inputs
  std::vector<std::shared_ptr<const LookupTable>> tables;
};

/// The degree in time of all solutions of dq/dt = program(t, q) if they are polynomials whatever the state, else -1.
///
/// Read off the instructions: t has degree 1, q_i one more than its rate. A law that depends on its own solution in a
/// circle or by anything but + - * and division by constants has no degree.
int polynomial_degree(const Program& program);

/// The components of the state that a program reads, in rising order.
std::vector<int> read_components(const Program& program);

}  // namespace trajet
