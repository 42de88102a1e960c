// The bounds of the times of contacts: of rounding, against a hundred digits; of the path's error, against paths that
// are off by that error.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bounds/exact.hpp"
#include "trajet/collide/detect/contact_table.hpp"

namespace trajet {
namespace {

using test::Coverage;
using test::Random;
using test::Real;

using RealVector = std::array<Real, 3>;

Real dot(const Vector3& a, const RealVector& b) { return Real(a.x()) * b[0] + Real(a.y()) * b[1] + Real(a.z()) * b[2]; }
Real norm(const RealVector& x) { return sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }
RealVector from(const Vector3& origin, const RealVector& x) {
  return {x[0] - Real(origin.x()), x[1] - Real(origin.y()), x[2] - Real(origin.z())};
}

/// The gap of a point to a shape, of the numbers that the shape has.
Real gap_of(const Plane& plane, const RealVector& x) { return dot(plane.normal, from(plane.point, x)); }
Real gap_of(const Sphere& sphere, const RealVector& x) { return norm(from(sphere.center, x)) - Real(sphere.radius); }
Real gap_of(const Box& box, const RealVector& x) {
  const RealVector q = from(box.center, x);
  Real gap = -1e30;
  for (int i = 0; i < 3; ++i) {
    const Real face = abs(dot(box.R_WB.col(i), q)) - Real(box.half_size[i]);
    if (face > gap) gap = face;
  }
  return gap;
}
Real gap_of(const Triangle& triangle, const RealVector& x) {
  return dot(triangle.normal, from(triangle.corners[0], x));
}

/// A path in powers of the time since t0.
struct Motion {
  double t0 = 0.0;
  double duration = 1.0;
  std::array<std::vector<double>, 3> components;

  RealVector position(const Real& t) const {
    const Real tau = t - Real(t0);
    RealVector x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = test::evaluate(std::span<const double>(components[i]), tau);
    return x;
  }
  Segment<3> segment(const Vector3& error_bound) const {
    Segment<3> s;
    s.resize(3, static_cast<int>(components[0].size()) - 1);
    s.set_interval(t0, t0 + duration);
    s.error_bound() = error_bound;
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index k = 0; k < s.coefficients().cols(); ++k)
        s.coefficients()(i, k) = components[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
    return s;
  }
};

/// From a point outside towards the origin and on, on a curve.
Motion random_motion(Random& random, double latest_start) {
  Motion motion;
  motion.t0 = random.uniform(0.0, latest_start);
  const int degree = random.integer(1, 6);
  for (std::vector<double>& component : motion.components) {
    component = random.coefficients(degree, 0.3);
    component[0] = random.scaled(1.0, 3.0);
    component[1] = -2.0 * component[0] + random.uniform(-0.3, 0.3);
  }
  return motion;
}

struct Case {
  Shape shape;
  std::function<Real(const RealVector&)> gap;
};
template <class S>
Case make_case(const S& shape) {
  return {shape, [shape](const RealVector& x) { return gap_of(shape, x); }};
}

Matrix3 random_rotation(Random& random) {
  return Quaternion(random.uniform(0.1, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                    random.uniform(-1.0, 1.0))
      .normalized()
      .toRotationMatrix();
}

using MakeCase = std::function<Case(Random&)>;
struct Kind {
  const char* name;
  double radius;  ///< of the ball; the cases are of its centre
  MakeCase make;
};

std::vector<Kind> kinds() {
  return {
      {"point, plane", 0.0,
       [](Random& r) {
         return make_case(make_plane(Vector3::Constant(r.uniform(-0.2, 0.2)), random_rotation(r).col(0)));
       }},
      {"point, sphere", 0.0,
       [](Random& r) { return make_case(make_sphere(Vector3::Constant(r.uniform(-0.2, 0.2)), r.uniform(0.3, 0.9))); }},
      {"point, box", 0.0,
       [](Random& r) {
         return make_case(make_box(Vector3::Constant(r.uniform(-0.2, 0.2)), {0.5, 0.7, 0.9}, random_rotation(r)));
       }},
      {"point, triangle", 0.0,
       [](Random& r) {
         const Matrix3 R = random_rotation(r);
         return make_case(
             make_triangle(5.0 * R.col(0), -5.0 * R.col(0) + 5.0 * R.col(1), -5.0 * R.col(0) - 5.0 * R.col(1)));
       }},
      {"ball, sphere", 0.25,
       [](Random& r) {
         const Sphere sphere = make_sphere(Vector3::Constant(r.uniform(-0.2, 0.2)), r.uniform(0.3, 0.9));
         return Case{sphere, [sphere](const RealVector& x) { return Real(gap_of(sphere, x) - Real(0.25)); }};
       }},
      {"ball, plane", 0.25,
       [](Random& r) {
         const Plane plane = make_plane(Vector3::Constant(r.uniform(-0.2, 0.2)), random_rotation(r).col(0));
         return Case{plane, [plane](const RealVector& x) { return Real(gap_of(plane, x) - Real(0.25)); }};
       }},
  };
}

std::optional<ContactResult> first_hit(const Segment<3>& segment, const Case& c, double radius, double start_error) {
  const PointPath path(segment, 0);
  const MovingBall ball{
      .path = path, .radius = radius, .from = segment.t0(), .to = segment.t1(), .start_error = start_error};
  const ContactResult contact = first_contact(c.shape, ball);
  EXPECT_NE(contact.status, ContactStatus::unresolved);
  if (contact.status != ContactStatus::hit) return std::nullopt;
  return contact;
}

/// Rounding alone: of the path, of the shape's numbers, of the search.
TEST(ContactBounds, RoundingIsWithinTheTimesErrorBound) {
  for (const Kind& kind : kinds()) {
    Random random(31);
    Coverage coverage;
    int found = 0;
    for (int sample = 0; sample < 1200; ++sample) {
      const Case c = kind.make(random);
      const Motion motion = random_motion(random, sample % 2 == 0 ? 0.0 : 10.0);
      const auto hit = first_hit(motion.segment(Vector3::Zero()), c, kind.radius, 0.0);
      if (!hit) continue;
      ++found;
      const Real exact = test::root_near([&](const Real& t) { return c.gap(motion.position(t)); }, hit->time,
                                         2.0 * hit->time_error_bound);
      ASSERT_FALSE(isnan(exact)) << kind.name << " " << sample;
      coverage.add(std::abs(static_cast<double>(Real(hit->time) - exact)), hit->time_error_bound);
    }
    std::printf("%-16s %4d hits, largest |error| / bound %.4f\n", kind.name, found, coverage.largest());
    EXPECT_GT(found, 300) << kind.name;
    EXPECT_LE(coverage.largest(), 1.0) << kind.name;
    EXPECT_GE(coverage.largest(), 0.1) << kind.name;
  }
}

/// A fast path along a plane: what the products n . x leave of its height is mostly rounding.
TEST(ContactBounds, RoundingOfAFlatApproachIsWithinTheTimesErrorBound) {
  Random random(34);
  Coverage coverage;
  int found = 0;
  for (int sample = 0; sample < 2000; ++sample) {
    const Matrix3 R = random_rotation(random);
    const Case c = make_case(make_plane(100.0 * R.col(1), R.col(0)));
    const double start = random.uniform(-1e3, 1e3);
    const double acceleration = random.uniform(0.0, 1e3);
    Motion motion;
    for (int i = 0; i < 3; ++i)
      motion.components[static_cast<std::size_t>(i)] = {start * R(i, 1) + R(i, 0), 1e3 * R(i, 1) - 2.0 * R(i, 0),
                                                        acceleration * R(i, 1)};
    const auto hit = first_hit(motion.segment(Vector3::Zero()), c, 0.0, 0.0);
    if (!hit) continue;
    ++found;
    const Real exact = test::root_near([&](const Real& t) { return c.gap(motion.position(t)); }, hit->time,
                                       2.0 * hit->time_error_bound);
    ASSERT_FALSE(isnan(exact)) << sample;
    coverage.add(std::abs(static_cast<double>(Real(hit->time) - exact)), hit->time_error_bound);
  }
  std::printf("flat approach    %4d hits, largest |error| / bound %.4f\n", found, coverage.largest());
  EXPECT_GT(found, 500);
  EXPECT_LE(coverage.largest(), 1.0);
  EXPECT_GE(coverage.largest(), 0.1);
}

/// A path that is off by all that its Segment and its start may be off, towards the obstacle or away, reaches it just
/// as much earlier or later as the bound says.
TEST(ContactBounds, ThePathsErrorIsTheTimesErrorBound) {
  for (const Kind& kind : kinds()) {
    Random random(32);
    Coverage coverage;
    for (int sample = 0; sample < 600; ++sample) {
      const Case c = kind.make(random);
      const Motion motion = random_motion(random, 0.0);
      const Vector3 step_error =
          1e-8 * Vector3(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0), random.uniform(0.0, 1.0));
      const double start_error = sample % 3 == 0 ? 0.0 : random.uniform(0.0, 1e-8);
      const auto hit = first_hit(motion.segment(step_error), c, kind.radius, start_error);
      if (!hit) continue;
      const double off = step_error.norm() + start_error;
      // a slow approach is bent by more than the rate tells: the next test
      const auto gap = [&](const Real& t) { return c.gap(motion.position(t)); };
      const double h = 1e-4;
      const double rate = static_cast<double>((gap(Real(hit->time) + h) - gap(Real(hit->time) - h)) / (2.0 * h));
      const double curvature = static_cast<double>(
          (gap(Real(hit->time) + h) - 2 * gap(Real(hit->time)) + gap(Real(hit->time) - h)) / (h * h));
      if (rate * rate < 100.0 * off * std::abs(curvature)) continue;
      for (const double side : {-1.0, 1.0}) {
        const auto gap_of_moved = [&](const Real& t) {
          RealVector x = motion.position(t);
          for (int i = 0; i < 3; ++i) x[static_cast<std::size_t>(i)] += Real(side * off * hit->normal[i]);
          return c.gap(x);
        };
        const Real moved = test::root_near(gap_of_moved, hit->time, 2.0 * hit->time_error_bound);
        ASSERT_FALSE(isnan(moved)) << kind.name << " " << sample;
        coverage.add(std::abs(static_cast<double>(moved - Real(hit->time))), hit->time_error_bound);
      }
    }
    std::printf("%-16s largest |error| / bound %.4f\n", kind.name, coverage.largest());
    EXPECT_LE(coverage.largest(), 1.01) << kind.name;  // the bound is of first order
    EXPECT_GE(coverage.largest(), 0.98) << kind.name;
  }
}

/// A graze moves by sqrt(2 dx / |z''|) where the path is off by dx.
TEST(ContactBounds, OfAGrazeIsTheTimeInWhichThePathLeavesItsError) {
  const Shape shapes[] = {make_plane(Vector3::Zero(), Vector3::UnitZ()),
                          make_box({0, 0, -1}, {2, 2, 2}, Matrix3::Identity())};
  for (const Shape& shape : shapes)
    for (const double off : {1e-6, 1e-8}) {
      Motion motion;
      motion.components = {{{0.0, 0.5, 0.0}, {0.0, 0.0, 0.0}, {1.25, -5.0, 5.0}}};
      const Segment<3> segment = motion.segment({0.0, 0.0, off});
      const PointPath path(segment, 0);
      const ContactResult graze = first_contact(shape, {path, 0.0, 0.0, 1.0});
      ASSERT_EQ(graze.status, ContactStatus::graze);
      EXPECT_NEAR(graze.time_error_bound, std::sqrt(2.0 * off / 10.0), 1e-7 + 0.01 * std::sqrt(off / 5.0));
    }
}

/// What a touch from behind looks like to a body that comes back to its side: none of its contacts.
TEST(ContactBounds, ATouchFromTheOtherSideIsNoGraze) {
  const Shape ground = make_plane(Vector3::Zero(), Vector3::UnitZ());
  Motion motion;  // z = -(t - 1/2)^2
  motion.components = {{{0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}, {-0.25, 1.0, -1.0}}};
  const Segment<3> segment = motion.segment(Vector3::Zero());
  const PointPath path(segment, 0);
  ContactMemory memory;
  memory.side = 1;
  memory.contact_time = 0.0;
  EXPECT_EQ(first_contact(ground, {path, 0.0, 0.0, 1.0}, memory).status, ContactStatus::separated);
  memory.side = -1;
  EXPECT_EQ(first_contact(ground, {path, 0.0, 0.0, 1.0}, memory).status, ContactStatus::graze);
}

/// The course's ways to locate a contact between two step ends: how far they are off, they say to first order.
TEST(ContactBounds, StepEndLocatorsSayHowFarTheyAreOff) {
  const Shape ground = make_plane(Vector3::Zero(), Vector3::UnitZ());
  for (const Locator locator : {Locator::interpolation, Locator::subdivision}) {
    Random random(33);
    Coverage coverage;
    for (int sample = 0; sample < 500; ++sample) {
      Motion motion;
      const double height = random.uniform(0.05, 0.5);
      const double speed = random.uniform(1.0, 3.0);
      motion.components = {{{0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}, {height, -speed, random.uniform(-0.3, 0.3)}}};
      const Segment<3> segment = motion.segment(Vector3::Zero());
      const PointPath path(segment, 0);
      const ContactResult hit =
          first_contact(ground, {.path = path, .radius = 0.0, .from = 0.0, .to = 1.0, .locator = locator});
      ASSERT_EQ(hit.status, ContactStatus::hit);
      const Real exact = test::root_near([&](const Real& t) { return motion.position(t)[2]; }, hit.time, 0.5);
      coverage.add(std::abs(static_cast<double>(Real(hit.time) - exact)), hit.time_error_bound);
      if (locator == Locator::subdivision) {
        EXPECT_LE(hit.time_error_bound, 2e-9);
      }
    }
    EXPECT_LE(coverage.largest(), 1.1);
    EXPECT_GE(coverage.largest(), 0.9);
  }
}

}  // namespace
}  // namespace trajet
