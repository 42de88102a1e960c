// One impact with friction: laws that hold for any bodies, and an oracle that integrates in small steps.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "trajet/collide/respond/frictional_impact.hpp"

namespace trajet {
namespace {

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vector3 any_vector(Random& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

Matrix3 any_rotation(Random& random) {
  std::normal_distribution<double> normal;
  Quaternion q(normal(random), normal(random), normal(random), normal(random));
  return q.normalized().toRotationMatrix();
}

/// A solid with any possible inertia and any arm: masses and sizes over some orders of magnitude. `flattest`: the
/// logarithm of the least moment of a pair of masses.
ImpactSide any_side(Random& random, double flattest) {
  ImpactSide side;
  const double mass = std::pow(10.0, uniform(random, -1.0, 1.0));
  const double size = std::pow(10.0, uniform(random, -0.5, 0.5));
  // moments of three perpendicular pairs of masses: any that a body may have
  const auto square = [&] { return std::pow(10.0, uniform(random, flattest, 0.0)); };
  const Vector3 squares(square(), square(), square());
  const Vector3 moments(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y());
  const Matrix3 R = any_rotation(random);
  side.inverse_mass = 1.0 / mass;
  side.inverse_inertia = R * (mass * size * size * moments).cwiseInverse().asDiagonal() * R.transpose();
  side.arm = size * any_vector(random);
  side.velocity = any_vector(random);
  side.angular_velocity = any_vector(random) / size;
  return side;
}

/// A contact of two bodies, or of one with what nothing moves.
struct Contact {
  ImpactSide a, b;
  Vector3 normal;

  Vector3 velocity() const { return a.velocity_at_point() - b.velocity_at_point(); }
};

Contact any_contact(Random& random, double flattest = -3.0) {
  Contact contact{any_side(random, flattest), {}, any_vector(random).normalized()};
  if (random() % 2 == 0) contact.b = any_side(random, flattest);
  if (contact.normal.dot(contact.velocity()) > 0.0) contact.normal *= -1.0;
  return contact;
}

double kinetic_energy(const ImpactSide& side) {
  if (side.inverse_mass == 0.0) return 0.0;
  const Vector3& w = side.angular_velocity;
  return 0.5 * side.velocity.squaredNorm() / side.inverse_mass + 0.5 * w.dot(side.inverse_inertia.inverse() * w);
}

struct After {
  ImpactSide a, b;
};

After after(const Contact& contact, const Vector3& impulse) {
  After sides{contact.a, contact.b};
  sides.a.take(impulse);
  sides.b.take(-impulse);
  return sides;
}

Vector3 slip_of(const Vector3& velocity, const Vector3& normal) { return velocity - normal.dot(velocity) * normal; }

/// The impulse by small steps of the normal impulse: after each, friction takes the slip out as far as it can. That is
/// the implicit Euler method, with its error of the first order.
Vector3 impulse_by_small_steps(const Contact& contact, double e, double mu, RestitutionOf measure, int steps) {
  const Vector3& n = contact.normal;
  const Vector3 t = n.unitOrthogonal(), s = n.cross(t);
  const double u0 = -n.dot(contact.velocity());
  const double step = u0 / (contact.a.compliance(n) + contact.b.compliance(n)) / steps;
  Matrix3 K;  // columns: the change of the relative velocity by a unit of impulse along t, s, n
  for (int i = 0; i < 3; ++i) {
    const After sides = after(contact, i == 0 ? t : i == 1 ? s : n);
    const Vector3 change = sides.a.velocity_at_point() - sides.b.velocity_at_point() - contact.velocity();
    K.col(i) = Vector3(t.dot(change), s.dot(change), n.dot(change));
  }
  Vector3 u(t.dot(contact.velocity()), s.dot(contact.velocity()), -u0), J(0, 0, 0);
  double work = 0.0, target = 0.0;
  bool compresses = true;
  while (true) {
    // friction f of the step: the least of f.K_tt f / 2 + f.u within its bound, by the method of projected gradients
    const Eigen::Matrix2d Ktt = K.topLeftCorner<2, 2>();
    const Eigen::Vector2d free = u.head<2>() + step * K.topRightCorner<2, 1>();
    Eigen::Vector2d f = Eigen::Vector2d::Zero();
    const double rate = 1.0 / Ktt.trace();
    for (int i = 0; i < 60; ++i) {
      f -= rate * (free + Ktt * f);
      if (f.norm() > mu * step) f *= mu * step / f.norm();
    }
    const Vector3 push(f.x(), f.y(), step);
    const double before = u.z();
    u += K * push;
    J += push;
    work += 0.5 * (before + u.z()) * step;
    if (compresses && u.z() >= 0.0) {
      compresses = false;
      target = measure == RestitutionOf::work      ? (1.0 - e * e) * work
               : measure == RestitutionOf::impulse ? (1.0 + e) * J.z()
                                                   : e * u0;
    } else if (!compresses && u.z() < 0.0) {
      compresses = true;
    }
    if (compresses) continue;
    const double now = measure == RestitutionOf::work ? work : measure == RestitutionOf::impulse ? J.z() : u.z();
    if (now >= target) break;
  }
  return J.x() * t + J.y() * s + J.z() * n;
}

constexpr RestitutionOf kMeasures[] = {RestitutionOf::work, RestitutionOf::impulse, RestitutionOf::speed};

double any_friction(Random& random) { return std::pow(10.0, uniform(random, -2.0, 0.7)); }

TEST(FrictionalImpact, HoldsItsLawsForAMillionContacts) {
  Random random(20260);
  int gripped = 0, gained = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const Contact contact = any_contact(random);
    ImpactFriction friction{any_friction(random), {}, kMeasures[i % 3]};
    if (i % 5 == 0) friction.tangential_restitution = uniform(random, -1.0, 1.0);
    if (i % 10 == 0) friction.coefficient = 0.0;
    const double e = i % 7 == 0 ? 0.0 : i % 7 == 1 ? 1.0 : uniform(random, 0.0, 1.0);
    const FrictionalImpact impact = frictional_impact(contact.a, contact.b, contact.normal, e, friction);
    const Vector3& J = impact.impulse;
    ASSERT_TRUE(J.allFinite()) << i;
    const double push = contact.normal.dot(J), rub = slip_of(J, contact.normal).norm();
    ASSERT_GT(push, friction.coefficient > 0.0 ? 0.0 : -1e-14 * rub) << i;
    if (friction.coefficient > 0.0) {
      ASSERT_LE(rub, friction.coefficient * push * (1.0 + 1e-12)) << i;
    }
    const After sides = after(contact, J);
    const double before = kinetic_energy(contact.a) + kinetic_energy(contact.b);
    const double gain = kinetic_energy(sides.a) + kinetic_energy(sides.b) - before;
    // the energies of moments up to 1e4 times each other lose some digits
    if (friction.measure != RestitutionOf::speed) {
      ASSERT_LE(gain, 1e-12 * before) << i;
      ASSERT_EQ(impact.energy_gained, 0.0);
    }
    ASSERT_NEAR(impact.energy_gained, std::max(0.0, gain), 1e-11 * before) << i;
    const Vector3 u = sides.a.velocity_at_point() - sides.b.velocity_at_point();
    ASSERT_GE(contact.normal.dot(u), -1e-12 * contact.velocity().norm()) << i;
    if (impact.grips && !friction.tangential_restitution) {
      ASSERT_LE(slip_of(u, contact.normal).norm(), 1e-11 * contact.velocity().norm()) << i;
    }
    gripped += impact.grips ? 1 : 0;
    gained += impact.energy_gained > 0.0 ? 1 : 0;
  }
  // both happen: what is tested is not one of them only
  EXPECT_GT(gripped, 100'000);
  EXPECT_LT(gripped, 900'000);
  EXPECT_GT(gained, 100);
}

TEST(FrictionalImpact, IsWhatSmallStepsComeTo) {
  Random random(7);
  for (int i = 0; i < 300; ++i) {
    const Contact contact = any_contact(random);
    const double mu = std::pow(10.0, uniform(random, -2.0, 0.3)), e = uniform(random, 0.0, 1.0);
    const RestitutionOf measure = kMeasures[i % 3];
    const Vector3 J = frictional_impact(contact.a, contact.b, contact.normal, e, {mu, {}, measure}).impulse;
    const Vector3 coarse = impulse_by_small_steps(contact, e, mu, measure, 2000);
    const Vector3 fine = impulse_by_small_steps(contact, e, mu, measure, 4000);
    // of the first order: as far from it as the two are apart, with a margin for the step in which a phase ends
    EXPECT_LE((J - fine).norm(), 2.0 * (coarse - fine).norm() + 2e-3 * J.norm()) << i << " mu " << mu << " e " << e;
  }
}

/// Impulse and work of the normal impulse of a slide, in a parameter tau with dp = |u_t| dtau.
using Slide = Eigen::Vector4d;

/// Integrates a slide by the classical Runge-Kutta method; none where slip nearly stops.
class SmoothSlide {
 public:
  SmoothSlide(const Contact& contact, double e, double mu, RestitutionOf measure)
      : contact_(contact), e_(e), mu_(mu), measure_(measure) {}

  std::optional<Vector3> impulse() {
    double compliance = 0.0;
    for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)})
      compliance += contact_.a.compliance(axis) + contact_.b.compliance(axis);
    const double rate = (1.0 + mu_) * compliance;  // no part of the slip changes faster
    const double start = slip_of(contact_.velocity(), contact_.normal).norm();
    Slide slide = Slide::Zero();
    double target = 0.0;
    for (const bool compresses : {true, false}) {
      const auto has_ended = [&](const Slide& at) {
        const double speed = contact_.normal.dot(velocity(at));
        if (compresses || measure_ == RestitutionOf::speed) return speed >= target;
        return (measure_ == RestitutionOf::work ? at[3] : contact_.normal.dot(at.head<3>())) >= target;
      };
      double h = 1e-2 / rate;
      for (int i = 0; i < 50'000; ++i) {
        const Slide next = step(slide, h);
        if (!has_ended(next)) {
          slide = next;
        } else if ((h *= 0.5) < 1e-13 / rate) {
          break;
        }
        if (slip_of(velocity(slide), contact_.normal).norm() < 0.01 * start || i == 49'999) return std::nullopt;
      }
      target = measure_ == RestitutionOf::work      ? (1.0 - e_ * e_) * slide[3]
               : measure_ == RestitutionOf::impulse ? (1.0 + e_) * contact_.normal.dot(slide.head<3>())
                                                    : -e_ * contact_.normal.dot(contact_.velocity());
    }
    return slide.head<3>();
  }

 private:
  Vector3 velocity(const Slide& at) const {
    const After sides = after(contact_, at.head<3>());
    return sides.a.velocity_at_point() - sides.b.velocity_at_point();
  }
  Slide rate(const Slide& at) const {
    const Vector3 u = velocity(at), slip = slip_of(u, contact_.normal);
    Slide rate;
    rate << slip.norm() * contact_.normal - mu_ * slip, slip.norm() * contact_.normal.dot(u);
    return rate;
  }
  Slide step(const Slide& at, double h) const {
    const Slide a = rate(at), b = rate(at + 0.5 * h * a), c = rate(at + 0.5 * h * b), d = rate(at + h * c);
    return at + h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }

  const Contact& contact_;
  double e_, mu_;
  RestitutionOf measure_;
};

TEST(FrictionalImpact, SlidesAreRightToRounding) {
  Random random(31);
  int slides = 0;
  for (int i = 0; i < 200; ++i) {
    const Contact contact = any_contact(random, -0.5);
    const double mu = std::pow(10.0, uniform(random, -2.0, 0.0)), e = uniform(random, 0.1, 1.0);
    const RestitutionOf measure = kMeasures[i % 3];
    const std::optional<Vector3> expected = SmoothSlide(contact, e, mu, measure).impulse();
    if (!expected) continue;
    ++slides;
    const FrictionalImpact impact = frictional_impact(contact.a, contact.b, contact.normal, e, {mu, {}, measure});
    EXPECT_FALSE(impact.grips);
    // of the Runge-Kutta steps: 100 in the time in which slip changes, to the fourth power, and their rounding
    EXPECT_LE((impact.impulse - *expected).norm(), 1e-10 * expected->norm()) << i;
  }
  EXPECT_GT(slides, 30);
}

}  // namespace
}  // namespace trajet
