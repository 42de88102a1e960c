#include "trajet/ensemble/aim.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "aim_task.hpp"
#include "trajet/error.hpp"
#include "trajet/sim/motion_record.hpp"
#include "trajet/sim/run.hpp"

namespace trajet {
namespace {

using test::aim_task;
using test::cannon;
using test::kDegree;
using test::number;

constexpr double kGravity = 9.81;

/// The elevations at which a shot without drag comes to (x, z): tan = (v^2 -+ sqrt(v^4 - g (g x^2 + 2 z v^2))) / (g x).
std::vector<double> elevations(double v, double x, double z) {
  const double root = v * v * v * v - kGravity * (kGravity * x * x + 2.0 * z * v * v);
  if (root < 0.0) return {};
  return {std::atan((v * v - std::sqrt(root)) / (kGravity * x)), std::atan((v * v + std::sqrt(root)) / (kGravity * x))};
}

TEST(Aim, BothArcsOfACannonAreThoseOfTheClosedForm) {
  const AimResult result = aim(aim_task(cannon(50), {"theta=1deg:89deg"}, Vector3(200, 0, 10)));
  EXPECT_EQ(result.status, AimStatus::found);
  const std::vector<double> exact = elevations(50, 200, 10);
  ASSERT_EQ(result.solutions.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(result.solutions[i].parameters[0], exact[i], 1e-12);
    EXPECT_NEAR(result.solutions[i].time, 200 / (50 * std::cos(exact[i])), 1e-10);
    EXPECT_LT(result.solutions[i].miss, 1e-12);
    EXPECT_LT((result.solutions[i].point - Vector3(200, 0, 10)).norm(), 1e-12);
    EXPECT_EQ(result.solutions[i].bounces, 0);
  }
}

// As many as the closed form has in the range, of which some hold one arc or none; near the envelope both arcs are
// close together, so that a tenth of the targets lie within a thousandth of it.
TEST(Aim, RandomCannonsHaveAsManySolutionsAsTheClosedForm) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int counts[3] = {};
  for (int n = 0; n < 200; ++n) {
    const double v = 20 + 60 * uniform(random), x = (0.05 + 1.1 * uniform(random)) * v * v / kGravity;
    const double envelope = v * v / (2 * kGravity) - kGravity * x * x / (2 * v * v);
    const double z = n % 10 == 0 ? envelope - std::pow(10.0, -3 - 4 * uniform(random)) * v * v / kGravity
                                 : envelope - (1.5 * uniform(random) - 0.5) * v * v / (2 * kGravity);
    const double low = -80 + 100 * uniform(random), high = low + 5 + (84 - low) * uniform(random);
    std::vector<double> exact = elevations(v, x, z);
    std::erase_if(exact, [&](double angle) { return angle < low * kDegree || angle > high * kDegree; });
    const AimResult result =
        aim(aim_task(cannon(v), {"theta=" + number(low) + "deg:" + number(high) + "deg"}, Vector3(x, 0, z)));
    SCOPED_TRACE("v " + number(v) + " x " + number(x) + " z " + number(z) + " from " + number(low) + " to " +
                 number(high));
    EXPECT_EQ(result.status, exact.empty() ? AimStatus::unreachable : AimStatus::found);
    ASSERT_EQ(result.solutions.size(), exact.size());
    ++counts[exact.size()];
    // the solutions' distance to the fold of the two arcs, over which rounding grows
    const double apart = std::abs(elevations(v, x, z).empty() ? 1.0 : elevations(v, x, z)[1] - elevations(v, x, z)[0]);
    for (std::size_t i = 0; i < exact.size(); ++i)
      EXPECT_NEAR(result.solutions[i].parameters[0], exact[i], 1e-12 + 1e-14 / apart);
  }
  for (const int count : counts) EXPECT_GT(count, 15);
}

/// The distance from (x, z) to the parabola that all shots from the origin touch, z = v^2/2g - g x^2/2v^2, by halving a
/// fine scan.
double distance_to_envelope(double v, double x, double z) {
  const auto distance = [&](double s) {
    return std::hypot(s - x, v * v / (2 * kGravity) - kGravity * s * s / (2 * v * v) - z);
  };
  double best = 0.0, step = 1.0;
  for (double s = 0; s < 2 * x; s += step)
    if (distance(s) < distance(best)) best = s;
  for (; step > 1e-9; step *= 0.5)
    for (const double s : {best - step, best + step})
      if (distance(s) < distance(best)) best = s;
  return distance(best);
}

// What shots reach is all on the inner side of the envelope, so that the miss of the best is the distance to it.
TEST(Aim, BeyondTheEnvelopeTheMissIsTheDistanceToIt) {
  for (const auto& [x, z] : {std::pair(260.0, 10.0), {100.0, 200.0}, {255.0, 0.001}, {400.0, -20.0}}) {
    const AimResult result = aim(aim_task(cannon(50), {"theta=1deg:89deg"}, Vector3(x, 0, z)));
    EXPECT_EQ(result.status, AimStatus::unreachable);
    ASSERT_TRUE(result.closest);
    EXPECT_NEAR(result.closest->miss, distance_to_envelope(50, x, z), 1e-10);
    EXPECT_FALSE(result.closest->is_end);
  }
}

// On the envelope the two arcs are one: the miss grows with the square of the angle, so that a millionth of a radian is
// 1e-10 m.
TEST(Aim, ATargetOnTheEnvelopeIsHitOnce) {
  const double x = 180, v = 50, z = v * v / (2 * kGravity) - kGravity * x * x / (2 * v * v);
  const AimResult result = aim(aim_task(cannon(v), {"theta=1deg:89deg"}, Vector3(x, 0, z)));
  EXPECT_EQ(result.status, AimStatus::found);
  ASSERT_EQ(result.solutions.size(), 1u);
  EXPECT_NEAR(result.solutions[0].parameters[0], std::atan(v * v / (kGravity * x)), 1e-5);
  // a micrometre inside there are two, a micrometre outside there is none
  EXPECT_EQ(aim(aim_task(cannon(v), {"theta=1deg:89deg"}, Vector3(x, 0, z - 1e-6))).solutions.size(), 2u);
  const AimResult outside = aim(aim_task(cannon(v), {"theta=1deg:89deg"}, Vector3(x, 0, z + 1e-6)));
  EXPECT_EQ(outside.status, AimStatus::unreachable);
  ASSERT_TRUE(outside.closest);
  EXPECT_NEAR(outside.closest->miss, 1e-6 / std::hypot(1.0, kGravity * x / (v * v)), 1e-10);
}

TEST(Aim, ARangeThatEndsAtASolutionHoldsIt) {
  const std::vector<double> exact = elevations(50, 200, 10);
  const AimTask task = aim_task(cannon(50), {"theta=" + number(exact[0]) + ":0.9"}, Vector3(200, 0, 10));
  const AimResult result = aim(task);
  ASSERT_EQ(result.solutions.size(), 1u);
  EXPECT_NEAR(result.solutions[0].parameters[0], exact[0], 1e-12);
}

/// Where the body of a scene is at a time, with other parameters.
Vector3 place_at(const AimTask& task, const std::vector<double>& parameters, double time) {
  Scene scene = task.scene;
  for (std::size_t i = 0; i < parameters.size(); ++i) task.unknowns[i].quantity.bind(scene)(parameters[i]);
  scene.time.end = time;
  return run(scene).final.bodies[0].position;
}

TEST(Aim, WithDragARunGoesThroughTheTarget) {
  const AimTask task = aim_task(cannon(90, 0.004), {"theta=1deg:89deg"}, Vector3(180, 0, 5));
  const AimResult result = aim(task);
  ASSERT_EQ(result.solutions.size(), 2u);
  for (const AimSolution& each : result.solutions)
    EXPECT_LT((place_at(task, each.parameters, each.time) - Vector3(180, 0, 5)).norm(), 1e-9);
  // and beyond its reach says so, with a distance that a scan of a thousand shots does not beat
  AimTask beyond = task;
  beyond.target = Vector3(320, 0, 5);
  const AimResult missed = aim(beyond);
  EXPECT_EQ(missed.status, AimStatus::unreachable);
  ASSERT_TRUE(missed.closest);
  const Vector3 nearest = place_at(beyond, missed.closest->parameters, missed.closest->time);
  EXPECT_NEAR((nearest - Vector3(320, 0, 5)).norm(), missed.closest->miss, 1e-9);
  beyond.unknowns[0].low = missed.closest->parameters[0] - 1e-3;
  beyond.unknowns[0].high = missed.closest->parameters[0] + 1e-3;
  EXPECT_NEAR(aim(beyond).closest->miss, missed.closest->miss, 1e-9);
}

TEST(Aim, TwoUnknownsFindAzimuthAndElevation) {
  const double x = 150, y = -70, z = 12;
  const AimResult result = aim(aim_task(cannon(50), {"theta=1deg:89deg", "phi=-60deg:40deg"}, Vector3(x, y, z)));
  const std::vector<double> exact = elevations(50, std::hypot(x, y), z);
  ASSERT_EQ(result.solutions.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(result.solutions[i].parameters[0], exact[i], 1e-12);
    EXPECT_NEAR(result.solutions[i].parameters[1], std::atan2(y, x), 1e-12);
  }
  EXPECT_FALSE(result.is_family);
}

TEST(Aim, OneUnknownThatCannotReachOutOfItsPlaneIsToldSo) {
  const AimResult result = aim(aim_task(cannon(50), {"theta=1deg:89deg"}, Vector3(200, 0.5, 10)));
  EXPECT_EQ(result.status, AimStatus::unreachable);
  ASSERT_TRUE(result.closest);
  EXPECT_NEAR(result.closest->miss, 0.5, 1e-12);
}

// Straight shots between two mirrors at y = -3 and 3: the target's images are at y = 6 k, and k is the number of
// bounces. A shot of 30 m comes to those within 30 m.
TEST(Aim, AllShotsOffWallsAreThoseAtMirrorImages) {
  const std::string scene = R"(
[parameters]
phi = 0.0
[time]
end = 3
[[body]]
name = "ball"
velocity = "10*[cos(phi), sin(phi), 0]"
[[obstacle]]
name = "left"
shape = "plane"
point = [0, 3, 0]
normal = [0, -1, 0]
on_hit = "bounce"
[[obstacle]]
name = "right"
shape = "plane"
point = [0, -3, 0]
normal = [0, 1, 0]
on_hit = "bounce"
)";
  const double x = 10.0, own = 1.0;  // the target at y = 1: images at 6 k + (-1)^k
  std::vector<std::pair<double, int>> exact;
  for (int k = -5; k <= 5; ++k) {
    const double y = 6.0 * k + (k % 2 == 0 ? own : -own);
    if (std::hypot(x, y) < 30.0) exact.emplace_back(std::atan2(y, x), std::abs(k));
  }
  std::sort(exact.begin(), exact.end());
  const AimResult result = aim(aim_task(scene, {"phi=-85deg:85deg"}, Vector3(x, own, 0)));
  ASSERT_EQ(result.solutions.size(), exact.size());
  ASSERT_GT(exact.size(), 7u);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_NEAR(result.solutions[i].parameters[0], exact[i].first, 1e-12);
    EXPECT_EQ(result.solutions[i].bounces, exact[i].second);
  }
}

const std::string kMovingTarget = R"(
[parameters]
phi = 0.0
[time]
end = 20
[[body]]
name = "shot"
velocity = "30*[cos(phi), sin(phi), 0]"
[[obstacle]]
name = "ship"
shape = "sphere"
center = [100, 0, 0]
velocity = [3, 12, 0]
radius = 1
)";

// |c + u t| = v t, then the direction of c + u t.
TEST(Aim, AMovingTargetIsLedByTheClosedForm) {
  const Vector3 c(100, 0, 0), u(3, 12, 0);
  const double v = 30, a = v * v - u.squaredNorm(), b = c.dot(u);
  const double t = (b + std::sqrt(b * b + a * c.squaredNorm())) / a;
  const Vector3 place = c + u * t;
  const AimTask task = aim_task(kMovingTarget, {"phi=-80deg:80deg"}, "ship");
  const AimResult result = aim(task);
  ASSERT_EQ(result.solutions.size(), 1u);
  EXPECT_NEAR(result.solutions[0].parameters[0], std::atan2(place.y(), place.x()), 1e-12);
  // the time is that of the impact, as a run reports it: on the near side of the ship, which moves
  Scene scene = task.scene;
  task.unknowns[0].quantity.bind(scene)(result.solutions[0].parameters[0]);
  const RunResult shot = run(scene);
  ASSERT_EQ(shot.impacts.size(), 1u);
  EXPECT_EQ(result.solutions[0].time, shot.impacts[0].time);
  EXPECT_EQ(result.solutions[0].point, shot.impacts[0].point);
  EXPECT_LT(result.solutions[0].time, t);
}

TEST(Aim, ATargetThatStopsTheFlightIsHitInItsCentre) {
  std::string scene = cannon(50) + R"(
[[obstacle]]
name = "target"
shape = "disk"
center = [180, 0, 20]
normal = [-1, 0, 0.5]
radius = 0.2
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, -0.001]
normal = [0, 0, 1]
)";
  const AimResult result = aim(aim_task(scene, {"theta=1deg:89deg"}, "target"));
  const std::vector<double> exact = elevations(50, 180, 20);
  ASSERT_EQ(result.solutions.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(result.solutions[i].parameters[0], exact[i], 1e-12);
    EXPECT_LT((result.solutions[i].point - Vector3(180, 0, 20)).norm(), 1e-11);
  }
}

TEST(Aim, AWallBeforeTheTargetLeavesTheHighArc) {
  const std::string scene = cannon(50) + R"(
[[obstacle]]
name = "wall"
shape = "box"
center = [100, 0, 0]
size = [1, 100, 120]
)";
  const AimResult result = aim(aim_task(scene, {"theta=1deg:89deg"}, Vector3(200, 0, 10)));
  ASSERT_EQ(result.solutions.size(), 1u);
  EXPECT_NEAR(result.solutions[0].parameters[0], elevations(50, 200, 10)[1], 1e-12);
}

TEST(Aim, ConditionsAndWhatIsLeastChooseAmongSolutions) {
  AimTask task = aim_task(cannon(50), {"theta=1deg:89deg"}, Vector3(200, 0, 10));
  task.conditions = {"t > 6", "max(z) > 50"};
  const std::vector<double> exact = elevations(50, 200, 10);
  AimResult result = aim(task);
  ASSERT_EQ(result.solutions.size(), 1u);
  EXPECT_NEAR(result.solutions[0].parameters[0], exact[1], 1e-12);
  EXPECT_EQ(result.refused, 1);
  task.conditions = {"speed > 51"};
  EXPECT_EQ(aim(task).status, AimStatus::unreachable);
  task.conditions.clear();
  task.minimise = "time";
  result = aim(task);
  ASSERT_EQ(result.solutions.size(), 1u);
  EXPECT_NEAR(result.solutions[0].parameters[0], exact[0], 1e-12);
  task.minimise = "hit";
  EXPECT_THROW(aim(task), InputError);
}

// The least speed that reaches (x, z): v^2 = g (z + sqrt(x^2 + z^2)); there, v and the angle are one curve of
// solutions.
TEST(Aim, TheLeastSpeedOfAFamilyIsThatOfTheClosedForm) {
  AimTask task = aim_task(cannon(50), {"theta=1deg:89deg", "v0=20:80"}, Vector3(200, 0, 10));
  AimResult result = aim(task);
  EXPECT_TRUE(result.is_family);
  EXPECT_GT(result.solutions.size(), 10u);
  for (const AimSolution& each : result.solutions)
    EXPECT_LT((place_at(task, each.parameters, each.time) - Vector3(200, 0, 10)).norm(), 1e-9);
  task.minimise = "v0";
  result = aim(task);
  ASSERT_EQ(result.solutions.size(), 1u);
  EXPECT_NEAR(result.solutions[0].parameters[1], std::sqrt(kGravity * (10 + std::hypot(200, 10))), 1e-9);
}

TEST(Aim, WhatIsWrongInATaskIsSaid) {
  AimTask task = aim_task(kMovingTarget, {"phi=-80deg:80deg"}, "shipp");
  EXPECT_THROW(aim(task), InputError);
  task.target = "ship";
  task.body = "shott";
  EXPECT_THROW(aim(task), InputError);
  task.body = "shot";
  std::swap(task.unknowns[0].low, task.unknowns[0].high);
  EXPECT_THROW(aim(task), InputError);
  task.unknowns.clear();
  EXPECT_THROW(aim(task), InputError);
}

}  // namespace
}  // namespace trajet
