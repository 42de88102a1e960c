#pragma once

#include <Eigen/Core>

#include "trajet/scene/world.hpp"

namespace trajet {

/// A state of a group, its orientations read, of the World `from` as `to` carries it: the same scene, its orientations in another way.
Eigen::VectorXd carried_as_in(const World& to, const World& from, int group, const Eigen::VectorXd& q);
/// Of each pair q and -q, which are one rotation, makes `q` hold the one nearer to that of another state.
void align_orientations(const World& world, int group, Eigen::VectorXd& q, const Eigen::VectorXd& other);

}  // namespace trajet
