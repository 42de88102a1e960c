#pragma once

#include <optional>

#include "trajet/collide/respond/restitution_of.hpp"
#include "trajet/collide/respond/solid_impact.hpp"

namespace trajet {

/// How two surfaces rub in an impact.
struct ImpactFriction {
  double coefficient = 0.0;  ///< Coulomb's, >= 0
  /// -1..1: what becomes of the slip of the point of contact where it is gripped, turned round; none: friction alone
  /// decides. With a coefficient of 0 the grip has no limit.
  std::optional<double> tangential_restitution{};
  RestitutionOf measure = RestitutionOf::work;

  bool acts() const { return coefficient > 0.0 || tangential_restitution.has_value(); }
};

/// What an impact with friction does.
struct FrictionalImpact {
  Vector3 impulse = Vector3::Zero();  ///< on `a`, the opposite on `b`, N s
  bool grips = false;                 ///< its friction has sufficed to stop the slip and to hold it to the end
  double energy_gained = 0.0;         ///< J, beyond rounding: Newton's law can on an eccentric solid, no other
};

/// The impact of two bodies at a point with Coulomb's friction, slip that stops or turns during it included.
///
/// The impulse J grows along the normal n, by one unit of it along n - mu s as long as the point of contact slips in
/// the direction s, while the relative velocity of the point follows, du = K dJ, K the inverse inertia of both there
/// [Stronge2000, ch. 4]. Where slip has stopped, J goes on in the direction d = n + x, |x| <= mu, of the least d.Kd:
/// that is without slip where friction suffices, else with slip in the only direction that agrees with friction.
/// Compression ends where the normal speed is zero, restitution as `friction.measure` says. A tangential restitution
/// adds an impulse that turns slip round without a change of the normal speed, as far as friction and energy let it; a
/// negative one is the part of friction that it leaves.
///
/// The energy T never grows by Stronge's law nor Poisson's. Stronge: the normal impulse does the work -(1 - e^2) times
/// that of compression, friction's is negative. Poisson: T' = dT/dp = u_n - mu |u_t| along the normal impulse p is
/// continuous, grows, and is concave (T'' = d.Kd, with derivative -2 mu (K d)_t^2/|u_t| across the slip, and least
/// where slip has stopped); it is not positive where compression ends at p_c, so that T(p_c + y) <= T(p_c - y) <= T(0).
///
/// \param normal       unit, of b at the point, towards a
/// \param restitution  e, 0 to 1
/// Nothing where the sides depart already. Without friction it is `frictionless_impulse`, bit for bit.
FrictionalImpact frictional_impact(const ImpactSide& a, const ImpactSide& b, const Vector3& normal, double restitution,
                                   const ImpactFriction& friction);

}  // namespace trajet
