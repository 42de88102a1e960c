#pragma once

#include <optional>

#include "encounters.hpp"
#include "instant.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// The impact of a point or a ball on an obstacle with friction: changes velocity and angular velocity in `instant.q`,
/// and the derivative of the new state by the one before; tells `impact` what came of it.
///
/// \param surface  how the obstacle moves, if it does: what counts is its velocity at the point of contact
/// \param mass     of the body, kg; 1 where it has none, as points may: impulses are per mass then
/// \param rate     dq/dt before
/// Returns the energy that Newton's law of impact has gained, J.
double bounce_ball(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface, double mass,
                   const Eigen::VectorXd& rate, Instant& instant, Impact& impact);

}  // namespace trajet
