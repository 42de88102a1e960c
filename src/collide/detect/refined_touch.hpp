#pragma once

#include <vector>

#include "trajet/geom/closest_features.hpp"
#include "trajet/geom/convex_core.hpp"

namespace trajet::detail {

/// Where two bounded cores that touch, nearly, are closest. In A's frame.
struct RefinedTouch {
  Vector3 normal = Vector3::Zero();  ///< unit, from A to B
  double gap = 0.0;                  ///< the separation along the normal of all of both, m
  bool is_refined = false;           ///< else the normal is the first one
  Vector3 on_a = Vector3::Zero();    ///< the closest points of the surfaces
  Vector3 on_b = Vector3::Zero();
  /// Unit: straight lines of the surfaces through the place of contact, edges and generators; each in the frame of its
  /// own solid.
  std::vector<Vector3> lines_a{};
  std::vector<Vector3> lines_b{};
};

/// The direction of the largest separation near `normal`, and what is closest along it, to rounding.
///
/// The separation n . d - h_A(n) - h_B(-n) is smooth but where several vertices are support at once. Newton's steps on
/// the conditions of its maximum over unit vectors, with one multiplier for each vertex that is support: those of a
/// solution are the weights with which the vertices' points make up the closest points. Where it does not get better
/// that way, as of disks that lie flat, `normal` is kept, and the points are some that are farthest along it.
RefinedTouch refined_touch(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, const Vector3& normal);

}  // namespace trajet::detail
