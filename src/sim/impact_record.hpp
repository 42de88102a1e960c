#pragma once

#include "encounters.hpp"
#include "meetings.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// The contact that was found of a pair as reports have it, before anything has responded to it; `q` is the state of
/// the body's group then, `surface` how the obstacle moves, if it does.
Impact describe(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface,
                const Eigen::VectorXd& q);
/// The same of two bodies, in the states of their groups.
Impact describe(const World& world, const Meeting& meeting, const Eigen::VectorXd& q_first,
                const Eigen::VectorXd& q_second);
/// The beginning or the end of a lasting contact, without an impulse.
Impact describe(const World& world, const RestingContact& contact, ImpactKind kind, double time,
                const Eigen::VectorXd& q);

}  // namespace trajet
