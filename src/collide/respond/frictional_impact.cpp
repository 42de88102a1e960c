#include "trajet/collide/respond/frictional_impact.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "growing_impulse.hpp"
#include "trajet/math/polynomial.hpp"
#include "trajet/rigid/kinematics.hpp"

namespace trajet {
namespace {

/// Friction that holds whatever slips: slip stops by an impulse against which that along the normal is rounding.
constexpr double kWithoutLimit = 1e9;

/// The change of the velocity of a side's point by an impulse, 1/kg.
Matrix3 compliance(const ImpactSide& side) {
  const Matrix3 lever = cross_matrix(side.arm);
  return side.inverse_mass * Matrix3::Identity() - lever * side.inverse_inertia * lever;
}

/// The axes of the contact as columns: along the slip, across, and the normal.
Matrix3 contact_axes(const Vector3& velocity, const Vector3& normal) {
  const Vector3 slip = velocity - normal.dot(velocity) * normal;
  Vector3 along = slip.norm() > 0.0 ? slip.normalized() : normal.unitOrthogonal();
  along = (along - normal.dot(along) * normal).normalized();
  Matrix3 axes;
  axes << along, normal.cross(along), normal;
  return axes;
}

/// The kinetic energy that an impulse adds.
double energy_of(const ImpactInContactFrame& impact, const Vector3& J) {
  return J.dot(impact.velocity + 0.5 * impact.K * J);
}

/// The largest c of 0..1 up to which a c^2 + b c + f <= 0, where f <= 0 but for rounding.
double largest_share(double a, double b, double f) {
  f = std::min(f, 0.0);
  if (a + b + f <= 0.0 && !(a < 0.0 && b > 0.0 && b * b > 4.0 * a * f && -b / (2.0 * a) < 1.0)) return 1.0;
  const double root = std::sqrt(std::max(0.0, b * b - 4.0 * a * f));
  // the first zero behind 0: 2 f / (-b - root) where b >= 0, else (-b + root) / 2 a
  const double c = b >= 0.0 ? (b + root > 0.0 ? -2.0 * f / (b + root) : 1.0) : (root - b) / (2.0 * a);
  return std::clamp(c, 0.0, 1.0);
}

/// What a grip of tangential restitution e_t >= 0 gives back: slip turned round, the normal speed as it is, as far as
/// friction and energy let it.
Vector3 recoil(const ImpactInContactFrame& impact, const Vector3& J, double e_t) {
  const Vector3 wanted(-e_t * impact.velocity.x(), -e_t * impact.velocity.y(), 0.0);
  const Vector3 more = impact.K.ldlt().solve(wanted);
  const Vector3 after = impact.velocity + impact.K * J;
  double share = largest_share(0.5 * more.dot(wanted), more.dot(after), energy_of(impact, J));
  const double square = impact.friction * impact.friction;
  const auto excess = [&](const Vector3& a, const Vector3& b) {
    return a.head<2>().dot(b.head<2>()) - square * a.z() * b.z();
  };
  share = std::min(share, largest_share(excess(more, more), 2.0 * excess(more, J), excess(J, J)));
  // the cone of a limit that is none has lost its apex to rounding: nothing pulls
  if (more.z() < 0.0) share = std::min(share, J.z() / -more.z());
  return share * more;
}

}  // namespace

FrictionalImpact frictional_impact(const ImpactSide& a, const ImpactSide& b, const Vector3& normal, double restitution,
                                   const ImpactFriction& friction) {
  const Vector3 smooth = frictionless_impulse(a, b, normal, restitution);
  if (!friction.acts() || smooth.isZero(0.0)) return {smooth};
  const Vector3 velocity = a.velocity_at_point() - b.velocity_at_point();
  const Matrix3 axes = contact_axes(velocity, normal);
  ImpactInContactFrame impact;
  impact.K = axes.transpose() * (compliance(a) + compliance(b)) * axes;
  impact.velocity = {axes.col(0).dot(velocity), 0.0, normal.dot(velocity)};
  impact.restitution = restitution;
  impact.measure = friction.measure;
  impact.friction = friction.coefficient > 0.0 ? friction.coefficient : kWithoutLimit;

  GrownImpulse grown = grown_impulse(impact);
  Vector3& J = grown.impulse;
  const double e_t = friction.tangential_restitution.value_or(0.0);
  if (e_t > 0.0) {
    J += recoil(impact, J, e_t);
    const double rub = J.head<2>().norm(), most = impact.friction * J.z();
    if (friction.coefficient > 0.0 && rub > most) J.head<2>() *= most / rub;  // by rounding
  }
  if (e_t < 0.0) {
    // a part of friction's impulse: a way between two within the cone, along which the energy is convex
    ImpactInContactFrame gripped = impact;
    gripped.friction = kWithoutLimit;
    const double full = grown_impulse(gripped).impulse.head<2>().norm(), own = J.head<2>().norm();
    const double share = own > 0.0 ? std::min(1.0, (1.0 + e_t) * full / own) : 1.0;
    const Vector3 alone(0.0, 0.0, normal.dot(smooth));
    J = alone + share * (J - alone);
    grown.grips = grown.grips && share == 1.0;
  }
  FrictionalImpact result{axes * J, grown.grips};
  constexpr double kRounding = 1e-12;
  const double gained = energy_of(impact, J);
  const bool can_gain = friction.measure == RestitutionOf::speed;
  if (can_gain && gained > kRounding * J.cwiseAbs().dot(impact.velocity.cwiseAbs())) result.energy_gained = gained;
  return result;
}

}  // namespace trajet
