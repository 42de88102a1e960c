#pragma once

#include <vector>

#include "trajet/collide/detect/turning_contact.hpp"
#include "trajet/geom/closest_features.hpp"

namespace trajet::detail {

/// What two touching solids have in common, in A's frame.
struct ContactPatch {
  Vector3 point = Vector3::Zero();  ///< the mean of `corners`
  std::vector<Vector3> corners{};   ///< one, two, or those of a polygon, counterclockwise seen against the normal
  Feature of_a = Feature::vertex;
  Feature of_b = Feature::vertex;
};

/// Of solids that touch, with the unit `normal` from A to B: the features that lie in the plane of contact, within
/// `margin` (m) of it, and what they share. On A's surface.
ContactPatch contact_patch(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, const Vector3& normal,
                           double margin);

}  // namespace trajet::detail
