// Balls that stay on surfaces: from sliding to rolling, and how long they roll, against closed forms.

#include <gtest/gtest.h>

#include <cmath>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::number;
using test::Way;
using test::vector;

constexpr double kGravity = 9.81, kRadius = 0.1, kMass = 0.5;

const std::vector<Way>& ways() {
  static const std::vector<Way> ways{test::controlled("taylor", 1e-13), test::controlled("dop853", 1e-12),
                                     test::fixed("rk4", 1e-2)};
  return ways;
}

std::string scene(const std::string& method, double end, const std::string& body, const std::string& obstacle) {
  return "[time]\nend = " + number(end) + "\n[method]\n" + method +
         "[[body]]\nname = \"ball\"\nshape = \"sphere\"\nradius = " + number(kRadius) + "\nmass = " + number(kMass) +
         "\nforce = " + vector(-kMass * kGravity * Vector3::UnitZ()) + "\n" + body +
         "[[obstacle]]\nname = \"ground\"\non_hit = \"bounce\"\nrestitution = 0\n" + obstacle;
}

const char kFloor[] = "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n";

std::string on_floor(const Vector3& velocity, const Vector3& spin = Vector3::Zero()) {
  return "position = [0, 0, " + number(kRadius) + "]\nvelocity = " + vector(velocity) +
         "\nangular_velocity = " + vector(spin) + "\n";
}

TEST(RollingContact, WhatSlidesRollsWithFiveSeventhsOfItsSpeed) {
  const double friction = 0.3, speed = 2.0;
  for (const Way& way : ways()) {
    SCOPED_TRACE(way.name);
    const RunResult result = test::run_text(
        scene(way.lines, 3.0, on_floor({speed, 0, 0}), kFloor + ("friction = " + number(friction)) + "\n"));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_EQ(result.contacts.size(), 2u);
    EXPECT_EQ(result.contacts[0].mode, ImpactKind::slide);
    EXPECT_EQ(result.contacts[1].mode, ImpactKind::roll);
    const double time = 2.0 * speed / (7.0 * friction * kGravity);
    EXPECT_NEAR(result.contacts[1].from, time, 1e-13);
    const BodyState& ball = test::final_of(result, "ball");
    EXPECT_NEAR((ball.velocity - 5.0 / 7.0 * speed * Vector3::UnitX()).norm(), 0.0, 1e-13);
    EXPECT_NEAR((ball.angular_velocity - ball.velocity.x() / kRadius * Vector3::UnitY()).norm(), 0.0, 1e-12);
    // 12/49 v^2/(mu g) while it slides
    EXPECT_NEAR(ball.position.x(),
                12.0 / 49.0 * speed * speed / (friction * kGravity) + 5.0 / 7.0 * speed * (3.0 - time), 1e-12);
    EXPECT_EQ(ball.position.z(), kRadius);
  }
}

TEST(RollingContact, BackSpinBringsItBack) {
  // v = (v0 + k R w0)/(1 + k), k = 2/5, at |v0 - R w0|/(mu g (1 + 1/k))
  const double friction = 0.2, speed = 1.0, spin = -60.0;
  for (const Way& way : ways()) {
    SCOPED_TRACE(way.name);
    const RunResult result = test::run_text(scene(way.lines, 3.0, on_floor({speed, 0, 0}, {0, spin, 0}),
                                                  kFloor + ("friction = " + number(friction)) + "\n"));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_EQ(result.contacts.size(), 2u);
    EXPECT_NEAR(result.contacts[1].from, (speed - kRadius * spin) / (friction * kGravity * 3.5), 1e-13);
    EXPECT_NEAR(test::final_of(result, "ball").velocity.x(), (speed + 0.4 * kRadius * spin) / 1.4, 1e-13);
  }
}

// The slip of a ball has a constant direction, whatever its spin: its path is a parabola until it rolls.
TEST(RollingContact, WithSideSpinItSlidesOnAParabola) {
  const double friction = 0.2;
  const Vector3 velocity(2, 0, 0), spin(30, 10, 40);
  const Vector3 slip = velocity + spin.cross(Vector3(0, 0, -kRadius));
  const double time = slip.norm() * 2.0 / (7.0 * friction * kGravity);
  for (const Way& way : ways()) {
    SCOPED_TRACE(way.name);
    const RunResult result = test::run_text(
        scene(way.lines, time, on_floor(velocity, spin), kFloor + ("friction = " + number(friction)) + "\n"));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    const Vector3 place = velocity * time - 0.5 * friction * kGravity * time * time * slip.normalized();
    const BodyState& ball = test::final_of(result, "ball");
    EXPECT_NEAR((ball.position - place - kRadius * Vector3::UnitZ()).norm(), 0.0, 1e-13);
    EXPECT_NEAR(ball.angular_velocity.z(), 40.0, 1e-12);
  }
}

TEST(RollingContact, DownAnInclineItRollsOrSlides) {
  for (const Way& way : ways())
    for (const double share : {0.9, 1.1}) {
      SCOPED_TRACE(way.name + number(share));
      const double angle = 0.7, friction = share * 2.0 / 7.0 * std::tan(angle), end = 1.5;
      const Vector3 normal(-std::sin(angle), 0, std::cos(angle)), down(-std::cos(angle), 0, -std::sin(angle));
      const RunResult result = test::run_text(scene(way.lines, end, "position = " + vector(kRadius * normal) + "\n",
                                                    "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = " + vector(normal) +
                                                        "\nfriction = " + number(friction) + "\n"));
      ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
      ASSERT_EQ(result.contacts.size(), 1u);
      EXPECT_EQ(result.contacts[0].mode, share > 1.0 ? ImpactKind::roll : ImpactKind::slide);
      const double pull = share > 1.0 ? 5.0 / 7.0 * kGravity * std::sin(angle)
                                      : kGravity * (std::sin(angle) - friction * std::cos(angle));
      EXPECT_NEAR(test::final_of(result, "ball").velocity.dot(down), pull * end, 1e-12);
    }
}

// Seen from outside, a ball that rolls on a turntable goes round a circle with 2/7 of the table's rate, wherever it
// starts: it comes back to its start.
TEST(RollingContact, OnATurntableItComesBack) {
  const double rate = 2.0;
  const double period = 2.0 * M_PI / (rate * 2.0 / 7.0);
  const std::string table =
      "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nangular_velocity = [0, 0, 2]\n"
      "friction = 2\n";
  for (const Way& way : {test::controlled("taylor", 1e-13), test::controlled("dop853", 1e-12)}) {
    SCOPED_TRACE(way.name);
    // it rolls from the start: the slip v + w x arm - table x r vanishes
    const Vector3 place(0.5, 0.2, kRadius), velocity(0.3, 0.1, 0);
    const Vector3 slip = velocity - Vector3(0, 0, rate).cross(place);
    const Vector3 w = Vector3(-slip.y(), slip.x(), 0) / kRadius;  // w x (0, 0, -R) = -slip
    const RunResult result = test::run_text(scene(
        way.lines, period,
        "position = " + vector(place) + "\nvelocity = " + vector(velocity) + "\nangular_velocity = " + vector(w) + "\n",
        table));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_EQ(result.contacts.size(), 1u);
    EXPECT_EQ(result.contacts[0].mode, ImpactKind::roll);
    const BodyState& ball = test::final_of(result, "ball");
    EXPECT_NEAR((ball.position - place).norm(), 0.0, 1e-10);
    EXPECT_NEAR((ball.velocity - velocity).norm(), 0.0, 1e-10);
  }
}

TEST(RollingContact, FromASphereItLeavesAtTenSeventeenths) {
  const double start = 0.05;
  const Vector3 place = (1.0 + kRadius) * Vector3(std::sin(start), 0, std::cos(start));
  const RunResult result =
      test::run_text(scene(test::controlled("taylor", 1e-13).lines, 6.0, "position = " + vector(place) + "\n",
                           "shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nfriction = 1000\n"));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  // as the force vanishes even this friction lets it slip, a little before: cos is off by less than 1/1000
  ASSERT_EQ(result.contacts.size(), 2u);
  EXPECT_EQ(result.contacts[0].mode, ImpactKind::roll);
  EXPECT_EQ(result.contacts[1].mode, ImpactKind::slide);
  const auto leaves = test::impacts_of(result, ImpactKind::leave);
  ASSERT_EQ(leaves.size(), 1u);
  EXPECT_NEAR(leaves[0]->position.z() / (1.0 + kRadius), 10.0 / 17.0 * std::cos(start), 1e-3);
}

TEST(RollingContact, RollingFrictionBringsItToRest) {
  // the torque rho N slows it down with a = rho g/R / (1 + k), k = 2/5
  const double rolling = 0.002, speed = 1.0;
  for (const Way& way : ways()) {
    SCOPED_TRACE(way.name);
    const RunResult result =
        test::run_text(scene(way.lines, 20.0, on_floor({speed, 0, 0}, {0, speed / kRadius, 0}),
                             kFloor + ("friction = 0.5\nrolling_friction = " + number(rolling)) + "\n"));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    const double slower = rolling * kGravity / kRadius / 1.4;
    ASSERT_EQ(result.contacts.size(), 2u);
    EXPECT_EQ(result.contacts[0].mode, ImpactKind::roll);
    EXPECT_EQ(result.contacts[1].mode, ImpactKind::rest);
    EXPECT_NEAR(result.contacts[1].from, speed / slower, 1e-10);
    const BodyState& ball = test::final_of(result, "ball");
    EXPECT_NEAR(ball.position.x(), 0.5 * speed * speed / slower, 1e-10);
    EXPECT_EQ(ball.velocity.norm(), 0.0);
  }
}

TEST(RollingContact, SpinningFrictionStopsATop) {
  // sigma N / I = 5 sigma g / (2 R^2)
  const double spinning = 0.001, spin = 20.0;
  const RunResult result =
      test::run_text(scene(test::controlled("taylor", 1e-13).lines, 20.0, on_floor(Vector3::Zero(), {0, 0, spin}),
                           kFloor + ("friction = 0.5\nspinning_friction = " + number(spinning)) + "\n"));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  EXPECT_NEAR(test::final_of(result, "ball").angular_velocity.norm(), 0.0, 1e-12);
  const RunResult half =
      test::run_text(scene(test::controlled("taylor", 1e-13).lines, 1.0, on_floor(Vector3::Zero(), {0, 0, spin}),
                           kFloor + ("friction = 0.5\nspinning_friction = " + number(spinning)) + "\n"));
  EXPECT_NEAR(test::final_of(half, "ball").angular_velocity.z(), spin - 2.5 * spinning * kGravity / (kRadius * kRadius),
              1e-12);
}

// A ball that rolls in a bowl is a pendulum of the length (R - r) with 7/5 of its mass: 7/10 v^2 + g z stays.
TEST(RollingContact, InABowlItRollsToAndFroWithoutLoss) {
  const double start = 1.0, length = 1.0 - kRadius;
  const Vector3 place = length * Vector3(std::sin(start), 0, -std::cos(start));
  const RunResult result =
      test::run_text(scene(test::controlled("taylor", 1e-13).lines, 10.0, "position = " + vector(place) + "\n",
                           "shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\ninside = true\nfriction = 5\n"));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_EQ(result.contacts.size(), 1u);
  EXPECT_EQ(result.contacts[0].mode, ImpactKind::roll);
  const BodyState& ball = test::final_of(result, "ball");
  EXPECT_NEAR(ball.position.norm(), length, 1e-11);
  EXPECT_NEAR(0.7 * ball.velocity.squaredNorm() + kGravity * ball.position.z(), kGravity * place.z(), 1e-10);
}

}  // namespace
}  // namespace trajet
