#include "hidden_poles.hpp"

namespace trajet::detail {
namespace {

/// Whether the operation is finite where an operand is not.
bool is_finite_at_infinity(Opcode opcode) {
  switch (opcode) {
    case Opcode::atan:
    case Opcode::atan2:
    case Opcode::tanh:
    case Opcode::sign:
    case Opcode::floor:
    case Opcode::min:
    case Opcode::max:
    case Opcode::less:
    case Opcode::less_equal:
    case Opcode::equal:
    case Opcode::where:
    case Opcode::table:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::vector<bool> find_hidden_poles(const Program& program) {
  std::vector<bool> result(program.instructions.size(), false);
  std::vector<bool> is_hidden(static_cast<std::size_t>(program.slot_count), false);  // of what a slot holds
  for (std::size_t i = program.instructions.size(); i-- > 0;) {
    const Instruction& instruction = program.instructions[i];
    const bool hides =
        is_finite_at_infinity(instruction.opcode) || is_hidden[static_cast<std::size_t>(instruction.result)];
    result[i] = hides && may_hide_pole(instruction.opcode);
    if (!hides) continue;
    // a slot that the opcode does not use is 0, the time, which no instruction computes
    for (const int slot : {instruction.a, instruction.b, instruction.c})
      is_hidden[static_cast<std::size_t>(slot)] = true;
  }
  return result;
}

}  // namespace trajet::detail
