// The traps of contact detection, one by one: real failures of other simulators, and those that are easy to think of.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/collide/respond/restitution.hpp"

namespace trajet {
namespace {

const Vector3 kNone = Vector3::Zero();
const Vector3 kGravity(0.0, 0.0, -9.8);
const Shape kGround = make_plane(kNone, Vector3::UnitZ());

/// r + v tau + a tau^2 / 2 + j tau^3 / 6 from t0 to t1.
Segment<3> segment(double t0, double t1, const Vector3& r, const Vector3& v, const Vector3& a = kNone,
                   const Vector3& j = kNone) {
  Segment<3> s;
  s.resize(3, 3);
  s.set_interval(t0, t1);
  s.error_bound().setZero();
  s.coefficients() << r, v, 0.5 * a, j / 6.0;
  return s;
}

/// All contacts of a ball that passes through the shape, one after the other; the last is not a contact.
std::vector<ContactResult> contacts(const Segment<3>& s, const Shape& shape, double radius = 0.0,
                                    ContactMemory memory = {}) {
  const PointPath path(s, 0);
  std::vector<ContactResult> found;
  double from = s.t0();
  for (int i = 0; i < 100; ++i) {
    found.push_back(first_contact(shape, {path, radius, from, s.t1()}, memory));
    memory = found.back().memory;
    if (found.back().status != ContactStatus::hit && found.back().status != ContactStatus::graze) return found;
    from = found.back().time;
  }
  ADD_FAILURE() << "stuck at a contact";
  return found;
}

int count(const std::vector<ContactResult>& found, ContactStatus status = ContactStatus::hit) {
  return static_cast<int>(std::count_if(found.begin(), found.end(), [&](const auto& c) { return c.status == status; }));
}

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

/// The state of a parabola at t, as an integrator hands it on: rounded.
Segment<3> piece(const Segment<3>& whole, double t0, double t1) {
  Vector3 r, v, a;
  for (int i = 0; i < 3; ++i) {
    r[i] = whole.value(i, t0);
    v[i] = whole.derivative(i, t0);
  }
  a = 2.0 * whole.coefficients().col(2);
  return segment(t0, t1, r, v, a);
}

/// All contacts of a ball that passes through, along a chain of Segments.
std::vector<ContactResult> contacts_in_pieces(const Segment<3>& whole, const std::vector<double>& joints,
                                              const Shape& shape, double radius) {
  std::vector<ContactResult> found;
  ContactMemory memory;
  double t0 = whole.t0();
  for (std::size_t i = 0; i <= joints.size(); ++i) {
    const double t1 = i < joints.size() ? joints[i] : whole.t1();
    for (const ContactResult& contact : contacts(piece(whole, t0, t1), shape, radius, memory)) {
      memory = contact.memory;
      if (contact.status != ContactStatus::separated) found.push_back(contact);
    }
    t0 = t1;
  }
  return found;
}

TEST(Contact, AtAJointOfSegmentsExactlyOnce) {
  const Shape shapes[] = {kGround, make_disk({1, 0, 0}, {0.1, 0.2, 1}, 5.0), make_sphere({1, 0, -1}, 1.2),
                          make_box({1, 0, -0.5}, {4, 4, 1}, Matrix3::Identity())};
  std::mt19937 engine(9);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const Shape& shape : shapes) {
    for (int sample = 0; sample < 300; ++sample) {
      const double radius = sample % 2 == 0 ? 0.0 : 0.1;
      const Segment<3> whole = segment(0.0, 2.0, {uniform(engine), uniform(engine), 2.0 + uniform(engine)},
                                       {1.0 + uniform(engine), uniform(engine), 2.0 + uniform(engine)}, kGravity);
      std::vector<ContactResult> expected = contacts(whole, shape, radius);
      expected.pop_back();
      for (const ContactResult& contact : expected) {
        // Joints at the very impact and a few doubles beside it.
        for (int ulps = -3; ulps <= 3; ++ulps) {
          const double joint = contact.time + ulps * 0x1p-52 * contact.time;
          const auto found = contacts_in_pieces(whole, {joint}, shape, radius);
          ASSERT_EQ(found.size(), expected.size()) << shape.index() << " sample " << sample << " ulps " << ulps;
          for (std::size_t i = 0; i < found.size(); ++i) {
            // A joint shifts the path by the rounding of its state: a few 1e-16 m, at speeds above 0.01 m/s.
            EXPECT_NEAR(found[i].time, expected[i].time, 1e-13);
            EXPECT_EQ(found[i].direction, expected[i].direction);
          }
        }
      }
      std::vector<double> joints;
      for (double t = 0.1; t < 1.9; t += 0.1 + 0.09 * uniform(engine)) joints.push_back(t);
      EXPECT_EQ(contacts_in_pieces(whole, joints, shape, radius).size(), expected.size())
          << shape.index() << " " << sample;
    }
  }
}

TEST(Contact, ABouncingBallNeitherFallsThroughNorHitsTwice) {
  // DifferentialEquations 138: a ball fell through after the sixth bounce. Here 45 bounces, until they are 1.6e-6 s
  // apart.
  const double e = 0.75;
  const double g = 9.8;
  for (const double radius : {0.0, 0.3}) {
    double t = 0.0;
    Vector3 r(0, 0, 1.0 + radius);
    Vector3 v(1, 0, 0);
    ContactMemory memory;
    double expected = std::sqrt(2.0 / g);
    double flight = 2.0 * e * expected;
    for (int bounce = 0; bounce < 45; ++bounce) {
      const Segment<3> s = segment(t, t + 2.0, r, v, kGravity);
      const PointPath path(s, 0);
      const ContactResult contact = first_contact(kGround, {path, radius, t, s.t1()}, memory);
      ASSERT_EQ(contact.status, ContactStatus::hit) << bounce;
      // The speed at each bounce keeps the rounding of the one before: a relative error of a few eps each.
      EXPECT_NEAR(contact.time, expected, 1e-14 * (bounce + 1));
      expected += flight;
      flight *= e;
      t = contact.time;
      r = path.value(t - s.t0());
      v = rebound({s.derivative(0, t), s.derivative(1, t), s.derivative(2, t)}, contact.normal, e).velocity_after;
      memory = rebounded(contact.memory);
    }
  }
}

TEST(Contact, ABounceGoesOnToALaterHitInTheSameSegment) {
  // The law turns the body back into the wall right after the bounce: both are found.
  const Shape wall = make_plane(kNone, Vector3::UnitX());
  const ContactResult hit = contacts(segment(0.0, 1.0, {0.5, 0, 0}, {-1, 0, 0}), wall)[0];
  ASSERT_EQ(hit.time, 0.5);
  const Segment<3> after = segment(0.5, 1.5, hit.position, {1, 0, 0}, {-20, 0, 0});
  const auto again = contacts(after, wall, 0.0, rebounded(hit.memory));
  ASSERT_EQ(count(again), 1);
  EXPECT_NEAR(again[0].time, 0.6, 1e-15);
}

TEST(Contact, PressedIntoTheObstacleAfterABounceIsAHitAtOnce) {
  const ContactResult hit = contacts(segment(0.0, 1.0, {0, 0, 0.5}, {0, 0, -1}), kGround)[0];
  const auto again =
      contacts(segment(hit.time, 2.0, hit.position, kNone, kGravity), kGround, 0.0, rebounded(hit.memory));
  ASSERT_EQ(count(again), 1);
  EXPECT_EQ(again[0].time, hit.time);
}

TEST(Contact, WhatARoundedJointHidesIsAHitAtTheJoint) {
  // The last search ended before the plane, the next begins behind it.
  ContactMemory before;
  before.side = 1;
  const auto found = contacts(segment(2.0, 3.0, {0, 0, -1e-9}, {0, 0, -1}), kGround, 0.0, before);
  ASSERT_EQ(count(found), 1);
  EXPECT_EQ(found[0].time, 2.0);
  EXPECT_EQ(found[0].direction, ContactDirection::entering);
}

TEST(Contact, ASearchOfNoDurationKeepsWhatIsKnown) {
  const ContactResult hit = contacts(segment(0.0, 1.0, {0, 0, 1}, {0, 0, -1}), kGround)[0];
  ASSERT_EQ(hit.time, 1.0);
  const auto found = contacts(segment(1.0, 1.0, {0, 0, 0.5}, {0, 0, -1}), kGround, 0.0, hit.memory);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].status, ContactStatus::separated);
  EXPECT_EQ(found[0].memory.side, hit.memory.side);
  EXPECT_EQ(found[0].memory.contact_time, hit.memory.contact_time);
}

TEST(Contact, AHandledContactKeepsTheToleranceOfItsFlight) {
  // After a long fall the state is rounded more coarsely than its own size tells; here it leaves without speed.
  const ContactResult hit = contacts(segment(0.0, 60.0, {0, 0, 1e4}, {0, 0, 0}, kGravity), kGround)[0];
  ASSERT_EQ(hit.status, ContactStatus::hit);
  ASSERT_GT(hit.memory.tolerance, 1e-12);
  const Vector3 rounded(0, 0, -0.5 * hit.memory.tolerance);
  const auto after = contacts(segment(hit.time, 100.0, rounded, kNone, {0, 0, 1}), kGround, 0.0, rebounded(hit.memory));
  EXPECT_EQ(after.size(), 1u);
  EXPECT_EQ(after[0].status, ContactStatus::separated);
}

TEST(Contact, TangentToAPlaneFarFromTheOrigin) {
  // The heights cancel: the gap is rounded like them, to 2e-12 m at most.
  for (const double z : {0.1, 1000.1, 12345.6}) {
    const auto found = contacts(segment(0.0, 1.0, {0, 0, z + 1.225}, {3.0, 0, -4.9}, {0, 0, 9.8}),
                                make_plane({0, 0, z}, Vector3::UnitZ()));
    EXPECT_EQ(count(found, ContactStatus::graze), 1) << z;
    EXPECT_EQ(count(found), 0) << z;
  }
}

TEST(Contact, OffTheEdgeAfterAHitInThePlaneIsNoHit) {
  const Shape disk = make_disk(kNone, Vector3::UnitZ(), 1.0);
  const ContactResult edge = contacts(segment(0.0, 10.0, {-5, 0, 0}, {1, 0, 0}), disk)[0];
  ASSERT_EQ(edge.status, ContactStatus::hit);
  for (const double speed : {1.0, -1.0}) {
    const auto after =
        contacts(segment(edge.time, 9.0, edge.position, {-1, 0, speed}), disk, 0.0, rebounded(edge.memory));
    EXPECT_EQ(after.size(), 1u) << speed;
  }
}

TEST(Contact, TwoObstaclesAtOneTime) {
  const Segment<3> s = segment(0.0, 3.0, {0, 0, 1}, {1, 0, -1});
  const double plane = contacts(s, kGround)[0].time;
  const double disk = contacts(s, make_disk({1, 0, 0}, {-1, 0, 0}, 1.0))[0].time;
  EXPECT_EQ(plane, 1.0);
  EXPECT_EQ(disk, 1.0);
}

TEST(Rebound, ReflectsTheNormalVelocity) {
  const Rebound full = rebound({3, 0, -2}, Vector3::UnitZ(), 1.0);
  EXPECT_EQ(full.velocity_after, Vector3(3, 0, 2));
  EXPECT_EQ(full.impulse_per_mass, Vector3(0, 0, 4));
  EXPECT_EQ(rebound({3, 0, -2}, Vector3::UnitZ(), 0.0).velocity_after, Vector3(3, 0, 0));
  EXPECT_EQ(rebound({3, 0, -2}, Vector3::UnitZ(), 0.5).velocity_after, Vector3(3, 0, 1));
  EXPECT_EQ(rebound({3, 0, 2}, Vector3::UnitZ(), 1.0).velocity_after, Vector3(3, 0, 2));
}

}  // namespace
}  // namespace trajet
