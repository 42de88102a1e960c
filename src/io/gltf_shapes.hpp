#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "trajet/sim/motion_record.hpp"

namespace trajet::detail {

/// Triangles with normals, as graphics hardware takes them.
struct GltfMesh {
  std::vector<Eigen::Vector3f> positions;  ///< m
  std::vector<Eigen::Vector3f> normals;    ///< unit, one per position
  std::vector<std::uint32_t> indices;      ///< three per triangle, counterclockwise from outside
};

/// What a run spans: all positions of its bodies, and the obstacles that are not much larger.
struct Extent {
  Vector3 center;
  double size;  ///< m, of the longest side of the box around it; > 0
};
Extent extent(const MotionRecord& motion);

/// A ball of `radius` around the origin.
GltfMesh ball_mesh(double radius);
/// A body in its own frame. A point is a small ball, so that it can be seen.
GltfMesh body_mesh(const World::Body& body, const Extent& extent);
/// An obstacle in the world. A plane is drawn as large as what lies on it.
GltfMesh obstacle_mesh(const Shape& shape, const Extent& extent);

}  // namespace trajet::detail
