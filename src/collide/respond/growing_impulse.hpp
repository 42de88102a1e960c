#pragma once

#include "trajet/collide/respond/restitution_of.hpp"
#include "trajet/math/quaternion.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// An impact in a frame whose third axis is the normal, and whose first one slip is along before.
struct ImpactInContactFrame {
  Matrix3 K = Matrix3::Zero();         ///< relative velocity by impulse, 1/kg, symmetric and positive
  Vector3 velocity = Vector3::Zero();  ///< relative, of the point of contact, before: m/s
  double friction = 0.0;               ///< Coulomb's coefficient, > 0
  double restitution = 1.0;            ///< 0..1
  RestitutionOf measure = RestitutionOf::work;
};

/// The impulse of an impact with Coulomb's friction, N s; and whether the point of contact does not slip behind it.
struct GrownImpulse {
  Vector3 impulse = Vector3::Zero();
  bool grips = false;
};

/// Lets the impulse grow from compression through restitution: see `frictional_impact`.
GrownImpulse grown_impulse(const ImpactInContactFrame& impact);

/// In which direction the impulse goes on where slip has stopped.
struct SteadiestPush {
  Vector3 direction = Vector3::UnitZ();  ///< d, whose part along the normal is 1
  bool holds = true;                     ///< nothing slips, or slip begins against friction
};

/// The d of the friction cone for which d.Kd is least, the only direction that agrees with friction. Inside of the cone
/// K d has no part along the surface, on it that part is against the friction.
SteadiestPush steadiest_push(const Matrix3& K, double friction);

}  // namespace trajet
