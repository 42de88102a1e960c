#pragma once

#include <Eigen/Core>
#include <optional>

#include "trajet/law/program.hpp"

namespace trajet {

/// A law whose motion is held on the border w(t, q) = 0 of a function of the state: along a direction of the state, to
/// which w' reacts and w itself does not, the rate gets what keeps w'' at zero.
struct HeldLaw {
  Program law;   ///< inputs and outputs as those of the law
  Program pull;  ///< w'' by the law alone: from the side on which it is not positive the law holds the motion there
  /// Outputs: w, w', and how fast w' changes along the direction.
  Program border;
};

/// None where w reacts to the direction itself, or w' does not, or an operation on the way has no derivative among ours
/// (a table).
std::optional<HeldLaw> hold_on_border(const Program& law, const Program& w, const Eigen::VectorXd& direction);

}  // namespace trajet
