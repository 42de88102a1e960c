#pragma once

#include <cassert>

#include "trajet/math/quaternion.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// One side of an impact at a point: how it moves there, and how it answers to an impulse. World frame, SI units.
struct ImpactSide {
  Vector3 velocity = Vector3::Zero();  ///< of the centre of mass
  Vector3 angular_velocity = Vector3::Zero();
  Vector3 arm = Vector3::Zero();              ///< from the centre of mass to the point
  double inverse_mass = 0.0;                  ///< 1/kg; 0: nothing moves it
  Matrix3 inverse_inertia = Matrix3::Zero();  ///< 1/(kg m^2), about the centre of mass; 0: nothing turns it

  Vector3 velocity_at_point() const { return velocity + angular_velocity.cross(arm); }
  /// How much the point's velocity along a direction changes by an impulse of 1 N s along it.
  double compliance(const Vector3& direction) const {
    return inverse_mass + direction.dot((inverse_inertia * arm.cross(direction)).cross(arm));
  }
  /// The impulse (N s) acts at the point.
  void take(const Vector3& impulse) {
    velocity += inverse_mass * impulse;
    angular_velocity += inverse_inertia * arm.cross(impulse);
  }
};

/// The impulse of a frictionless impact along the normal, on `a`; the opposite acts on `b`. N s.
///
/// \param normal       unit, of b at the point, towards a
/// \param restitution  of the speed of approach, 0 to 1: without friction that is Newton's law, Poisson's and Stronge's
/// Nothing where the sides depart already. The energy that is lost is (1 - e^2) u^2 / (2 k), never negative: u is the
/// speed of approach, k the compliance of both.
inline Vector3 frictionless_impulse(const ImpactSide& a, const ImpactSide& b, const Vector3& normal,
                                    double restitution) {
  assert(0.0 <= restitution && restitution <= 1.0);
  const double speed = normal.dot(a.velocity_at_point() - b.velocity_at_point());
  if (speed >= 0.0) return Vector3::Zero();
  return -(1.0 + restitution) * speed / (a.compliance(normal) + b.compliance(normal)) * normal;
}

}  // namespace trajet
