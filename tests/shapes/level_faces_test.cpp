// Solids that lie flat on a round face: where they come to rest, how they slide and turn, and what is not followed.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "body_scene.hpp"
#include "scene_run.hpp"

namespace trajet {
namespace {

using test::final_of;
using test::impacts_of;
using test::number;
using test::run_text;

constexpr double kG = 9.81;

std::string on_table(const std::string& body, double friction, double end, const std::string& more = "") {
  return "[time]\nend = " + number(end) + "\n[[body]]\nname = \"b\"\n" + body +
         "\nacceleration = [0, 0, -9.81]\n[[obstacle]]\nname = \"table\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal "
         "= "
         "[0, 0, 1]\non_hit = \"bounce\"\nrestitution = 0.5\nfriction = " +
         number(friction) + "\n" + more;
}

struct Lying {
  const char* shape;
  double height;  // of the centre of mass
  double radius;  // of the face
};
const Lying kLying[] = {
    {"shape = \"cylinder\"\nradius = 0.05\nheight = 0.02\nmass = 0.3\n", 0.01, 0.05},
    {"shape = \"disk\"\nradius = 0.05\nmass = 0.3\n", 0.0, 0.05},
    {"shape = \"cone\"\nradius = 0.05\nheight = 0.04\ndensity = 800\n", 0.01, 0.05},
    {"shape = \"cylinder\"\nradius = 0.05\nheight = 0.02\nrounding = 0.004\nmass = 0.3\n", 0.01, 0.046},
};

std::string at(double height) { return "position = [0, 0, " + number(height) + "]\n"; }

// Dropped flat: flights of 2 e^k u/g, all over at t1 (1 + e)/(1 - e), and from then on nothing moves.
TEST(LevelFaces, ComeToRestAtTheEndOfTheirFlights) {
  for (const Lying& body : kLying) {
    const RunResult result = run_text(on_table(body.shape + at(body.height + 0.1), 0.3, 50.0));
    ASSERT_EQ(result.status, RunStatus::finished) << body.shape << result.failure;
    const auto rests = impacts_of(result, ImpactKind::rest);
    ASSERT_EQ(rests.size(), 1u) << body.shape;
    EXPECT_NEAR(rests[0]->time, std::sqrt(0.2 / kG) * 3.0, 1e-9) << body.shape;
    ASSERT_EQ(result.contacts.size(), 1u);
    EXPECT_FALSE(result.contacts[0].to);
    const BodyState& end = final_of(result, "b");
    EXPECT_NEAR(end.position.z(), body.height, 1e-14) << body.shape;
    EXPECT_EQ(end.velocity, Vector3(0, 0, 0));
    EXPECT_EQ(end.angular_velocity, Vector3(0, 0, 0));
    EXPECT_EQ(end.acceleration, Vector3(0, 0, 0));
  }
}

// Without spin friction is mu m g: it stops after v/(mu g), v^2/(2 mu g) from where it began.
TEST(LevelFaces, SlideAndStop) {
  const double mu = 0.2, v = 1.5;
  for (const Lying& body : kLying) {
    const RunResult result = run_text(on_table(body.shape + at(body.height) + "velocity = [1.2, 0.9, 0]\n", mu, 3.0));
    ASSERT_EQ(result.status, RunStatus::finished) << body.shape << result.failure;
    const auto rests = impacts_of(result, ImpactKind::rest);
    ASSERT_EQ(rests.size(), 1u) << body.shape;
    EXPECT_NEAR(rests[0]->time, v / (mu * kG), 1e-12) << body.shape;
    const double way = v * v / (2.0 * mu * kG);
    EXPECT_LE((final_of(result, "b").position - Vector3(0.8 * way, 0.6 * way, body.height)).norm(), 1e-12);
    ASSERT_EQ(result.contacts.size(), 2u);
    EXPECT_EQ(result.contacts[0].mode, ImpactKind::slide);
    EXPECT_EQ(result.contacts[1].mode, ImpactKind::rest);
  }
}

// Turning on the spot the rim has the torque mu m g R, so that a cylinder of I = m r^2/2 stops after w R/(2 mu g).
TEST(LevelFaces, SpinAndStop) {
  const double mu = 0.2, w = 30.0;
  const RunResult result = run_text(on_table(kLying[0].shape + at(0.01) + "angular_velocity = [0, 0, 30]\n", mu, 2.0));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  const auto rests = impacts_of(result, ImpactKind::rest);
  ASSERT_EQ(rests.size(), 1u);
  EXPECT_NEAR(rests[0]->time, w * 0.05 / (2.0 * mu * kG), 1e-10);
  EXPECT_LE(final_of(result, "b").position.head<2>().norm(), 1e-13);
}

struct Planar {
  double vx, vy, w;
};

/// The rates of a ring that bears N (1 + a x + b y)/(2 pi) on its rim, with centre of mass h above it: a, b of the
/// moments that keep it level. I: moment about the axis, per mass.
Planar ring_rate(const Planar& s, double mu, double R, double h, double I) {
  constexpr int kPoints = 4096;
  double a = 0.0, b = 0.0, fx = 0.0, fy = 0.0, torque = 0.0;
  for (int round = 0; round < 60; ++round) {
    fx = fy = torque = 0.0;
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kPoints, x = R * std::cos(angle), y = R * std::sin(angle);
      const double ux = s.vx - s.w * y, uy = s.vy + s.w * x, u = std::hypot(ux, uy);
      const double n = kG * (1.0 + a * x + b * y) / kPoints;
      fx -= mu * n * ux / u;
      fy -= mu * n * uy / u;
      torque += mu * n * (y * ux - x * uy) / u;
    }
    // about the horizontal axes: sum of r x f is zero; N's moment is g R^2/2 (b, -a)
    a = -2.0 * h * fx / (kG * R * R);
    b = -2.0 * h * fy / (kG * R * R);
  }
  return {fx, fy, torque / I};
}

// A stone that slides and turns: the law of a ring, integrated apart from trajet by Runge and Kutta's method. The two
// differ by what sixteen points are from a ring, (v/(w R))^16.
TEST(LevelFaces, SlideAndTurnAsARing) {
  const double mu = 0.1, R = 0.05, h = 0.01, end = 0.4;
  Planar s{1.0, 0.0, 8.0};
  double x = 0.0, y = 0.0;
  constexpr int kSteps = 200;
  const double dt = end / kSteps;
  const auto moved = [](const Planar& a, const Planar& d, double by) {
    return Planar{a.vx + by * d.vx, a.vy + by * d.vy, a.w + by * d.w};
  };
  for (int i = 0; i < kSteps; ++i) {
    const auto rate = [&](const Planar& at) { return ring_rate(at, mu, R, h, 0.5 * R * R); };
    const Planar k1 = rate(s), s2 = moved(s, k1, 0.5 * dt), k2 = rate(s2), s3 = moved(s, k2, 0.5 * dt), k3 = rate(s3),
                 s4 = moved(s, k3, dt), k4 = rate(s4);
    x += dt / 6.0 * (s.vx + 2.0 * s2.vx + 2.0 * s3.vx + s4.vx);
    y += dt / 6.0 * (s.vy + 2.0 * s2.vy + 2.0 * s3.vy + s4.vy);
    const Planar sum{k1.vx + 2.0 * k2.vx + 2.0 * k3.vx + k4.vx, k1.vy + 2.0 * k2.vy + 2.0 * k3.vy + k4.vy,
                     k1.w + 2.0 * k2.w + 2.0 * k3.w + k4.w};
    s = moved(s, sum, dt / 6.0);
  }
  const RunResult result =
      run_text(on_table(kLying[0].shape + at(h) + "velocity = [1, 0, 0]\nangular_velocity = [0, 0, 8]\n", mu, end));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  const BodyState& b = final_of(result, "b");
  EXPECT_LE((b.velocity - Vector3(s.vx, s.vy, 0.0)).norm(), 1e-5);
  EXPECT_NEAR(b.angular_velocity.z(), s.w, 1e-4);
  EXPECT_LE((b.position - Vector3(x, y, h)).norm(), 1e-5);
  // what is in front bears more: a stone that turns to the left is pushed to the right
  EXPECT_LT(b.velocity.y(), -1e-3);
}

// Below the angle of friction it holds, above it slides with g (sin a - mu cos a).
TEST(LevelFaces, OnAnIncline) {
  const double mu = 0.5;
  for (const double degrees : {10.0, 26.5, 26.6, 27.0, 35.0}) {
    const double a = degrees * std::numbers::pi / 180.0, faster = kG * (std::sin(a) - mu * std::cos(a));
    const std::string body = kLying[0].shape + at(0.01) + "";
    const RunResult result = run_text("[time]\nend = 1\n[[body]]\nname = \"b\"\n" + body + "acceleration = [" +
                                      number(kG * std::sin(a)) + ", 0, " + number(-kG * std::cos(a)) +
                                      "]\n[[obstacle]]\nname = \"slope\"\nshape = \"plane\"\npoint = [0, 0, 0]\n"
                                      "normal = [0, 0, 1]\non_hit = \"bounce\"\nfriction = 0.5\n");
    ASSERT_EQ(result.status, RunStatus::finished) << degrees << result.failure;
    EXPECT_NEAR(final_of(result, "b").position.x(), std::max(0.0, 0.5 * faster), 1e-12) << degrees;
    ASSERT_FALSE(result.contacts.empty());
    EXPECT_EQ(result.contacts[0].mode, faster > 0.0 ? ImpactKind::slide : ImpactKind::rest);
  }
}

// On a turntable it goes round with it as long as friction holds: mu g > w^2 r.
TEST(LevelFaces, RideOnATurntable) {
  const RunResult result = run_text(
      "[time]\nend = 2\n[[body]]\nname = \"b\"\n" + std::string(kLying[0].shape) +
      "position = [0.5, 0, 0.01]\nvelocity = [0, 0.75, 0]\nangular_velocity = [0, 0, 1.5]\nacceleration = [0, 0, "
      "-9.81]\n"
      "[[obstacle]]\nname = \"turntable\"\nshape = \"cylinder\"\ncenter = [0, 0, -0.1]\nradius = 1\nheight = 0.2\n"
      "angular_velocity = [0, 0, 1.5]\non_hit = \"bounce\"\nrestitution = 0.5\nfriction = 0.3\n");
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  const BodyState& b = final_of(result, "b");
  EXPECT_LE((b.position - Vector3(0.5 * std::cos(3.0), 0.5 * std::sin(3.0), 0.01)).norm(), 1e-10);
  EXPECT_NEAR(b.angular_velocity.z(), 1.5, 1e-10);
}

TEST(LevelFaces, WhatIsNotFollowedIsSaid) {
  // a tall cylinder tips where friction's moment is more than the rim's: mu h/2 > R
  const std::string tall = "shape = \"cylinder\"\nradius = 0.05\nheight = 0.6\nmass = 1\nposition = [0, 0, 0.3]\n";
  RunResult result = run_text(on_table(tall + "velocity = [1, 0, 0]\n", 0.2, 1.0));
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_NE(result.failure.find("tips over the rim"), std::string::npos) << result.failure;
  // less than that it slides, exactly up to the rim
  result = run_text(on_table(tall + "velocity = [1, 0, 0]\n", 0.05 / 0.3 - 1e-6, 1.0));
  EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
  result = run_text(on_table(tall + "velocity = [1, 0, 0]\n", 0.05 / 0.3 + 1e-6, 1.0));
  EXPECT_EQ(result.status, RunStatus::failed);
  // over an edge
  result = run_text("[time]\nend = 3\n[[body]]\nname = \"b\"\n" + std::string(kLying[0].shape) +
                    "position = [0, 0, 0.01]\nvelocity = [2, 0, 0]\nacceleration = [0, 0, -9.81]\n[[obstacle]]\nname = "
                    "\"block\"\nshape = \"box\"\ncenter = [0, 0, -0.5]\nsize = [2, 2, 1]\non_hit = \"bounce\"\n"
                    "friction = 0.1\n");
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_NE(result.failure.find("comes over the edge"), std::string::npos) << result.failure;
}

}  // namespace
}  // namespace trajet
