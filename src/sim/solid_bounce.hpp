#pragma once

#include <optional>

#include "encounters.hpp"
#include "instant.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// The impact of a solid on an obstacle: changes velocity and angular velocity in `instant.q`, and the
/// derivative of the new state by the one before; tells `impact` what came of it.
///
/// \param surface  how the obstacle moves, if it does
/// \param mass     of the body, kg; 1 where it has none: impulses are per mass then
/// The restitution is of the speed of approach of the two surfaces at the point of contact, which is the middle of what
/// touches. Returns the energy that Newton's law of impact has gained, J.
double bounce_solid(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface, double restitution,
                    double mass, Instant& instant, Impact& impact);

/// How the surfaces of a solid and an obstacle move against each other at their point of contact, along its normal:
/// m/s, and m/s^2 of what is fixed in either.
struct NormalMotion {
  double speed;
  double acceleration;
};
NormalMotion normal_motion(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface,
                           const Eigen::VectorXd& q, const Eigen::VectorXd& rate);

/// How the gap of a contact changes with the state of the body's group, m per unit of each component.
Eigen::VectorXd gap_gradient(const World& world, const Pair& pair, const Eigen::VectorXd& q);

}  // namespace trajet
