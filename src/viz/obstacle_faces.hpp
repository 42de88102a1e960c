#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "trajet/geom/faces.hpp"
#include "trajet/scene/world.hpp"

namespace trajet::detail {

/// What is flat of an obstacle, cut to a box; nothing of a ball.
std::vector<Face> obstacle_faces(const Shape& shape, const Eigen::AlignedBox3d& box);

/// What a picture of a motion shows: the box of the motion, extended to the obstacles that are not much larger and to
/// planes near by.
Eigen::AlignedBox3d with_obstacles(const Eigen::AlignedBox3d& motion, const std::vector<World::Obstacle>& obstacles);

}  // namespace trajet::detail
