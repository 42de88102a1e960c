#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <vector>

#include "gltf_keys.hpp"
#include "trajet/sim/motion_record.hpp"

namespace trajet::detail {

/// How a part of a surface is coloured: as its body, or so that one sees the body turn.
enum class Tint { own, light, dark };

/// Triangles with normals, as graphics hardware takes them.
struct GltfMesh {
  std::vector<Eigen::Vector3f> positions;  ///< m
  std::vector<Eigen::Vector3f> normals;    ///< unit, one per position
  /// Indices of three positions per triangle, counterclockwise from outside.
  std::map<Tint, std::vector<std::uint32_t>> triangles;
};

/// What a run spans: its bodies wherever they come, and the obstacles that are not much larger.
struct Extent {
  Vector3 center;
  double size;          ///< m, of the longest side of the box around it; > 0
  double point_radius;  ///< m; the size of a ball that stands for a point: one can see it, and what it meets
};
Extent extent(const RecordedMotion& motion);

/// A body in its own frame. A point is a small ball, so that it can be seen; if it has named points, rods lead to them.
GltfMesh body_mesh(const World::Body& body, const Extent& extent);
/// A ball that stands for a named point of the body.
GltfMesh point_mesh(const World::Body& body, const Extent& extent);
/// The frame of an obstacle in the world: its origin is the middle of what is drawn, its z axis the normal of what is
/// flat. A box keeps its axes; the y axis of a rectangle points up, the x axis of a triangle along its first edge.
Pose obstacle_pose(const Shape& shape, const Extent& extent);
/// An obstacle in its own frame. A plane is drawn as large as what lies on it.
GltfMesh obstacle_mesh(const Shape& shape, const Extent& extent);

}  // namespace trajet::detail
