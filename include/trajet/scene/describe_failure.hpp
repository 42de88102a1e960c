#pragma once

#include <Eigen/Core>
#include <string>

#include "trajet/scene/world.hpp"

namespace trajet {

/// Why a group's law could not be integrated on from the state q at time t: the formula with its place in the scene,
/// its value there and those of the names in it. It tells a law that is not finite, there or just ahead, from a motion
/// that runs to infinity in finite time, from a rate that does so while the state does not, and from a rate that jumps;
/// else it names the formula that changes most.
std::string describe_failure(const World& world, int group, double t, const Eigen::VectorXd& q);

/// The component of a group whose rate jumps at time t in the state q, with its formula: steps there come to nothing.
/// Empty if none does.
std::string describe_jump(const World& world, int group, double t, const Eigen::VectorXd& q);

/// The same of a group that has come to the state q at time t with nothing wrong on the way: what of it runs to
/// infinity just there. Empty if nothing does.
std::string describe_blow_up(const World& world, int group, double t, const Eigen::VectorXd& q);

}  // namespace trajet
