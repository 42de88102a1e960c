#pragma once

#include <vector>

#include "trajet/law/program.hpp"

namespace trajet::detail {

/// A quotient.
inline bool may_hide_pole(Opcode opcode) { return opcode == Opcode::divide || opcode == Opcode::constant_over; }

/// For each instruction, whether it is a quotient whose pole a later instruction can hide, as atan(y/x) hides that at
/// x = 0: what is bounded, or chooses, jumps there, but its series goes on as if nothing were.
std::vector<bool> find_hidden_poles(const Program& program);

}  // namespace trajet::detail
