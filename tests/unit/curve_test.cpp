// Curves and poses for figures: they must show the motion itself.

#include "trajet/viz/curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene_run.hpp"
#include "trajet/viz/pose.hpp"

namespace trajet {
namespace {

MotionRecord record(const std::string& scene) {
  MotionRecord motion;
  test::run_text(scene, &motion);
  return motion;
}

/// The largest distance of the line through the curve's points from the motion, in a component of the state, up to a
/// time.
double error(const MotionRecord& motion, const Curve& curve, int component, double until = 1e300) {
  double largest = 0.0;
  for (const auto& piece : motion.pieces(0))
    for (int k = 0; k <= 50; ++k) {
      const double t = piece.from + (piece.to - piece.from) * k / 50.0;
      if (t > until) continue;
      const auto after = std::min(std::ranges::upper_bound(curve.times, t), curve.times.end() - 1);
      const auto i = static_cast<std::size_t>(after - curve.times.begin()), c = static_cast<std::size_t>(component);
      const double part = (t - curve.times[i - 1]) / (curve.times[i] - curve.times[i - 1]);
      const double line = curve.states[i - 1][c] + part * (curve.states[i][c] - curve.states[i - 1][c]);
      largest = std::max(largest, std::abs(line - piece.segment.value(component, t)));
    }
  return largest;
}

TEST(Curve, IsSmoothWithFewPoints) {
  // twenty rounds of a circle of radius 1, in long steps of a high order and in many short ones
  const std::string circle =
      "[[body]]\nname = \"b\"\nposition = [1, 0, 0]\nvelocity = [0, 1, 0]\nacceleration = \"-r\"\n";
  for (const char* method : {"", "[method]\nname = \"rk4\"\nstep = 0.002\n"}) {
    const MotionRecord motion = record(std::string("[time]\nend = 125.6\n") + method + circle);
    const Curve curve = make_curve(motion, 0);
    EXPECT_LT(error(motion, curve, 0), 2e-3 * 2.0)
        << method << "a thousandth of the extent, and as much for what was dropped";
    EXPECT_LT(curve.times.size(), 20U * 100U) << method;
  }
}

// a shot: 180 m far and half a metre down, in a picture where each axis has its scale
TEST(Curve, IsSmoothInTheScaleOfEachAxis) {
  const MotionRecord motion =
      record("[time]\nend = 0.36\n[[body]]\nname = \"b\"\nvelocity = [500, 0, 0.4]\nacceleration = [0, 0, -9.8]\n");
  const Curve curve = make_curve(motion, 0);
  EXPECT_LT(error(motion, curve, 2), 2e-3 * 0.5);
  EXPECT_LT(curve.times.size(), 200U);
}

// x = exp(10 t), to 1e65: beside a motion that stays below 2 one sees the first 0.07 s
TEST(Curve, IsSmoothWhereAMotionBeginsToRunAway) {
  const MotionRecord motion = record(
      "[time]\nend = 15\n[[body]]\nname = \"b\"\nposition = [1, 0, 0]\nvelocity = [10, 0, 0]\n"
      "acceleration = \"100*r\"\n");
  const Curve curve = make_curve(motion, 0);
  EXPECT_LT(error(motion, curve, 0, 0.07), 4e-3);
  EXPECT_LT(curve.times.size(), 8200U);
}

// y is rounding, 1e-17 of x
TEST(Curve, DoesNotRefineRounding) {
  const MotionRecord motion = record(
      "[time]\nend = 10\n[[body]]\nname = \"b\"\nvelocity = [1, 0, 0]\n"
      "acceleration = [1, \"1e-14*sin(1000*t)\", 0]\n");
  const Curve curve = make_curve(motion, 0);
  double largest = 0.0;
  for (const auto& state : curve.states) largest = std::max(largest, std::abs(state[1]));
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(curve.times.size(), 400U);
}

TEST(Curve, OfAStraightLineHasFewPoints) {
  const Curve curve = make_curve(record("[time]\nend = 10\n[[body]]\nname = \"b\"\nvelocity = [1, 2, 3]\n"), 0);
  EXPECT_LE(curve.times.size(), 6U);
  EXPECT_EQ(curve.times.front(), 0.0);
  EXPECT_EQ(curve.times.back(), 10.0);
}

TEST(Curve, KeepsBothSidesOfAJump) {
  const MotionRecord motion = record(
      "[time]\nend = 1\n[[body]]\nname = \"b\"\nposition = [0, 0, 1]\nacceleration = [0, 0, -10]\n"
      "[[obstacle]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\non_hit = "
      "\"bounce\"\n");
  const Curve curve = make_curve(motion, 0);
  const double bounce = std::sqrt(0.2), speed = std::sqrt(20.0);
  bool has_before = false, has_after = false;
  for (std::size_t i = 0; i < curve.times.size(); ++i) {
    if (std::abs(curve.times[i] - bounce) > 1e-12) continue;
    has_before = has_before || std::abs(curve.states[i][5] + speed) < 1e-9;
    has_after = has_after || std::abs(curve.states[i][5] - speed) < 1e-9;
  }
  EXPECT_TRUE(has_before && has_after);
}

TEST(Poses, StandAtRoundTimesAsTheMethodLeavesThem) {
  EXPECT_EQ(pose_times(0.0, 10.0), (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(pose_times(1.0, 1.0), (std::vector<double>{1.0}));
  EXPECT_EQ(pose_times(3.0, 0.0), (std::vector<double>{3.0, 2.5, 2.0, 1.5, 1.0, 0.5, 0.0}));
  const std::vector<double> uneven = pose_times(0.0, 1.02);
  EXPECT_EQ(uneven.size(), 11U) << "0, 0.1, .., 0.9 and the end, which is close behind 1";
  EXPECT_EQ(uneven.back(), 1.02);

  // Euler's matrix: each step multiplies det R by 1 + (w dt)^2
  const MotionRecord motion = record(
      "[time]\nend = 10\n[method]\nname = \"euler\"\nstep = 0.5\norientation = \"matrix\"\n[[body]]\nname = \"b\"\n"
      "position = [0, 0, 1]\nvelocity = [1, 0, 0]\nangular_velocity = [0, 0, \"pi/10\"]\n");
  const std::vector<Pose> poses = make_poses(motion, motion.world().bodies[0]);
  ASSERT_EQ(poses.size(), 11U);
  const double growth = 1.02467401100272;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    EXPECT_NEAR(poses[k].R_WB.determinant(), std::pow(growth, 2.0 * static_cast<double>(k)), 1e-12);
    EXPECT_NEAR((poses[k].p_WB - Vector3(static_cast<double>(k), 0, 1)).norm(), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace trajet
