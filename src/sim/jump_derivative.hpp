#pragma once

#include "encounters.hpp"
#include "instant.hpp"

namespace trajet {

/// The derivative of the state behind a frictionless bounce by the state before it, at one time, once the velocity in
/// `instant.q` is that behind it. `surface`: how the obstacle moves, if it does; `rate`: dq/dt before.
///
/// Of states near the one that bounces each does so at a time of its own, where its gap vanishes: the saltation matrix
/// D + (D f- - f+) dt*/dq with the derivative D of the response at a fixed time, f-, f+ the rates before and behind,
/// and dt*/dq = -n/(n . c), c being the velocity against the surface. The normal turns along a surface that is curved
/// there, and with one that turns. Of an obstacle that moves D takes a part in time too.
Eigen::MatrixXd derivative_of_bounce(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface,
                                     const Instant& instant, const Eigen::VectorXd& rate);

/// How the normal of the contact of a point or ball changes with the place of its centre, which is at `position`, 1/m.
Matrix3 normal_derivative(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface,
                          const Vector3& position);

/// The derivative of the state behind an event's `set`, which happens where `when` vanishes, by the state before it.
Eigen::MatrixXd derivative_of_set(const World::Event& event, const Instant& instant, const Eigen::VectorXd& rate);

}  // namespace trajet
