// Thin disks that move: their mass, their first contacts against closed forms, and what impacts make of them.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "body_scene.hpp"
#include "scene_run.hpp"

namespace trajet {
namespace {

using test::error_of;
using test::final_of;
using test::impacts_of;
using test::number;
using test::run_text;
using test::vector;

std::string scene(const std::string& body, const std::string& rest = "", double end = 1.0) {
  return "[time]\nend = " + number(end) + "\n[[body]]\nname = \"d\"\n" + body + "\n" + rest;
}

TEST(DiskBodies, HaveTheInertiaOfAThinDisk) {
  // m r^2/4, m r^2/4, m r^2/2 with m = 3, r = 0.2
  const std::string moments[] = {"", "inertia = [0.03, 0.03, 0.06]\n"};
  BodyState ends[2];
  for (int i = 0; i < 2; ++i)
    ends[i] = final_of(run_text(scene("shape = \"disk\"\nradius = 0.2\nmass = 3\nangular_velocity = [1, 2, 3]\n"
                                      "torque = \"[0.1*t, 0, 0.02]\"\n" +
                                      moments[i])),
                       "d");
  EXPECT_LE((ends[0].rotation_matrix - ends[1].rotation_matrix).norm(), 1e-13);
  EXPECT_LE((ends[0].angular_velocity - ends[1].angular_velocity).norm(), 1e-12);
  // about a diameter from rest: w = T t/(m r^2/4)
  const BodyState turned =
      final_of(run_text(scene("shape = \"disk\"\nradius = 0.2\nmass = 3\ntorque = [0.06, 0, 0]\n")), "d");
  EXPECT_NEAR(turned.angular_velocity.x(), 2.0, 1e-12);
}

TEST(DiskBodies, InACompoundCountByTheirMass) {
  // a wheel of two disks, 0.5 kg each, 0.1 m to either side: I_x = 2 (m r^2/4 + m d^2), I_z = 2 m r^2/2
  const std::string wheel =
      "shape = \"compound\"\nparts = [{shape = \"disk\", radius = 0.2, mass = 0.5, position = [0, 0, 0.1]},"
      " {shape = \"disk\", radius = 0.2, mass = 0.5, position = [0, 0, -0.1]}]\n";
  const BodyState w = final_of(run_text(scene(wheel + "torque = [0.02, 0, 0]\n")), "d");
  EXPECT_NEAR(w.angular_velocity.x(), 0.02 / (2 * (0.5 * 0.04 / 4 + 0.5 * 0.01)), 1e-11);
  const BodyState z = final_of(run_text(scene(wheel + "torque = [0, 0, 0.02]\n")), "d");
  EXPECT_NEAR(z.angular_velocity.z(), 1.0, 1e-12);
  // on a floor it stands on the rims: upright its lowest points are r below
  const std::string floor = test::plane("floor", Vector3(0, 0, 0), Vector3(0, 0, 1), 0.5);
  const RunResult fall = run_text(scene(wheel + "position = [0, 0, 1.2]\norientation = {axis = [1, 0, 0], angle = "
                                                "\"90 deg\"}\nacceleration = [0, 0, -2]\n",
                                        floor, 1.5));
  ASSERT_FALSE(fall.impacts.empty());
  EXPECT_NEAR(fall.impacts[0].time, 1.0, 1e-12);
}

TEST(DiskBodies, RefuseWhatAFlatThingDoesNotHave) {
  const std::string disk = "shape = \"disk\"\nradius = 0.2\n";
  struct {
    std::string body, place, words;
  } const cases[] = {
      {disk + "density = 3", "s:7:11", "is flat and has no volume: give `mass`"},
      {disk + "rounding = 0.01", "s:4:8", "no thickness"},
      {disk + "height = 0.01", "s:7:1", "unknown key 'height'"},
      {"shape = \"disk\"\nradius = -1", "s:6:10", "must be positive"},
      {"shape = \"compound\"\nparts = [{shape = \"disk\", radius = 1, density = 2}]", "s:6:49", "give `mass`"},
      {"shape = \"compound\"\nmass = 1\nparts = [{shape = \"disk\", radius = 1}]", "s:4:8", "a volume, or a mass"},
      {"shape = \"dsik\"\nradius = 1", "s:5:9", "did you mean 'disk'"},
  };
  for (const auto& c : cases) {
    const std::string message = error_of(scene(c.body));
    EXPECT_TRUE(message.starts_with(c.place)) << message << "\n  for:\n" << c.body;
    EXPECT_NE(message.find(c.words), std::string::npos) << message << "\n  for:\n" << c.body;
  }
}

/// How deep the lowest point of a disk is below its middle, where its axis is `n`.
double depth(const Vector3& n, double radius) { return radius * n.head<2>().norm(); }

// The height of a spinning disk's lowest point over a floor is z - r sqrt(n_x^2 + n_y^2): its first zero, by a fine
// walk and halving, against the first contact.
TEST(DiskBodies, MeetAPlaneWhereTheirLowestPointDoes) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  constexpr double kRadius = 0.3;
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3 w = 12.0 * Vector3(uniform(random), uniform(random), uniform(random));
    const Vector3 axis = Vector3(uniform(random), uniform(random), uniform(random)).normalized();
    const double angle = 3.0 * uniform(random), start = 0.8 + 0.3 * uniform(random), speed = uniform(random);
    const auto gap = [&](double t) {
      const Matrix3 R = Eigen::AngleAxisd(w.norm() * t, w.normalized()).toRotationMatrix() *
                        Eigen::AngleAxisd(angle, axis).toRotationMatrix();
      return start + speed * t - 4.0 * t * t - depth(R.col(2), kRadius);
    };
    double expected = -1.0;
    constexpr int kSteps = 20000;
    for (int k = 0; k < kSteps && expected < 0.0; ++k) {
      double a = static_cast<double>(k) / kSteps, b = static_cast<double>(k + 1) / kSteps;
      if (gap(b) > 0.0) continue;
      for (int halving = 0; halving < 60; ++halving) (gap(0.5 * (a + b)) > 0.0 ? a : b) = 0.5 * (a + b);
      expected = b;
    }
    const std::string body = "shape = \"disk\"\nradius = " + number(kRadius) + "\nposition = [0, 0, " + number(start) +
                             "]\nvelocity = [0.2, 0, " + number(speed) + "]\nacceleration = [0, 0, -8]\n" +
                             "angular_velocity = " + vector(w) + "\norientation = {axis = " + vector(axis) +
                             ", angle = " + number(angle) + "}\n";
    const RunResult result = run_text(
        scene(body, "[[obstacle]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"));
    if (expected < 0.0) {
      EXPECT_TRUE(result.impacts.empty()) << i;
      continue;
    }
    ++hits;
    ASSERT_EQ(result.impacts.size(), 1u) << i;
    EXPECT_NEAR(result.impacts[0].time, expected, 1e-11) << i;
    EXPECT_NEAR(result.impacts[0].point.z(), 0.0, 1e-11) << i;
  }
  EXPECT_GT(hits, 150);
}

// On its rim, tilted by 30 degrees, without friction: J = (1 + e) m u/(1 + m (r cos a)^2/I), I = m r^2/4 about the
// diameter that turns, and the disk turns by J r cos a/I.
TEST(DiskBodies, BounceOnTheirRim) {
  const double e = 0.6, a = std::acos(-1.0) / 6.0, r = 0.1, m = 0.4, u = 2.0;
  const std::string body = "shape = \"disk\"\nradius = 0.1\nmass = 0.4\nposition = [0, 0, " +
                           number(r * std::sin(a) + 1.0) + "]\nvelocity = [0, 0, -2]\n" +
                           "orientation = {axis = [0, 1, 0], angle = \"30 deg\"}\n";
  const RunResult result =
      run_text(scene(body, test::plane("floor", Vector3(0, 0, 0), Vector3(0, 0, 1), e), 0.5 + 1e-6));
  ASSERT_EQ(result.impacts.size(), 1u);
  const double arm = r * std::cos(a), inertia = m * r * r / 4.0;
  const double impulse = (1.0 + e) * u / (1.0 / m + arm * arm / inertia);
  const Impact& impact = result.impacts[0];
  EXPECT_NEAR(impact.time, 0.5, 1e-13);
  EXPECT_NEAR(impact.impulse.z(), impulse, 1e-12);
  EXPECT_NEAR(impact.velocity_after.z(), impulse / m - u, 1e-12);
  EXPECT_NEAR(std::abs(impact.angular_velocity_after.y()), impulse * arm / inertia, 1e-10);
}

// Of a disk and balls that meet without friction and loss, momentum, angular momentum and energy stay.
TEST(DiskBodies, MeetBallsAndEachOther) {
  const std::string others =
      "restitution = 1\n[[body]]\nname = \"ball\"\nshape = \"sphere\"\nradius = 0.1\nmass = 0.3\nposition = [0.15, "
      "0.1, "
      "0.6]\nvelocity = [0, 0, -2]\nangular_velocity = [0, 0, 0]\n"
      "[[body]]\nname = \"other\"\nshape = \"disk\"\nradius = 0.2\nmass = 0.5\nposition = [-0.1, 0.05, -0.7]\n"
      "velocity = [0, 0, 2.5]\nangular_velocity = [1, 4, 0.5]\n";
  const RunResult result = run_text(
      scene("shape = \"disk\"\nradius = 0.3\nmass = 0.8\nangular_velocity = [0.5, -0.4, 3]\n" + others, "", 1.0));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_GE(impacts_of(result, ImpactKind::hit).size(), 2u);
  const auto sums = [](const BodyState& s, double mass, const Vector3& moments, Vector3& p, Vector3& l,
                       double& energy) {
    const Matrix3 inertia = s.rotation_matrix * Matrix3(moments.asDiagonal()) * s.rotation_matrix.transpose();
    p += mass * s.velocity;
    l += mass * s.position.cross(s.velocity) + inertia * s.angular_velocity;
    energy += 0.5 * mass * s.velocity.squaredNorm() + 0.5 * s.angular_velocity.dot(inertia * s.angular_velocity);
  };
  const auto flat = [](double m, double r) { return Vector3(0.25 * m * r * r, 0.25 * m * r * r, 0.5 * m * r * r); };
  const double ball = 0.4 * 0.3 * 0.01;
  Vector3 p = Vector3::Zero(), l = Vector3::Zero(), p0 = Vector3::Zero(), l0 = Vector3::Zero();
  double energy = 0.0, energy0 = 0.0;
  const auto start = [](const Vector3& r, const Vector3& v, const Vector3& w) {
    BodyState s;
    s.position = r;
    s.velocity = v;
    s.angular_velocity = w;
    return s;
  };
  sums(start({0, 0, 0}, {0, 0, 0}, {0.5, -0.4, 3}), 0.8, flat(0.8, 0.3), p0, l0, energy0);
  sums(start({0.15, 0.1, 0.6}, {0, 0, -2}, {0, 0, 0}), 0.3, Vector3::Constant(ball), p0, l0, energy0);
  sums(start({-0.1, 0.05, -0.7}, {0, 0, 2.5}, {1, 4, 0.5}), 0.5, flat(0.5, 0.2), p0, l0, energy0);
  sums(final_of(result, "d"), 0.8, flat(0.8, 0.3), p, l, energy);
  sums(final_of(result, "ball"), 0.3, Vector3::Constant(ball), p, l, energy);
  sums(final_of(result, "other"), 0.5, flat(0.5, 0.2), p, l, energy);
  EXPECT_LE((p - p0).norm(), 1e-12);
  EXPECT_LE((l - l0).norm(), 1e-11);
  EXPECT_NEAR(energy, energy0, 1e-11);
}

}  // namespace
}  // namespace trajet
