#pragma once

#include "trajet/event/linear_function.hpp"
#include "trajet/math/polynomial.hpp"
#include "trajet/math/vector.hpp"

namespace trajet::detail {

/// The height n . x - n . p - radius of a ball on a path over the plane through p with the unit normal n.
inline LinearFunction plane_height(const PointPath& path, const Vector3& normal, const Vector3& point,
                                   double radius = 0.0) {
  // three products, two sums and the radius
  constexpr double kRoundings = 4.0;
  const double offset_error = kRoundings * kUnitRoundoff * (normal.cwiseProduct(point).lpNorm<1>() + radius);
  return {path, normal, -normal.dot(point) - radius, offset_error};
}

}  // namespace trajet::detail
