// Points that stay on surfaces: what slides, what sticks, what flies off, against closed forms.

#include <gtest/gtest.h>

#include <cmath>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::number;
using test::Way;

constexpr double kGravity = 9.81;

const std::vector<Way>& ways() {
  static const std::vector<Way> ways{test::controlled("taylor", 1e-13), test::controlled("dopri5", 1e-11),
                                     test::controlled("dop853", 1e-12), test::fixed("rk4", 1e-3)};
  return ways;
}

std::string scene(const std::string& method, double end, const std::string& body, const std::string& obstacle) {
  return "[time]\nend = " + number(end) + "\n[method]\n" + method +
         "[[body]]\nname = \"block\"\nacceleration = [0, 0, " + number(-kGravity) + "]\n" + body +
         "[[obstacle]]\nname = \"ground\"\non_hit = \"bounce\"\nrestitution = 0\n" + obstacle;
}

std::string incline(double angle, double friction) {
  return "shape = \"plane\"\npoint = [0, 0, 0]\nnormal = [" + number(-std::sin(angle)) + ", 0, " +
         number(std::cos(angle)) + "]\nfriction = " + number(friction) + "\n";
}

const ContactSpan& contact(const RunResult& result, std::size_t i) { return result.contacts.at(i); }

TEST(SlidingContact, OnAnInclineItSticksBelowTheAngleOfFrictionAndSlidesAboveIt) {
  for (const Way& way : ways())
    for (const double angle : {0.1, 0.5, 1.2})
      for (const double share : {0.5, 0.999999, 1.000001, 2.0}) {
        SCOPED_TRACE(way.name + " " + number(angle) + " " + number(share));
        const double friction = share * std::tan(angle);
        const RunResult result =
            test::run_text(scene(way.lines, 2.0, "position = [0, 0, 0]\n", incline(angle, friction)));
        ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
        ASSERT_EQ(result.contacts.size(), 1u);
        EXPECT_EQ(contact(result, 0).mode, share > 1.0 ? ImpactKind::rest : ImpactKind::slide);
        // s = g (sin - mu cos) t^2 / 2, down
        const double pull = share > 1.0 ? 0.0 : kGravity * (std::sin(angle) - friction * std::cos(angle));
        const BodyState& block = test::final_of(result, "block");
        // of gravity's parts, rounded: a few of 1e-16 of g in the pull, times t^2; and of each of 2000 steps
        EXPECT_NEAR((block.position + 2.0 * pull * Vector3(std::cos(angle), 0, std::sin(angle))).norm(), 0.0, 1e-12);
        EXPECT_TRUE(share < 1.0 || block.velocity.norm() == 0.0);
      }
}

TEST(SlidingContact, OnAFloorItStopsForEver) {
  for (const Way& way : ways()) {
    SCOPED_TRACE(way.name);
    const RunResult result =
        test::run_text(scene(way.lines, 30.0, "position = [0, 0, 0]\nvelocity = [2, 1, 0]\n", incline(0.0, 0.3)));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_EQ(result.contacts.size(), 2u);
    const double speed = std::sqrt(5.0), stop = speed / (0.3 * kGravity);
    EXPECT_EQ(contact(result, 0).mode, ImpactKind::slide);
    EXPECT_EQ(contact(result, 1).mode, ImpactKind::rest);
    EXPECT_NEAR(contact(result, 1).from, stop, 1e-13);  // 760 roundings of the speed by rk4
    EXPECT_EQ(contact(result, 0).to, contact(result, 1).from);
    EXPECT_FALSE(contact(result, 1).to.has_value());
    const BodyState& block = test::final_of(result, "block");
    EXPECT_NEAR((block.position - 0.5 * stop * Vector3(2, 1, 0)).norm(), 0.0, 1e-13);
    EXPECT_EQ(block.position.z(), 0.0);
    EXPECT_EQ(block.velocity.norm(), 0.0);
  }
}

// Where friction is as strong as the slope, speed down the slope and speed along the path grow alike: what was thrown
// across with v ends with v/2 straight down. The direction of friction turns all the way.
TEST(SlidingContact, ThrownAcrossAnInclineItTurnsDownWithHalfItsSpeed) {
  const double angle = 0.4;
  for (const Way& way : {test::controlled("taylor", 1e-12), test::controlled("dop853", 1e-11)}) {
    SCOPED_TRACE(way.name);
    const RunResult result = test::run_text(
        scene(way.lines, 40.0, "position = [0, 0, 0]\nvelocity = [0, 3, 0]\n", incline(angle, std::tan(angle))));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    const BodyState& block = test::final_of(result, "block");
    // v + v_down = 3 all the time: v is what is left after an exponential, of the rate g sin / 1.5 m/s
    EXPECT_NEAR(block.velocity.norm(), 1.5, 1e-9);
    EXPECT_NEAR(block.velocity.norm() + block.velocity.dot(Vector3(-std::cos(angle), 0, -std::sin(angle))), 3.0, 1e-9);
    EXPECT_NEAR(block.position.dot(Vector3(-std::sin(angle), 0, std::cos(angle))), 0.0, 1e-11);
  }
}

TEST(SlidingContact, AConveyorTakesItAlong) {
  for (const Way& way : ways()) {
    SCOPED_TRACE(way.name);
    const RunResult result = test::run_text(scene(way.lines, 3.0, "position = [0, 0, 0]\nvelocity = [0, 1, 0]\n",
                                                  incline(0.0, 0.2) + "velocity = [1.5, 0, 0]\n"));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    // seen from the belt, it is thrown with (-1.5, 1) and stops
    const double stop = std::hypot(1.5, 1.0) / (0.2 * kGravity);
    ASSERT_EQ(result.contacts.size(), 2u);
    EXPECT_NEAR(contact(result, 1).from, stop, 1e-13);
    const BodyState& block = test::final_of(result, "block");
    EXPECT_NEAR((block.velocity - Vector3(1.5, 0, 0)).norm(), 0.0, 1e-13);
    EXPECT_NEAR((block.position - Vector3(1.5 * 3.0 - 0.75 * stop, 0.5 * stop, 0)).norm(), 0.0, 1e-12);
  }
}

TEST(SlidingContact, AnOscillatingTableThrowsItOffWhereItFallsFasterThanGravity) {
  // z = A sin(w t): the table falls away where A w^2 sin(w t) = g
  const double amplitude = 0.3, w = 8.0;
  for (const Way& way : {test::controlled("taylor", 1e-13), test::controlled("dop853", 1e-12)}) {
    SCOPED_TRACE(way.name);
    const RunResult result = test::run_text(
        scene(way.lines, 0.3, "position = [0, 0, 0]\nvelocity = [0, 0, " + number(amplitude * w) + "]\n",
              "shape = \"plane\"\npoint = [0, 0, \"0.3*sin(8*t)\"]\nnormal = [0, 0, 1]\nfriction = 0.5\n"));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    const auto leaves = test::impacts_of(result, ImpactKind::leave);
    ASSERT_EQ(leaves.size(), 1u);
    const double time = std::asin(kGravity / (amplitude * w * w)) / w;
    EXPECT_NEAR(leaves[0]->time, time, 1e-12);
    EXPECT_NEAR(leaves[0]->velocity_after.z(), amplitude * w * std::cos(w * time), 1e-12);
  }
}

TEST(SlidingContact, ATurntableThatSpinsUpLosesItWhereFrictionEnds) {
  // angle = a t^2 / 2 at the distance r: it slips where (r a)^2 + (r a^2 t^2)^2 = (mu g)^2
  const double a = 0.5, r = 1.0, friction = 0.2;
  const double time = std::sqrt(std::sqrt(std::pow(friction * kGravity / r, 2) - a * a)) / a;
  for (const Way& way : {test::controlled("taylor", 1e-13), test::controlled("dop853", 1e-12)}) {
    SCOPED_TRACE(way.name);
    const RunResult result = test::run_text(scene(way.lines, 4.0, "position = [1, 0, 0]\n", R"(
shape = "cylinder"
center = [0, 0, -0.5]
orientation = {axis = [0, 0, 1], angle = "0.25*t^2"}
radius = 5
height = 1
friction = 0.2
)"));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    ASSERT_EQ(result.contacts.size(), 2u);
    EXPECT_EQ(contact(result, 0).mode, ImpactKind::rest);
    EXPECT_EQ(contact(result, 1).mode, ImpactKind::slide);
    EXPECT_NEAR(contact(result, 1).from, time, 1e-11);
    EXPECT_NEAR(test::final_of(result, "block").position.z(), 0.0, 1e-14);
  }
}

TEST(SlidingContact, ItLeavesASphereAtTwoThirdsOfItsHeight) {
  // v^2 = 2 g R (cos a - cos b) and N = 0 where v^2 = g R cos b: cos b = 2/3 cos a
  for (const Way& way : {test::controlled("taylor", 1e-13), test::controlled("dop853", 1e-12)})
    for (const double start : {1e-3, 0.1, 0.6}) {
      SCOPED_TRACE(way.name + number(start));
      const RunResult result = test::run_text(
          scene(way.lines, 5.0, "position = [" + number(std::sin(start)) + ", 0, " + number(std::cos(start)) + "]\n",
                "shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n"));
      ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
      const auto leaves = test::impacts_of(result, ImpactKind::leave);
      ASSERT_EQ(leaves.size(), 1u);
      const double height = 2.0 / 3.0 * std::cos(start);
      EXPECT_NEAR(leaves[0]->position.z(), height, 1e-11);
      EXPECT_NEAR(leaves[0]->velocity_after.norm(), std::sqrt(kGravity * height), 1e-11);
    }
}

TEST(SlidingContact, ItLoopsTheLoopWhereItIsFastEnough) {
  const std::string pipe =
      "shape = \"cylinder\"\ncenter = [0, 0, 0]\norientation = {axis = [1, 0, 0], angle = \"90 deg\"}\nradius = 1\n"
      "height = 1\ninside = true\n";
  for (const double share : {0.9, 1.001}) {
    SCOPED_TRACE(share);
    const double speed = share * std::sqrt(5.0 * kGravity);
    const RunResult result =
        test::run_text(scene(test::controlled("taylor", 1e-13).lines, 1.0,
                             "position = [0, 0, -1]\nvelocity = [" + number(speed) + ", 0, 0]\n", pipe));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    const auto leaves = test::impacts_of(result, ImpactKind::leave);
    if (share > 1.0) {
      EXPECT_TRUE(leaves.empty());
      const BodyState& block = test::final_of(result, "block");
      EXPECT_NEAR(block.position.norm(), 1.0, 1e-11);
      EXPECT_NEAR(0.5 * block.velocity.squaredNorm() + kGravity * (1.0 + block.position.z()), 0.5 * speed * speed,
                  1e-10);
      continue;
    }
    ASSERT_GE(leaves.size(), 1u);
    // v^2 = v0^2 - 2 g (1 + z) and N = 0 where v^2 = g z
    EXPECT_NEAR(leaves[0]->position.z(), (speed * speed - 2.0 * kGravity) / (3.0 * kGravity), 1e-11);
  }
}

TEST(SlidingContact, InABowlEnergyAndAngularMomentumStay) {
  const RunResult result = test::run_text(scene(test::controlled("taylor", 1e-13).lines, 20.0,
                                                "position = [0.8, 0, -0.6]\nvelocity = [0, 1, 0]\n",
                                                "shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\ninside = true\n"));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_EQ(result.contacts.size(), 1u);
  EXPECT_EQ(contact(result, 0).mode, ImpactKind::slide);
  const BodyState& block = test::final_of(result, "block");
  EXPECT_NEAR(block.position.norm(), 1.0, 1e-11);
  EXPECT_NEAR(0.5 * block.velocity.squaredNorm() + kGravity * block.position.z(), 0.5 - 0.6 * kGravity, 1e-10);
  EXPECT_NEAR(block.position.cross(block.velocity).z(), 0.8, 1e-11);
}

// On a table that shakes so hard that it never sticks, A w^2 > mu g sqrt(1 + pi^2/4), a block comes to a motion with
// the table's period whose speed is a triangle of the slope mu g: half a period later it is the opposite. The phase at
// which it turns round follows from the speeds being equal there: A w |cos| = mu g T/4.
TEST(SlidingContact, AShakenTableDrivesItInItsPeriod) {
  const double amplitude = 0.1, w = 8.0, friction = 0.1, period = 2.0 * M_PI / w;
  const auto speed_at = [&](double end) {
    const RunResult result = test::run_text(
        scene(test::controlled("taylor", 1e-12).lines, end, "position = [0, 0, 0]\n",
              "shape = \"plane\"\npoint = [\"0.1*sin(8*t)\", 0, 0]\nnormal = [0, 0, 1]\nfriction = 0.1\n"));
    EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
    return test::final_of(result, "block").velocity.x();
  };
  const double turn =
      std::acos(friction * kGravity * period / 4.0 / (amplitude * w)) / w;  // the table slower from there on
  const double speed = speed_at(60.0 * period + turn);
  EXPECT_NEAR(speed, friction * kGravity * period / 4.0, 1e-10);
  EXPECT_NEAR(speed_at(60.5 * period + turn), -speed, 1e-10);
}

}  // namespace
}  // namespace trajet
