// The course's own ways to locate an impact (F115 to F119): what they find, and the errors that they are known to make.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::run_text;

std::string method(const std::string& locate, double step) {
  return "[method]\nlocate = \"" + locate + "\"\nname = \"rk4\"\nstep = " + test::number(step) + "\n";
}

RunResult fire(double degrees, const std::string& locate, double step) {
  return run_text("[time]\nend = 100\n" + method(locate, step) + "[parameters]\ntheta = \"" + test::number(degrees) +
                  R"( deg"
[[body]]
name = "bullet"
position = [0, 0, 1.5]
velocity = "500*[cos(theta), 0, sin(theta)]"
acceleration = [0, 0, -9.8]
[[obstacle]]
name = "target"
shape = "disk"
center = [180, 0, 1]
normal = [-1, 0, 0]
radius = 0.2
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
)");
}

/// The flight to the ground over or under the target.
struct Flight {
  double time, range;
};
Flight flight(double degrees) {
  const double theta = degrees * std::numbers::pi / 180.0;
  const double vz = 500.0 * std::sin(theta);
  const double time = (vz + std::sqrt(vz * vz + 2.0 * 9.8 * 1.5)) / 9.8;
  return {time, 500.0 * std::cos(theta) * time};
}

TEST(StepEndLocators, InterpolationErrsAsTheErrataSay) {
  // Erratum G5: with steps of 1 s the point found is 1.16 m above the ground, 74.7 m short, 0.149 s early.
  const RunResult result = fire(0.75, "interpolation", 1.0);
  ASSERT_EQ(result.impacts.size(), 1u);
  const Impact& impact = result.impacts[0];
  EXPECT_EQ(impact.with, "ground");
  EXPECT_NEAR(flight(0.75).time - impact.time, 0.149, 5e-4);
  EXPECT_NEAR(flight(0.75).range - impact.position.x(), 74.7, 5e-2);
  EXPECT_NEAR(impact.position.z(), 1.16, 5e-3);
  EXPECT_EQ(impact.point.z(), 0.0);
  // z / |vz| is the first step of Newton's method from above a concave flight: more than the error, and of its size.
  EXPECT_GT(impact.time_error_bound, 0.149);
  EXPECT_LT(impact.time_error_bound, 0.3);
}

TEST(StepEndLocators, InterpolationErrsByTheCurvatureWithinAStep) {
  // A chord of a parabola is at most g h^2 / 8 below it.
  for (const double step : {0.3, 0.1, 0.01}) {
    const RunResult result = fire(0.75, "interpolation", step);
    ASSERT_EQ(result.impacts.size(), 1u) << step;
    EXPECT_GE(result.impacts[0].position.z(), -1e-12) << step;
    EXPECT_LE(result.impacts[0].position.z(), 9.8 * step * step / 8.0) << step;
    EXPECT_LE(result.impacts[0].time, flight(0.75).time + 1e-12) << step;
  }
}

TEST(StepEndLocators, SubdivisionEndsNearTheSurface) {
  for (const double degrees : {0.75, 0.2, -1.0, 5.0}) {
    for (const double step : {1.0, 0.3, 0.01}) {
      const RunResult result = fire(degrees, "subdivision", step);
      SCOPED_TRACE(test::number(degrees) + " " + test::number(step));
      ASSERT_EQ(result.impacts.size(), 1u);
      const Impact& impact = result.impacts[0];
      EXPECT_EQ(impact.with, "ground");
      EXPECT_LT(std::abs(impact.position.z()), 1e-9);
      // the gap that is left over the speed at which it closes
      const double speed = std::abs(impact.velocity_before.z());
      EXPECT_NEAR(impact.time, flight(degrees).time, 1e-9 / speed);
      EXPECT_LE(std::abs(impact.time - flight(degrees).time), 1.001 * impact.time_error_bound + 1e-14);
    }
  }
}

TEST(StepEndLocators, TheTargetIsHitAtStepEndsAndBetween) {
  // Erratum A11: with these steps the bullet is on the target's plane at a step's end.
  for (const char* locate : {"interpolation", "subdivision"}) {
    for (const double step : {0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.17, 0.36}) {
      const RunResult result = fire(0.0, locate, step);
      SCOPED_TRACE(std::string(locate) + " " + test::number(step));
      ASSERT_EQ(result.impacts.size(), 1u);
      EXPECT_EQ(result.impacts[0].with, "target");
      EXPECT_NEAR(result.impacts[0].time, 0.36, 1e-11);  // 1e-9 m at 500 m/s; x is linear in time
      EXPECT_NEAR(result.impacts[0].position.z(), 0.86496, 1e-10);
    }
  }
}

TEST(StepEndLocators, AStartOnTheGroundAimedDownIsHitAtOnce) {
  // Erratum G3.
  for (const char* locate : {"interpolation", "subdivision"}) {
    const RunResult result = run_text("[time]\nend = 5\n" + method(locate, 0.1) + R"(
[[body]]
name = "ball"
velocity = [1, 0, -1]
acceleration = [0, 0, -9.8]
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
)");
    ASSERT_EQ(result.impacts.size(), 1u) << locate;
    EXPECT_EQ(result.impacts[0].time, 0.0) << locate;
  }
}

TEST(StepEndLocators, WhatIsOverWithinAStepIsMissed) {
  // z = 4.9 (t - 1/2)^2 - 0.1 is below zero for 0.286 s.
  const auto dip = [](const std::string& locate, double step) {
    return run_text("[time]\nend = 1\n" + method(locate, step) + R"(
[[body]]
name = "ball"
position = [0, 0, 1.125]
velocity = [0, 0, -4.9]
acceleration = [0, 0, 9.8]
[[obstacle]]
name = "floor"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "pass"
)")
        .impacts.size();
  };
  for (const char* locate : {"interpolation", "subdivision"}) {
    EXPECT_EQ(dip(locate, 1.0), 0u) << locate;
    EXPECT_EQ(dip(locate, 0.05), 2u) << locate;
  }
  EXPECT_EQ(dip("polynomial", 1.0), 2u);
}

TEST(StepEndLocators, ThroughSolidsAndThinObstaclesInOrder) {
  for (const char* locate : {"interpolation", "subdivision"}) {
    const RunResult result = run_text("[time]\nend = 10\n" + method(locate, 0.3) + R"(
[[body]]
name = "probe"
velocity = [1, 0, 0]
[[obstacle]]
name = "box"
shape = "box"
center = [5, 0, 0]
size = [2, 2, 2]
on_hit = "pass"
[[obstacle]]
name = "sphere"
shape = "sphere"
center = [2, 0, 0]
radius = 1
on_hit = "pass"
[[obstacle]]
name = "beside"
shape = "rectangle"
center = [5, 2, 0]
normal = [1, 0, 0]
up = [0, 0, 1]
size = [2, 2]
on_hit = "pass"
[[obstacle]]
name = "disk"
shape = "disk"
center = [5, 0.5, 0]
normal = [1, 0, 0]
radius = 0.5
on_hit = "pass"
)");
    const double expected[] = {1, 3, 4, 5, 6};
    ASSERT_EQ(result.impacts.size(), 5u) << locate;
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_NEAR(result.impacts[i].time, expected[i], 1.1e-9) << locate;  // 1e-9 m at 1 m/s
    EXPECT_EQ(result.impacts[3].with, "disk");
  }
}

TEST(StepEndLocators, ABallBouncesOn) {
  // Short of the surface or beyond it, the ball bounces once at each contact, and does not fall through.
  for (const char* locate : {"interpolation", "subdivision"}) {
    for (const double step : {0.05, 0.01}) {
      const RunResult result = run_text("[time]\nend = 8\n" + method(locate, step) + R"(
[[body]]
name = "ball"
shape = "sphere"
radius = 0.1
position = [0, 0, 1.1]
acceleration = [0, 0, -9.8]
[[obstacle]]
name = "floor"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
)");
      SCOPED_TRACE(std::string(locate) + " " + test::number(step));
      ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
      const double fall = std::sqrt(2.0 / 9.8);
      ASSERT_EQ(result.impacts.size(), 9u);
      // Interpolation bounces up to g h^2/8 above the floor: early by as much over 4.43 m/s, twice for each flight.
      const double early = std::string(locate) == "interpolation" ? 9.8 * step * step / 8.0 / 4.4 : 1e-9;
      for (std::size_t i = 0; i < 9; ++i)
        EXPECT_NEAR(result.impacts[i].time, (2.0 * static_cast<double>(i) + 1.0) * fall,
                    4.0 * static_cast<double>(i + 1) * early);
    }
  }
}

}  // namespace
}  // namespace trajet
