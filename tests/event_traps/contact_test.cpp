// The traps of contact detection, one by one: real failures of other simulators, and those that are easy to think of.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "parabola_contacts.hpp"

namespace trajet {
namespace {

using test::contacts;
using test::count;
using test::kGravity;
using test::kGround;
using test::kNone;
using test::segment;

TEST(Contact, PenetrationOfOneNanometreIsTwoHitsClearanceNone) {
  // The lowest point of a parabola at t = 1/2, for a point and, at the top of the same ball, a sphere.
  for (const double end : {1.0, 100.0}) {
    const auto at_depth = [&](double depth) {
      return segment(0.0, end, {0, 0, 1.225 - depth}, {3.0, 0, -4.9}, {0, 0, 9.8});
    };
    for (const double radius : {0.0, 0.1}) {
      const Shape floor = make_plane({0, 0, -radius}, Vector3::UnitZ());
      const auto twice = contacts(at_depth(1e-9), floor, radius);
      ASSERT_EQ(count(twice), 2);
      // 2 sqrt(2 depth / a); z is rounded to 2e-16 at a speed of 1.4e-4
      EXPECT_NEAR(twice[1].time - twice[0].time, 2.0 * std::sqrt(2e-9 / 9.8), 1e-11);
      EXPECT_EQ(contacts(at_depth(-1e-9), floor, radius).size(), 1u);
    }
    const auto graze = contacts(at_depth(0.0), kGround);
    EXPECT_EQ(count(graze, ContactStatus::graze), 1);
    EXPECT_EQ(count(graze), 0);
    EXPECT_NEAR(graze[0].time, 0.5, 1e-8);
  }
}

TEST(Contact, NanometresCountOnEveryShape) {
  // Over the top of each, at x = 0, flying along x on a parabola that bulges towards it.
  const Shape shapes[] = {make_sphere({0, 0, -1}, 1.0), make_box({0, 0, -1}, {2, 2, 2}, Matrix3::Identity()),
                          make_disk(kNone, Vector3::UnitZ(), 1.0),
                          make_rectangle(kNone, Vector3::UnitZ(), Vector3::UnitY(), 2, 2),
                          make_triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0})};
  for (const Shape& shape : shapes) {
    for (const double radius : {0.0, 0.25}) {
      const auto at_height = [&](double height) {
        return segment(0.0, 1.0, {-1.0, 0, radius + height + 0.25}, {2.0, 0, -1.0}, {0, 0, 2.0});
      };
      EXPECT_EQ(count(contacts(at_height(-1e-9), shape, radius)), 2) << shape.index() << " " << radius;
      EXPECT_EQ(contacts(at_height(1e-9), shape, radius).size(), 1u) << shape.index() << " " << radius;
      const auto graze = contacts(at_height(0.0), shape, radius);
      ASSERT_EQ(graze.size(), 2u) << shape.index() << " " << radius;
      EXPECT_EQ(graze[0].status, ContactStatus::graze) << shape.index() << " " << radius;
      EXPECT_NEAR(graze[0].time, 0.5, 1e-6);
      EXPECT_NEAR(graze[0].normal.z(), 1.0, 1e-6);
    }
  }
}

TEST(Contact, StartInContactAndMoveAwayIsNoHit) {
  for (const double noise : {0.0, 1e-17, -1e-17}) {
    const auto away = contacts(segment(0.0, 0.1, {0, 0, noise}, {0, 0, 1}, kGravity), kGround);
    EXPECT_EQ(away.size(), 1u);
    EXPECT_EQ(away[0].status, ContactStatus::separated);
    EXPECT_EQ(away[0].memory.side, 1);
    // But the later fall is a hit, once.
    const auto falls = contacts(segment(0.0, 1.0, {0, 0, noise}, {0, 0, 1}, kGravity), kGround);
    ASSERT_EQ(count(falls), 1);
    EXPECT_NEAR(falls[0].time, 2.0 / 9.8, 1e-15);
  }
}

TEST(Contact, StartInContactAndMoveInwardIsAHitAtTheStart) {
  const Shape ball = make_sphere({0, 0, -2}, 2.0);
  const Shape box = make_box({0, 0, -1}, {4, 4, 2}, Matrix3::Identity());
  for (const Shape& shape : {kGround, ball, box}) {
    for (const double radius : {0.0, 0.5}) {
      const auto in = contacts(segment(3.0, 3.1, {0, 0, radius}, {0.1, 0, -1}, kGravity), shape, radius);
      ASSERT_EQ(count(in), 1) << shape.index();
      EXPECT_EQ(in[0].time, 3.0);
      EXPECT_EQ(in[0].direction, ContactDirection::entering);
      EXPECT_NEAR(in[0].normal.z(), 1.0, 1e-12);
    }
  }
}

TEST(Contact, StartInContactAtRestTheAccelerationDecides) {
  EXPECT_EQ(contacts(segment(0.0, 1.0, kNone, {1, 0, 0}, {0, 0, 1}), kGround).size(), 1u);
  const auto falls = contacts(segment(0.0, 1.0, kNone, {1, 0, 0}, {0, 0, -1}), kGround);
  ASSERT_EQ(count(falls), 1);
  EXPECT_EQ(falls[0].time, 0.0);
  // and then the jerk
  EXPECT_EQ(count(contacts(segment(0.0, 1.0, kNone, {1, 0, 0}, kNone, {0, 0, 1}), kGround)), 0);
  EXPECT_EQ(count(contacts(segment(0.0, 1.0, kNone, {1, 0, 0}, kNone, {0, 0, -1}), kGround)), 1);
}

TEST(Contact, RestingOnThePlaneIsNoContactAndLiftingOffNeither) {
  const auto rests = contacts(segment(0.0, 1.0, kNone, {1, 0, 0}), kGround);
  ASSERT_EQ(rests.size(), 1u);
  const auto lifts = contacts(segment(1.0, 2.0, {1, 0, 0}, {1, 0, 0}, {0, 0, 1}), kGround, 0.0, rests[0].memory);
  EXPECT_EQ(lifts.size(), 1u);
  EXPECT_EQ(lifts[0].status, ContactStatus::separated);
}

TEST(Contact, StartInsideASolidIsSaid) {
  const auto status = [](const Shape& shape, const Vector3& at, double radius) {
    return contacts(segment(0.0, 1.0, at, {0, 0, 5}), shape, radius)[0].status;
  };
  EXPECT_EQ(status(kGround, {0, 0, -1e-9}, 0.0), ContactStatus::overlapping_at_start);
  EXPECT_EQ(status(kGround, {0, 0, 0.1 - 1e-9}, 0.1), ContactStatus::overlapping_at_start);
  EXPECT_EQ(status(make_sphere(kNone, 1.0), {0, 0, 1 - 1e-9}, 0.0), ContactStatus::overlapping_at_start);
  EXPECT_EQ(status(make_sphere(kNone, 1.0), kNone, 0.0), ContactStatus::overlapping_at_start);
  EXPECT_EQ(status(make_box(kNone, {2, 2, 2}, Matrix3::Identity()), {0.3, 0.2, 0.1}, 0.0),
            ContactStatus::overlapping_at_start);
  EXPECT_EQ(status(make_disk(kNone, Vector3::UnitZ(), 1.0), {0, 0, 0.1}, 0.2), ContactStatus::overlapping_at_start);
  EXPECT_EQ(status(make_disk(kNone, Vector3::UnitZ(), 1.0), {0, 0, 0.1}, 0.0), ContactStatus::separated);
}

TEST(Contact, AThinShapeIsHitFromBothSides) {
  const Shape disk = make_disk(kNone, Vector3::UnitZ(), 1.0);
  for (const double side : {1.0, -1.0}) {
    const auto found = contacts(segment(0.0, 1.0, {0, 0, 0.5 * side}, {0, 0, -side}), disk);
    ASSERT_EQ(count(found), 1);
    EXPECT_EQ(found[0].time, 0.5);
    EXPECT_EQ(found[0].direction, ContactDirection::through);
    EXPECT_EQ(found[0].normal.z(), side);
  }
  // A body that starts on it has moved away, whichever way it goes.
  for (const double speed : {1.0, -1.0}) EXPECT_EQ(contacts(segment(0.0, 1.0, kNone, {0, 0, speed}), disk).size(), 1u);
}

TEST(Contact, ThroughASolidInAndOut) {
  const auto found = contacts(segment(0.0, 10.0, {-5, 0, 0}, {1, 0, 0}), make_sphere(kNone, 1.0), 0.5);
  ASSERT_EQ(count(found), 2);
  EXPECT_NEAR(found[0].time, 3.5, 1e-14);
  EXPECT_NEAR(found[1].time, 6.5, 1e-14);
  EXPECT_EQ(found[0].direction, ContactDirection::entering);
  EXPECT_EQ(found[1].direction, ContactDirection::leaving);
  EXPECT_TRUE(found[0].point.isApprox(Vector3(-1, 0, 0), 1e-14));
  EXPECT_TRUE(found[0].normal.isApprox(Vector3(-1, 0, 0), 1e-14));
  EXPECT_TRUE(found[1].normal.isApprox(Vector3(-1, 0, 0), 1e-14));  // towards where it came from
}

TEST(Contact, EdgesAndCornersBelongToTheShape) {
  const Vector3 down(0, 0, -1);
  const auto hits = [&](const Shape& shape, double x, double y) {
    return count(contacts(segment(0.0, 3.0, {x, y, 1.7}, down), shape));
  };
  constexpr double kOutside = 1e-9;
  const Shape disk = make_disk({0.3, 0, 0}, Vector3::UnitZ(), 0.2);
  EXPECT_EQ(hits(disk, 0.3 + 0.2, 0), 1);
  EXPECT_EQ(hits(disk, 0.3 - 0.2, 0), 1);
  EXPECT_EQ(hits(disk, 0.5 + kOutside, 0), 0);
  const Shape rectangle = make_rectangle({0.3, 0, 0}, Vector3::UnitZ(), Vector3::UnitY(), 0.4, 0.2);
  EXPECT_EQ(hits(rectangle, 0.5, 0.1), 1);
  EXPECT_EQ(hits(rectangle, 0.5 + kOutside, 0.1), 0);
  EXPECT_EQ(hits(rectangle, 0.5, 0.1 + kOutside), 0);
  const Shape triangle = make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(hits(triangle, 0.3, 0.7), 1);
  EXPECT_EQ(hits(triangle, 1.0, 0.0), 1);
  EXPECT_EQ(hits(triangle, 0.3 + kOutside, 0.7), 0);
  // Down the edge of a box, and its corner hit in the direction of the diagonal.
  const Shape box = make_box({0.5, 0.5, -0.5}, {1, 1, 1}, Matrix3::Identity());
  const auto along_face = contacts(segment(0.0, 3.0, {0.5, 1.0, 1.7}, down), box);
  EXPECT_EQ(count(along_face) + count(along_face, ContactStatus::graze), 1);
  EXPECT_EQ(contacts(segment(0.0, 3.0, {0.5, 1.0 + kOutside, 1.7}, down), box).size(), 1u);
  const auto corner = contacts(segment(0.0, 3.0, {2, 2, 1}, {-1, -1, -1}), box);
  ASSERT_EQ(count(corner), 2);
  EXPECT_NEAR(corner[0].time, 1.0, 1e-14);
  EXPECT_TRUE(corner[0].point.isApprox(Vector3(1, 1, 0), 1e-14));
}

TEST(Contact, TheEdgesOfTheCoursesTarget) {
  // Erratum A16 of the notes: the angles at which the bullet meets the target's lowest and highest point exactly.
  const Shape target = make_disk({180, 0, 1}, {-1, 0, 0}, 0.2);
  for (const double degrees : {-0.020677382982079319, 0.106647121437685017}) {
    const double theta = degrees * M_PI / 180.0;
    const auto found =
        contacts(segment(0.0, 5.0, {0, 0, 1.5}, {500 * std::cos(theta), 0, 500 * std::sin(theta)}, kGravity), target);
    ASSERT_EQ(count(found), 1) << degrees;
    EXPECT_NEAR(found[0].time, 0.36 / std::cos(theta), 1e-15);
  }
}

TEST(Contact, AGrownEdgeIsRound) {
  // A ball that comes down beside a box: it touches the edge where the distance to it is the radius.
  const Shape box = make_box({0, 0, -1}, {2, 2, 2}, Matrix3::Identity());
  const auto found = contacts(segment(0.0, 2.0, {1.3, 0, 1}, {0, 0, -1}), box, 0.5);
  ASSERT_EQ(count(found), 1);
  EXPECT_NEAR(found[0].time, 1.0 - 0.4, 1e-14);  // 0.3, 0.4, 0.5
  EXPECT_TRUE(found[0].point.isApprox(Vector3(1, 0, 0), 1e-14));
  EXPECT_TRUE(found[0].normal.isApprox(Vector3(0.6, 0, 0.8), 1e-14));
  // A corner: sqrt(0.2^2 + 0.1^2 + 0.2^2) = 0.3
  const auto corner = contacts(segment(0.0, 2.0, {1.2, 1.1, 1}, {0, 0, -1}), box, 0.3);
  ASSERT_GE(count(corner), 1);
  EXPECT_NEAR(corner[0].time, 1.0 - 0.2, 1e-14);
  // Past the corner at the distance of a face, where a box grown with sharp corners would be hit.
  EXPECT_EQ(contacts(segment(0.0, 2.0, {1.25, 1.25, 1}, {0, 0, -1}), box, 0.3).size(), 1u);
}

TEST(Contact, InThePlaneOfAThinShapeItsEdgeIsHit) {
  const Shape shapes[] = {make_disk(kNone, Vector3::UnitZ(), 1.0),
                          make_rectangle(kNone, Vector3::UnitZ(), Vector3::UnitY(), 2, 4),
                          make_triangle({-1, -2, 0}, {1, 0, 0}, {-1, 2, 0})};
  for (const Shape& shape : shapes) {
    const auto found = contacts(segment(0.0, 10.0, {-5, 0, 0}, {1, 0, 0}), shape);
    ASSERT_EQ(count(found), 2) << shape.index();
    EXPECT_NEAR(found[0].time, 4.0, 1e-13);
    EXPECT_NEAR(found[1].time, 6.0, 1e-13);
    EXPECT_TRUE(found[0].normal.isApprox(Vector3(-1, 0, 0), 1e-12));
    // Sliding off from a start on it is none.
    EXPECT_EQ(contacts(segment(0.0, 10.0, kNone, {1, 0, 0}), shape).size(), 1u) << shape.index();
  }
}

TEST(Contact, TripleRootIsOneHit) {
  // z = -(t - 1/2)^3: rate and acceleration vanish at the crossing
  const auto found = contacts(segment(0.0, 1.0, {0, 0, 0.125}, {1, 0, -0.75}, {0, 0, 3.0}, {0, 0, -6.0}), kGround);
  EXPECT_EQ(count(found), 1);
  EXPECT_NEAR(found[0].time, 0.5, found[0].time_error_bound);
}

TEST(Contact, SeparatingFromATangentStartIsNoHit) {
  // pooltool 354: balls that touch at t = 0, without relative acceleration, were reported at a false t = 0
  const Shape sphere = make_sphere(kNone, 1.0);
  EXPECT_EQ(contacts(segment(0.0, 9.0, {1.5, 0, 0}, {0, 1, 0}), sphere, 0.5).size(), 1u);
  EXPECT_EQ(contacts(segment(0.0, 9.0, {1.5, 0, 0}, {1, 1, 0}), sphere, 0.5).size(), 1u);
  EXPECT_EQ(count(contacts(segment(0.0, 9.0, {1.5, 0, 0}, {-1, 1, 0}), sphere, 0.5)), 2);
}

TEST(Contact, BackwardInTime) {
  const auto found = contacts(segment(1.0, -4.0, {0, 0, 2.0}, {1, 0, 1.0}), kGround);
  ASSERT_EQ(count(found), 1);
  EXPECT_EQ(found[0].time, -1.0);
  EXPECT_EQ(found[0].direction, ContactDirection::entering);
}

TEST(Contact, LateTimesAndFarPlacesDoNotDisturb) {
  for (const double t0 : {0.0, 1e3, 1e6}) {
    for (const double x : {0.0, 1e4}) {
      const auto found = contacts(segment(t0, t0 + 4.0, {x, 0, 1}, {500, 0, 4.9}, kGravity), kGround);
      ASSERT_EQ(count(found), 1);
      EXPECT_NEAR(found[0].time - t0, 0.5 + std::sqrt(0.25 + 2.0 / 9.8), 1e-14 + 2e-16 * t0);
    }
  }
}

TEST(Contact, TheErrorBoundKnowsTheSegmentsError) {
  Segment<3> s = segment(0.0, 1.0, {0, 0, 1}, {0, 0, -2});
  s.error_bound() = Vector3(0, 0, 1e-6);
  EXPECT_NEAR(contacts(s, kGround)[0].time_error_bound, 0.5e-6, 1e-12);
}

TEST(Contact, WhatIsNotFiniteIsUnresolved) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Shape shapes[] = {kGround, make_disk(kNone, Vector3::UnitX(), 1.0), make_sphere(kNone, 1.0),
                          make_box(kNone, {1, 1, 1}, Matrix3::Identity())};
  for (const Shape& shape : shapes) {
    for (const double radius : {0.0, 0.1}) {
      EXPECT_EQ(contacts(segment(0.0, 1.0, {nan, nan, nan}, {1, 0, 0}), shape, radius)[0].status,
                ContactStatus::unresolved);
      EXPECT_EQ(contacts(segment(0.0, 1.0, {5, 5, 5}, {1, 0, 0}, {nan, nan, nan}), shape, radius)[0].status,
                ContactStatus::unresolved);
    }
  }
}

}  // namespace
}  // namespace trajet
