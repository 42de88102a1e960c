#pragma once

#include <vector>

#include "trajet/law/program.hpp"

namespace trajet {

/// Whether an instruction takes its branch by the sign of a - b.
bool decides_by_difference(Opcode opcode);
/// Whether it may jump where it changes its branch.
bool jumps(Opcode opcode);

/// Of each slot of a program, whether it is a function of t alone.
std::vector<bool> find_time_slots(const Program& program);
/// Of each slot, whether it is constant but for jumps: made of comparisons, signs and whole numbers.
std::vector<bool> find_step_slots(const Program& program);

/// Whether an instruction, one that compares, abs, sign, min, max, floor or a table, takes its branch by functions of t
/// alone.
bool branches_by_time(const Instruction& instruction, const std::vector<bool>& time_slots);

}  // namespace trajet
