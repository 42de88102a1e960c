#pragma once

#include "trajet/geom/closest_features.hpp"
#include "trajet/geom/convex_core.hpp"

namespace trajet::detail {

/// How deep two convex solids are within each other: how far one must move, at least, to be apart. m.
struct Penetration {
  double at_least = 0.0;             ///< not below zero
  double at_most = 0.0;              ///< below zero where they are apart, by that much at least
  Vector3 normal = Vector3::Zero();  ///< unit, in A's frame, from A to B: to be apart B moves along it
};

/// Between bounds that are within `relative` of each other, or within `absolute` (m), or below 16 times that if they
/// are apart: the difference of the solids is enclosed by a polytope of its points and the planes that support it,
/// which get closer where they are nearest to the origin [VanDenBergen2001]. A may be a half space.
Penetration penetration(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, double relative,
                        double absolute);

}  // namespace trajet::detail
