// A parabola that dips into a plane by 1e-9 m within one step, one that misses it by as much, and one that touches.

#include <gtest/gtest.h>

#include <cmath>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::Way;

constexpr double kAcceleration = 9.8;

/// All methods that integrate a parabola exactly, at loose and tight tolerances and with steps that end before, on and
/// behind the lowest point at t = 0.5 s, and right on the crossings 1.43e-5 s beside it.
std::vector<Way> ways() {
  std::vector<Way> all;
  for (const double tolerance : {1e-2, 1e-6, 1e-13})
    for (const char* method : {"taylor", "dopri5"}) all.push_back(test::controlled(method, tolerance));
  for (const double step : {0.01, 0.3, 0.5, 0.7, 1.0, 0.5 - 1.43e-5, 0.5 + 1.43e-5})
    for (const char* method : {"rk4", "midpoint"}) all.push_back(test::fixed(method, step));
  return all;
}

/// A body above the floor z = 0 on z = (a/2)(t - 1/2)^2 + height, or the same below a ceiling.
RunResult dip(double height, const Way& way, bool upside_down, double radius = 0.0) {
  const double up = upside_down ? -1.0 : 1.0;
  const std::string shape = radius > 0.0 ? "shape = \"sphere\"\nradius = " + test::number(radius) + "\n" : "";
  return test::run_text("[time]\nend = 1\n[method]\n" + way.lines + "[[body]]\nname = \"ball\"\n" + shape +
                        "position = [0, 0, " + test::number(up * (kAcceleration / 8.0 + height + radius)) +
                        "]\nvelocity = [3, 0, " + test::number(-up * kAcceleration / 2.0) +
                        "]\nacceleration = [0, 0, " + test::number(up * kAcceleration) +
                        "]\n[[obstacle]]\nname = \"plane\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, " +
                        test::number(up) + "]\non_hit = \"pass\"\n");
}

TEST(DoubleCrossing, ADipOfOneNanometreIsFoundTwice) {
  // z = -d at the lowest point: crossings at t = 1/2 -+ sqrt(2 d / a)
  const double half = std::sqrt(2e-9 / kAcceleration);
  for (const Way& way : ways()) {
    for (const bool upside_down : {false, true}) {
      for (const double radius : {0.0, 0.25}) {
        SCOPED_TRACE(way.name + (upside_down ? ", ceiling, " : ", floor, ") + test::number(radius));
        const RunResult result = dip(-1e-9, way, upside_down, radius);
        EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
        ASSERT_EQ(result.impacts.size(), 2u);
        // z is rounded by a few 1e-16 m in each of up to 100 steps, and crosses at 1.4e-4 m/s
        EXPECT_NEAR(result.impacts[0].time, 0.5 - half, 1e-9);
        EXPECT_NEAR(result.impacts[1].time, 0.5 + half, 1e-9);
        EXPECT_EQ(result.impacts[0].kind, ImpactKind::hit);
        EXPECT_EQ(result.impacts[1].kind, ImpactKind::hit);
      }
    }
  }
}

TEST(DoubleCrossing, AClearanceOfOneNanometreIsNone) {
  for (const Way& way : ways())
    for (const bool upside_down : {false, true})
      for (const double radius : {0.0, 0.25})
        EXPECT_TRUE(dip(1e-9, way, upside_down, radius).impacts.empty()) << way.name;
}

TEST(DoubleCrossing, AnExactTouchIsAGraze) {
  // All numbers of this parabola are exact in binary, and the Taylor Segment is the parabola.
  const RunResult result = test::run_text(R"(
[time]
end = 1
[[body]]
name = "ball"
position = [0, 0, 1]
velocity = [3, 0, -4]
acceleration = [0, 0, 8]
[[obstacle]]
name = "floor"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "stop"
)");
  EXPECT_EQ(result.status, RunStatus::finished);  // a graze does not stop
  ASSERT_EQ(result.impacts.size(), 1u);
  EXPECT_EQ(result.impacts[0].kind, ImpactKind::graze);
  // z <= tolerance within sqrt(2 * 1e-15 / 8) of the touch
  EXPECT_NEAR(result.impacts[0].time, 0.5, 2e-8);
}

TEST(DoubleCrossing, AStoppingPlaneIsHitAtTheFirstCrossing) {
  Scene scene = parse_scene(R"(
[time]
end = 1
[[body]]
name = "ball"
velocity = [3, 0, -4.9]
acceleration = [0, 0, 9.8]
[[obstacle]]
name = "floor"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
)",
                            "test.toml");
  scene.bodies[0].position = Vector3(0, 0, 1.225 - 1e-9);
  const RunResult result = run(scene);
  EXPECT_EQ(result.status, RunStatus::stopped);
  ASSERT_EQ(result.impacts.size(), 1u);
  EXPECT_NEAR(result.impacts[0].time, 0.5 - std::sqrt(2e-9 / kAcceleration), 1e-11);
}

}  // namespace
}  // namespace trajet
