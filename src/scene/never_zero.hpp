#pragma once

#include "trajet/law/program.hpp"

namespace trajet {

/// Whether the one output of a program certainly never crosses zero, whatever time and state are: bounds of all its
/// values exclude it, or it is always zero.
bool never_crosses_zero(const Program& program);

}  // namespace trajet
