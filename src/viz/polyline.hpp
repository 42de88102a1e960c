#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "trajet/math/vector.hpp"

namespace trajet::detail {

/// The parts of a polyline that lie within a box, its sides included. Points that are not finite interrupt it.
std::vector<std::vector<Vector3>> clipped(const std::vector<Vector3>& points, const Eigen::AlignedBox3d& box);

}  // namespace trajet::detail
