#pragma once

#include "trajet/math/vector.hpp"

namespace trajet {

/// The change of velocity (m/s) of a body that bounces without friction off a fixed obstacle.
///
///     v+ = v - (1 + e) (u . n) n
///
/// \param approach     u, the velocity of the body at the contact
/// \param normal       n, unit, of the obstacle, towards the body
/// \param restitution  e, the part of the normal speed that is kept, 0..1
/// A body that moves away already keeps its velocity. The impulse is the mass times this.
inline Vector3 restitution_velocity_change(const Vector3& approach, const Vector3& normal, double restitution) {
  const double normal_speed = approach.dot(normal);
  if (normal_speed >= 0.0) return Vector3::Zero();
  return -(1.0 + restitution) * normal_speed * normal;
}

}  // namespace trajet
