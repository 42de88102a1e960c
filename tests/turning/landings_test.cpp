// Contacts by construction: flat, on edges, on corners, along parallel edges. Time, place, normal and features are
// known.

#include <gtest/gtest.h>

#include <numbers>

#include "random_flights.hpp"

namespace trajet::turning {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGravity = 9.81;

Quaternion about(const Vector3& axis, double angle) { return from_axis_angle<double>(axis, angle); }

/// `core` falls from rest, its origin at `height`, not turning, over `other` at rest at the origin.
Encounter fall(const ConvexCore& core, const Quaternion& q, const Vector3& r, const ConvexCore& other,
               const Quaternion& q_other = Quaternion::Identity()) {
  Encounter e;
  e.to = 1.0;
  e.a.core = core;
  e.b.core = other;
  FramePath::Coefficients c = FramePath::Coefficients::Zero(7, 3);
  c.col(0) << r, q.w(), q.x(), q.y(), q.z();
  c(2, 2) = -0.5 * kGravity;
  e.a.flight = {FramePath(0.0, 1.0, c)};
  rest(e.b, Vector3::Zero(), q_other);
  return e;
}

double fall_time(double drop) { return std::sqrt(2.0 * drop / kGravity); }

void expect_landing(const TurningContact& c, double drop, Feature a, Feature b, std::size_t corners) {
  ASSERT_EQ(c.status, ContactStatus::hit);
  const double t = fall_time(drop);
  EXPECT_NEAR(c.time, t, 4e-15);
  EXPECT_LE(std::abs(c.time - t), c.time_error_bound + 1e-16);
  EXPECT_NEAR(c.gap_rate, -kGravity * t, 1e-12);
  EXPECT_LT((c.normal - Vector3::UnitZ()).norm(), 1e-12);
  EXPECT_EQ(c.feature_a, a);
  EXPECT_EQ(c.feature_b, b);
  EXPECT_EQ(c.points.size(), corners);
}

const ConvexCore kGround = convex_core(HalfSpace{});
const ConvexCore kBrick = convex_core(Cuboid{{0.3, 0.2, 0.1}});
const ConvexCore kTable = convex_core(Cuboid{{0.5, 0.4, 0.2}});

TEST(Landing, FlatOnAPlane) {
  const TurningContact c = search(fall(kBrick, Quaternion::Identity(), {0.1, 0.2, 0.6}, kGround));
  expect_landing(c, 0.5, Feature::face, Feature::face, 4);
  EXPECT_LT((c.point - Vector3(0.1, 0.2, 0)).norm(), 1e-12);
  for (const Vector3& p : c.points) EXPECT_NEAR(std::abs(p.z()), 0.0, 1e-12);
}

TEST(Landing, OnAnEdgeAndACornerOfAPlane) {
  const double angle = 0.7;
  const double height = 0.2 * std::sin(angle) + 0.1 * std::cos(angle);
  expect_landing(search(fall(kBrick, about(Vector3::UnitX(), angle), {0, 0, height + 0.5}, kGround)), 0.5,
                 Feature::edge, Feature::face, 2);
  const Quaternion q = about(Vector3(1, 2, 0).normalized(), 0.6);
  double lowest = 0.0;
  for (const Vector3& p : kBrick.vertices) lowest = std::min(lowest, rotate<double>(q, p).z());
  expect_landing(search(fall(kBrick, q, {0, 0, 0.5 - lowest}, kGround)), 0.5, Feature::vertex, Feature::face, 0);
}

TEST(Landing, FlatOnABoxSharesTheOverlapOfBothFaces) {
  // beside the middle, so that a rectangle is shared; turned, so that it has eight corners
  const TurningContact aligned = search(fall(kBrick, Quaternion::Identity(), {0.4, 0, 0.8}, kTable));
  expect_landing(aligned, 0.5, Feature::face, Feature::face, 4);
  EXPECT_LT((aligned.point - Vector3(0.3, 0, 0.2)).norm(), 1e-9);
  const ConvexCore square = convex_core(Cuboid{{0.2, 0.2, 0.1}});
  const TurningContact turned =
      search(fall(square, about(Vector3::UnitZ(), kPi / 4), {0, 0, 0.8}, convex_core(Cuboid{{0.2, 0.2, 0.2}})));
  expect_landing(turned, 0.5, Feature::face, Feature::face, 8);
}

TEST(Landing, TiltsFarBelowTheMarginChangeTheTimeNoMoreThanTheyMust) {
  for (const double tilt : {1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2})
    for (const double turn : {0.0, 0.3, kPi / 2}) {
      const Quaternion q = about(Vector3(1, 0.5, 0.3).normalized(), tilt) * about(Vector3::UnitZ(), turn);
      double lowest = 0.0;
      for (const Vector3& p : kBrick.vertices) lowest = std::min(lowest, rotate<double>(q, p).z());
      const TurningContact c = search(fall(kBrick, q, {0, 0, 0.7}, kTable));
      ASSERT_EQ(c.status, ContactStatus::hit) << tilt;
      EXPECT_NEAR(c.time, fall_time(0.5 + lowest), std::max(1e-14, c.time_error_bound)) << tilt << ' ' << turn;
      EXPECT_LT(c.time_error_bound, 1e-10);
    }
}

TEST(Landing, EdgeOnFaceEdgeOnEdgeCornerOnCorner) {
  const double height = 0.2 * std::sin(0.7) + 0.1 * std::cos(0.7);
  expect_landing(search(fall(kBrick, about(Vector3::UnitX(), 0.7), {0, 0, 0.2 + height + 0.5}, kTable)), 0.5,
                 Feature::edge, Feature::face, 2);
  // an octagonal ridge on a ridge, crossed and along each other
  const ConvexCore cube = convex_core(Cuboid{{0.2, 0.2, 0.2}});
  const double ridge = 0.2 * std::sqrt(2.0);
  const Quaternion along_x = about(Vector3::UnitX(), kPi / 4);
  const Encounter crossed =
      fall(cube, about(Vector3::UnitZ(), 1.0) * along_x, {0.02, 0.03, 2 * ridge + 0.5}, cube, along_x);
  expect_landing(search(crossed), 0.5, Feature::edge, Feature::edge, 0);
  const TurningContact along = search(fall(cube, along_x, {0.1, 0, 2 * ridge + 0.5}, cube, along_x));
  ASSERT_EQ(along.status, ContactStatus::hit);
  EXPECT_NEAR(along.time, fall_time(0.5), 1e-14);
  // corner on corner: the normal is open
  const Quaternion on_tip = Quaternion::FromTwoVectors(Vector3(1, 1, 1), Vector3::UnitZ());
  const double tip = 0.2 * std::sqrt(3.0);
  const TurningContact corners = search(fall(cube, on_tip, {0, 0, 2 * tip + 0.5}, cube, on_tip));
  ASSERT_EQ(corners.status, ContactStatus::hit);
  EXPECT_NEAR(corners.time, fall_time(0.5), 1e-13);
  EXPECT_LT((corners.point - Vector3(0, 0, tip)).norm(), 1e-9);
}

TEST(Landing, EdgesThatAreNearlyParallel) {
  const ConvexCore cube = convex_core(Cuboid{{0.2, 0.2, 0.2}});
  const double ridge = 0.2 * std::sqrt(2.0);
  const Quaternion along_x = about(Vector3::UnitX(), kPi / 4);
  for (const double angle : {1e-2, 1e-4, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12, 1e-14, 1e-16}) {
    const Encounter e = fall(cube, about(Vector3::UnitZ(), angle) * along_x, {0, 0, 2 * ridge + 0.5}, cube, along_x);
    const TurningContact c = search(e);
    ASSERT_EQ(c.status, ContactStatus::hit) << angle;
    EXPECT_NEAR(c.time, fall_time(0.5), std::max(1e-10, c.time_error_bound)) << angle;
  }
}

TEST(Landing, SpinningAboutTheVerticalLandsFlat) {
  for (const double spin : {0.1, 10.0, 1000.0}) {
    Encounter e;
    e.to = 0.5;
    e.a.core = kBrick;
    e.a.inertia = Vector3::Ones();
    set_flight(e.a, free_state({0, 0, 0.6}, Vector3::Zero(), Quaternion::Identity(), {0, 0, spin}), kGravity, 0.0, 0.5);
    e.b.core = kGround;
    rest(e.b, Vector3::Zero(), Quaternion::Identity());
    const TurningContact c = search(e);
    ASSERT_EQ(c.status, ContactStatus::hit) << spin;
    EXPECT_NEAR(c.time, fall_time(0.5), std::max(1e-14, c.time_error_bound));
    EXPECT_EQ(c.points.size(), 4U);
  }
}

TEST(Landing, RoundedSolidsTouchWithTheirSurface) {
  const TurningContact capsule =
      search(fall(convex_core(Capsule{0.1, 0.3}), about(Vector3::UnitY(), kPi / 2), {0, 0, 0.6}, kGround));
  expect_landing(capsule, 0.5, Feature::surface, Feature::face, 2);
  expect_landing(search(fall(convex_core(Ball{0.1}), Quaternion::Identity(), {0, 0, 0.6}, kGround)), 0.5,
                 Feature::surface, Feature::face, 0);
  // two capsules across each other, and a ball on a ball
  const Encounter across = fall(convex_core(Capsule{0.1, 0.3}), about(Vector3::UnitY(), kPi / 2), {0, 0, 0.75},
                                convex_core(Capsule{0.15, 0.3}), about(Vector3::UnitX(), kPi / 2));
  expect_landing(search(across), 0.5, Feature::surface, Feature::surface, 0);
  expect_landing(search(fall(convex_core(Ball{0.1}), Quaternion::Identity(), {0, 0, 0.8}, convex_core(Ball{0.2}))), 0.5,
                 Feature::surface, Feature::surface, 0);
}

}  // namespace
}  // namespace trajet::turning
