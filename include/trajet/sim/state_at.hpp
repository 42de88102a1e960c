#pragma once

#include <Eigen/Core>

#include "trajet/ode/segment.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// The state of a group at a time on a Segment of its motion, as everything that is reported has it: samples, impacts,
/// the final state, comparisons, pictures. Numbers that stand for a rotation are read as that rotation: unit
/// quaternions, and rotation vectors turned into them; where the way of carrying orientations lets them drift
/// (`quaternion`, `matrix`), as they are carried.
Eigen::VectorXd state_at(const World& world, int group, const Segment<>& segment, double t);

/// The numbers of a state of a group, read as above, in place.
void read_orientations(const World& world, int group, Eigen::VectorXd& q);

}  // namespace trajet
