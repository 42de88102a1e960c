#include "trajet/law/time_branches.hpp"

#include "graph.hpp"

namespace trajet {
namespace {

/// Of each slot, whether it is made of constants and of what has the property: the time if `time_has`, the results of
/// instructions where `result_has(opcode)`.
template <class ResultHas>
std::vector<bool> find_slots(const Program& program, bool time_has, ResultHas&& result_has) {
  std::vector<bool> has(static_cast<std::size_t>(program.slot_count), false);
  const auto at = [&](std::int32_t slot) { return has.begin() + slot; };
  *at(0) = time_has;
  for (const Program::Constant& constant : program.constants) *at(constant.slot) = true;
  for (const Instruction& i : program.instructions) {
    const int count = detail::operand_count(i.opcode);
    *at(i.result) = result_has(i.opcode) || (*at(i.a) && (count < 2 || *at(i.b)) && (count < 3 || *at(i.c)));
    if (i.opcode == Opcode::sin_cos || i.opcode == Opcode::sinh_cosh) *at(i.b) = *at(i.result);
  }
  return has;
}

}  // namespace

bool decides_by_difference(Opcode opcode) {
  return opcode == Opcode::less || opcode == Opcode::less_equal || opcode == Opcode::equal || opcode == Opcode::min ||
         opcode == Opcode::max;
}

bool jumps(Opcode opcode) {
  return opcode == Opcode::less || opcode == Opcode::less_equal || opcode == Opcode::equal || opcode == Opcode::sign ||
         opcode == Opcode::floor;
}

std::vector<bool> find_time_slots(const Program& program) {
  return find_slots(program, true, [](Opcode) { return false; });
}

std::vector<bool> find_step_slots(const Program& program) { return find_slots(program, false, jumps); }

bool branches_by_time(const Instruction& instruction, const std::vector<bool>& time_slots) {
  const auto is_of_time = [&](std::int32_t slot) { return time_slots[static_cast<std::size_t>(slot)]; };
  if (decides_by_difference(instruction.opcode)) return is_of_time(instruction.a) && is_of_time(instruction.b);
  const bool decides = instruction.opcode == Opcode::abs || instruction.opcode == Opcode::sign ||
                       instruction.opcode == Opcode::floor || instruction.opcode == Opcode::table;
  return decides && is_of_time(instruction.a);
}

}  // namespace trajet
