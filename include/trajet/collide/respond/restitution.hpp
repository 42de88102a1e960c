#pragma once

#include <cassert>

#include "trajet/math/vector.hpp"

namespace trajet {

/// What a frictionless impact does to a body.
struct Rebound {
  Vector3 velocity_after;    ///< m/s
  Vector3 impulse_per_mass;  ///< velocity_after - velocity_before, m/s
};

/// The frictionless impact of a body on an obstacle at rest.
///
/// \param velocity     before the impact, m/s
/// \param normal       unit, of the obstacle, towards the body
/// \param restitution  0: keeps no normal speed, 1: keeps all of it
/// A body that moves away from the obstacle already keeps its velocity.
inline Rebound rebound(const Vector3& velocity, const Vector3& normal, double restitution) {
  assert(0.0 <= restitution && restitution <= 1.0);
  const double approach = velocity.dot(normal);
  if (approach >= 0.0) return {velocity, Vector3::Zero()};
  // v+ = v - (1 + e) (v . n) n
  const Vector3 impulse = -(1.0 + restitution) * approach * normal;
  return {velocity + impulse, impulse};
}

}  // namespace trajet
