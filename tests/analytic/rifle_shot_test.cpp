// The course's shot (F109 to F113): a bullet, a thin target 180 m away, the ground. Its closed form is the oracle.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::Way;

constexpr long double kG = 9.8L;
constexpr long double kHeight = 1.5L;      // of the muzzle
constexpr long double kDistance = 180.0L;  // of the target

struct Shot {
  double speed = 500.0;
  double angle_rad = 0.0;
  double height = static_cast<double>(kHeight);
};

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

RunResult fire(const Shot& shot, const Way& way) {
  const Vector3 velocity(shot.speed * std::cos(shot.angle_rad), 0.0, shot.speed * std::sin(shot.angle_rad));
  Scene scene = parse_scene("[time]\nend = 1000\n[method]\n" + way.lines + R"(
[[body]]
name = "bullet"
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
)",
                            "rifle_shot.toml");
  scene.bodies[0].position = Vector3(0.0, 0.0, shot.height);
  scene.bodies[0].velocity = velocity;
  return run(scene);
}

struct Expected {
  const char* with;
  long double time;
  long double x, z;
};

/// Where the bullet ends by the closed form, from the very doubles that the run starts with.
Expected closed_form(const Shot& shot) {
  const long double vx = shot.speed * std::cos(shot.angle_rad);
  const long double vz = shot.speed * std::sin(shot.angle_rad);
  const long double root = std::sqrt(vz * vz + 2.0L * kG * shot.height);
  // the root of g t^2/2 - vz t - h that does not cancel
  const long double ground = vz >= 0.0L ? (vz + root) / kG : 2.0L * shot.height / (root - vz);
  const long double target = kDistance / vx;
  const long double z = shot.height + vz * target - 0.5L * kG * target * target;
  if (vx > 0.0L && target < ground && 0.8L <= z && z <= 1.2L) return {"target", target, kDistance, z};
  return {"ground", ground, vx * ground, 0.0L};
}

const std::vector<Way>& ways() {
  // A step of 0.3 s is longer than half the flight to the target.
  static const std::vector<Way> all = {
      {"taylor", "name = \"taylor\"\n"}, {"dopri5", "name = \"dopri5\"\n"}, test::fixed("rk4", 0.3)};
  return all;
}

void expect_exact(const Shot& shot, const Way& way) {
  const RunResult result = fire(shot, way);
  const Expected expected = closed_form(shot);
  SCOPED_TRACE(way.name + ", " + test::number(shot.angle_rad) + " rad, " + test::number(shot.speed) + " m/s");
  ASSERT_EQ(result.status, RunStatus::stopped) << result.failure;
  ASSERT_EQ(result.impacts.size(), 1u);
  const Impact& impact = result.impacts[0];
  EXPECT_EQ(impact.with, expected.with);
  // The bar of the project. Rounding at 700 steps of a 10 km flight is a thousand times less.
  EXPECT_NEAR(impact.time, static_cast<double>(expected.time), 1e-11 * static_cast<double>(expected.time));
  EXPECT_NEAR(impact.position.x(), static_cast<double>(expected.x), 1e-8);
  EXPECT_NEAR(impact.position.z(), static_cast<double>(expected.z), 1e-8);
  EXPECT_EQ(impact.time, result.end_time);
}

TEST(RifleShot, AnyAngleAndSpeedEqualTheClosedForm) {
  std::mt19937 engine(2016);
  std::uniform_real_distribution<double> any_angle(0.0, 2.0 * std::numbers::pi);
  std::uniform_real_distribution<double> towards_target(radians(-0.3), radians(0.3));
  std::uniform_real_distribution<double> speed(50.0, 1000.0);
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const Shot shot{speed(engine), i % 2 == 0 ? towards_target(engine) : any_angle(engine)};
    hits += closed_form(shot).with == std::string("target") ? 1 : 0;
    for (const Way& way : ways()) expect_exact(shot, way);
  }
  EXPECT_GT(hits, 20);  // else the draw does not test the target
}

TEST(RifleShot, TheExamplesOfTheCourse) {
  for (const double degrees : {0.0, 0.05, 0.1, 0.2, -0.1, 0.75, 45.0})
    for (const Way& way : ways()) expect_exact({500.0, radians(degrees)}, way);
}

TEST(RifleShot, TargetAndGroundAtOneTimeAreDecidedAlikeAndReported) {
  // Erratum G1: the bullet reaches the target's plane and the ground together, 0.8 m below the target: only the ground
  // is hit, whatever comes first by rounding.
  const Shot tie{500.0, radians(-0.27531853259936956627)};
  for (const Way& way : ways()) {
    const RunResult result = fire(tie, way);
    ASSERT_EQ(result.impacts.size(), 1u) << way.name;
    EXPECT_EQ(result.impacts[0].with, "ground") << way.name;
    EXPECT_NEAR(result.impacts[0].time, 0.360004156256204249, 1e-11 * 0.36) << way.name;
    EXPECT_EQ(fire(tie, way).impacts[0].time, result.impacts[0].time) << way.name;
  }
}

TEST(RifleShot, ATargetThatStandsInTheGroundTiesWithIt) {
  // The tie of erratum G1 with a target that reaches below the ground: both are hit at one time, the first of the scene
  // stops the run, and the result says so.
  for (const Way& way : ways()) {
    const RunResult result = test::run_text("[time]\nend = 5\n[method]\n" + way.lines + R"(
[[body]]
name = "bullet"
position = [0, 0, 1.5]
velocity = "500*[cos(theta), 0, sin(theta)]"
acceleration = [0, 0, -9.8]
[parameters]
theta = "-0.27531853259936956627 deg"
[[obstacle]]
name = "target"
shape = "disk"
center = [180, 0, 0]
normal = [-1, 0, 0]
radius = 0.2
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
)");
    ASSERT_EQ(result.status, RunStatus::stopped) << way.name;
    EXPECT_NEAR(result.end_time, 0.360004156256204249, 1e-11 * 0.36) << way.name;
    EXPECT_EQ(result.warnings.size(), 1u) << way.name;
  }
}

TEST(RifleShot, BackwardAndUpwardFindTheGround) {
  // Erratum G2: at 180 and 90 degrees the course's target time is negative and undefined.
  for (const double degrees : {180.0, 90.0, -90.0, 270.0, 179.7})
    for (const Way& way : ways()) expect_exact({500.0, radians(degrees)}, way);
}

TEST(RifleShot, AStartOnTheGroundAimedDownHitsAtOnce) {
  // Erratum G3.
  for (const double degrees : {-10.0, -90.0, -0.001}) {
    for (const Way& way : ways()) {
      const RunResult result = fire({500.0, radians(degrees), 0.0}, way);
      ASSERT_EQ(result.impacts.size(), 1u) << way.name;
      EXPECT_EQ(result.impacts[0].with, "ground");
      EXPECT_EQ(result.impacts[0].time, 0.0);
      EXPECT_EQ(result.status, RunStatus::stopped);
    }
  }
  for (const Way& way : ways()) expect_exact({500.0, radians(5.0), 0.0}, way);  // aimed up: a flight
}

TEST(RifleShot, TheEdgesOfTheTargetBelongToIt) {
  // Erratum A16: the height at the target is its lowest and its highest point, to rounding.
  for (const double degrees : {-0.020677382982079319, 0.106647121437685017}) {
    for (const Way& way : ways()) {
      const RunResult result = fire({500.0, radians(degrees)}, way);
      ASSERT_EQ(result.impacts.size(), 1u) << way.name;
      EXPECT_EQ(result.impacts[0].with, "target") << way.name << " " << degrees;
    }
  }
}

TEST(RifleShot, AStepThatEndsOnTheTargetHitsIt) {
  // Erratum A11: with these steps the bullet stands on the target's plane at the end of a step.
  for (const double step : {0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.12, 0.18, 0.36}) {
    for (const char* method : {"rk4", "midpoint"}) {
      const RunResult result = fire({}, test::fixed(method, step));
      ASSERT_EQ(result.impacts.size(), 1u) << method << " " << step;
      EXPECT_EQ(result.impacts[0].with, "target") << method << " " << step;
      EXPECT_NEAR(result.impacts[0].time, 0.36, 1e-14);
      EXPECT_NEAR(result.impacts[0].position.z(), 0.86496, 1e-14);
    }
  }
}

}  // namespace
}  // namespace trajet
