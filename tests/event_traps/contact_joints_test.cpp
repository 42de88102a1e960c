// Contacts where Segments join, and behind a contact that was handled: each exactly once.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "parabola_contacts.hpp"
#include "trajet/collide/respond/restitution.hpp"

namespace trajet {
namespace {

using test::contacts;
using test::count;
using test::kGravity;
using test::kGround;
using test::kNone;
using test::segment;

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

TEST(ContactJoints, AtAJointOfSegmentsExactlyOnce) {
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

TEST(ContactJoints, ABouncingBallNeitherFallsThroughNorHitsTwice) {
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

TEST(ContactJoints, ABounceGoesOnToALaterHitInTheSameSegment) {
  // The law turns the body back into the wall right after the bounce: both are found.
  const Shape wall = make_plane(kNone, Vector3::UnitX());
  const ContactResult hit = contacts(segment(0.0, 1.0, {0.5, 0, 0}, {-1, 0, 0}), wall)[0];
  ASSERT_EQ(hit.time, 0.5);
  const Segment<3> after = segment(0.5, 1.5, hit.position, {1, 0, 0}, {-20, 0, 0});
  const auto again = contacts(after, wall, 0.0, rebounded(hit.memory));
  ASSERT_EQ(count(again), 1);
  EXPECT_NEAR(again[0].time, 0.6, 1e-15);
}

TEST(ContactJoints, PressedIntoTheObstacleAfterABounceIsAHitAtOnce) {
  const ContactResult hit = contacts(segment(0.0, 1.0, {0, 0, 0.5}, {0, 0, -1}), kGround)[0];
  const auto again =
      contacts(segment(hit.time, 2.0, hit.position, kNone, kGravity), kGround, 0.0, rebounded(hit.memory));
  ASSERT_EQ(count(again), 1);
  EXPECT_EQ(again[0].time, hit.time);
}

TEST(ContactJoints, WhatARoundedJointHidesIsAHitAtTheJoint) {
  // The last search ended before the plane, the next begins behind it.
  ContactMemory before;
  before.side = 1;
  const auto found = contacts(segment(2.0, 3.0, {0, 0, -1e-9}, {0, 0, -1}), kGround, 0.0, before);
  ASSERT_EQ(count(found), 1);
  EXPECT_EQ(found[0].time, 2.0);
  EXPECT_EQ(found[0].direction, ContactDirection::entering);
}

TEST(ContactJoints, ASearchOfNoDurationKeepsWhatIsKnown) {
  const ContactResult hit = contacts(segment(0.0, 1.0, {0, 0, 1}, {0, 0, -1}), kGround)[0];
  ASSERT_EQ(hit.time, 1.0);
  const auto found = contacts(segment(1.0, 1.0, {0, 0, 0.5}, {0, 0, -1}), kGround, 0.0, hit.memory);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].status, ContactStatus::separated);
  EXPECT_EQ(found[0].memory.side, hit.memory.side);
  EXPECT_EQ(found[0].memory.contact_time, hit.memory.contact_time);
}

TEST(ContactJoints, AHandledContactKeepsTheToleranceOfItsFlight) {
  // After a long fall the state is rounded more coarsely than its own size tells; here it leaves without speed.
  const ContactResult hit = contacts(segment(0.0, 60.0, {0, 0, 1e4}, {0, 0, 0}, kGravity), kGround)[0];
  ASSERT_EQ(hit.status, ContactStatus::hit);
  ASSERT_GT(hit.memory.tolerance, 1e-12);
  const Vector3 rounded(0, 0, -0.5 * hit.memory.tolerance);
  const auto after = contacts(segment(hit.time, 100.0, rounded, kNone, {0, 0, 1}), kGround, 0.0, rebounded(hit.memory));
  EXPECT_EQ(after.size(), 1u);
  EXPECT_EQ(after[0].status, ContactStatus::separated);
}

TEST(ContactJoints, TangentToAPlaneFarFromTheOrigin) {
  // The heights cancel: the gap is rounded like them, to 2e-12 m at most.
  for (const double z : {0.1, 1000.1, 12345.6}) {
    const auto found = contacts(segment(0.0, 1.0, {0, 0, z + 1.225}, {3.0, 0, -4.9}, {0, 0, 9.8}),
                                make_plane({0, 0, z}, Vector3::UnitZ()));
    EXPECT_EQ(count(found, ContactStatus::graze), 1) << z;
    EXPECT_EQ(count(found), 0) << z;
  }
}

TEST(ContactJoints, OffTheEdgeAfterAHitInThePlaneIsNoHit) {
  const Shape disk = make_disk(kNone, Vector3::UnitZ(), 1.0);
  const ContactResult edge = contacts(segment(0.0, 10.0, {-5, 0, 0}, {1, 0, 0}), disk)[0];
  ASSERT_EQ(edge.status, ContactStatus::hit);
  for (const double speed : {1.0, -1.0}) {
    const auto after =
        contacts(segment(edge.time, 9.0, edge.position, {-1, 0, speed}), disk, 0.0, rebounded(edge.memory));
    EXPECT_EQ(after.size(), 1u) << speed;
  }
}

TEST(ContactJoints, TwoObstaclesAtOneTime) {
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
