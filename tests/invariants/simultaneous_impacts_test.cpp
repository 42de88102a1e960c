// Impacts at one instant in runs: cradles, racks, corners, and what must not depend on the order of the file.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "body_scene.hpp"
#include "trajet/collide/respond/impact_group.hpp"

namespace trajet::test {
namespace {

const std::string kReflections = "[method]\nsimultaneous = \"reflections\"\n";
const std::string kMoreau = "[method]\nsimultaneous = \"group\"\n";

/// Balls of 0.1 m on a line, of which `moving` come from the left and the others lie `gap` apart from 0 on.
RunResult run_cradle(int count, int moving, double gap, const std::string& method = "", double restitution = 1.0,
                     double end = 3.0) {
  std::string scene = "[time]\nend = " + number(end) + "\n" + method;
  for (int i = 0; i < count; ++i) {
    const bool comes = i < moving;
    const double x = (i - moving) * (0.1 + gap) - (comes ? 1.0 : 0.0);
    scene += BallOf{.name = "b" + std::to_string(i),
                    .radius = 0.05,
                    .position = {x, 0, 0},
                    .velocity = {comes ? 1.0 : 0.0, 0, 0},
                    .more = "restitution = " + number(restitution) + "\n"}
                 .text();
  }
  return run_text(scene);
}

std::vector<double> speeds(const RunResult& result) {
  std::vector<double> speeds;
  for (const BodyState& state : result.final.bodies) speeds.push_back(state.velocity.x());
  return speeds;
}

double energy(const RunResult& result, double mass) {
  double sum = 0.0;
  for (const BodyState& state : result.final.bodies) sum += 0.5 * mass * state.velocity.squaredNorm();
  return sum;
}

using List = std::vector<double>;

TEST(SimultaneousImpacts, OfATouchingCradleTheLastBallLeaves) {
  const RunResult three = run_cradle(3, 1, 0.0);
  ASSERT_EQ(three.status, RunStatus::finished) << three.failure;
  EXPECT_EQ(speeds(three), (List{0, 0, 1}));
  EXPECT_TRUE(three.warnings.empty());
  ASSERT_EQ(three.impacts.size(), 2u);
  for (const Impact& impact : three.impacts) {
    EXPECT_EQ(impact.time, three.impacts[0].time);
    EXPECT_EQ(impact.group, std::optional<int>(1));
    EXPECT_NEAR(impact.impulse.norm(), 1.0, 1e-15);
  }
  EXPECT_EQ(speeds(run_cradle(5, 1, 0.0)), (List{0, 0, 0, 0, 1}));
}

TEST(SimultaneousImpacts, OfATouchingCradleAsManyLeaveAsCome) {
  EXPECT_EQ(speeds(run_cradle(5, 2, 0.0)), (List{0, 0, 0, 1, 1}));
  EXPECT_EQ(speeds(run_cradle(5, 3, 0.0)), (List{0, 0, 1, 1, 1}));
}

/// (-1/3, 2/3, 2/3): published.
TEST(SimultaneousImpacts, MoreausLawOfATouchingCradle) {
  EXPECT_EQ(speeds(run_cradle(3, 1, 0.0, kMoreau)), (List{-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0}));
  const RunResult five = run_cradle(5, 1, 0.0, kMoreau);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(speeds(five)[i], i == 0 ? -0.6 : 0.4, 1e-15);
}

TEST(SimultaneousImpacts, ACradleWithGapsIsTheSequenceOfItsImpacts) {
  for (const std::string& method : {kReflections, kMoreau}) {
    const RunResult result = run_cradle(5, 1, 1e-3, method);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(speeds(result)[i], i == 4 ? 1.0 : 0.0, 1e-14);
    ASSERT_EQ(result.impacts.size(), 4u);
    for (const Impact& impact : result.impacts) EXPECT_FALSE(impact.group);
  }
  // two that come as one, to the first that is apart: what is known of the sequence
  EXPECT_NEAR(speeds(run_cradle(5, 2, 1e-3))[4], 1.0, 1e-14);
  EXPECT_NEAR(speeds(run_cradle(5, 2, 1e-3))[3], 1.0, 1e-14);
}

/// By reflections the response of touching balls is the limit of that of small gaps, inelastic ones too: the sequence
/// of impacts of a chain, done by hand.
TEST(SimultaneousImpacts, ATouchingChainIsTheLimitOfSmallGaps) {
  for (const double e : {0.9, 0.5}) {
    List chain{1, 0, 0, 0};
    for (int sweep = 0; sweep < 10'000; ++sweep)
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        if (!(chain[i] > chain[i + 1])) continue;
        const double change = 0.5 * (1.0 + e) * (chain[i] - chain[i + 1]);
        chain[i] -= change;
        chain[i + 1] += change;
      }
    const RunResult touching = run_cradle(4, 1, 0.0, kReflections, e, 2.0);
    ASSERT_EQ(touching.status, RunStatus::finished) << touching.failure;
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(speeds(touching)[i], chain[i], 1e-12) << e;
  }
}

TEST(SimultaneousImpacts, WhatTouchesAndMovesAlikeGoesOn) {
  for (const double speed : {0.0, 1.0 / 3.0, 123.4}) {
    std::string scene = "[time]\nend = 100\n";
    for (int i = 0; i < 4; ++i)
      scene += BallOf{.name = "b" + std::to_string(i),
                      .radius = 0.05,
                      .position = {0.1 * i, 0, 0},
                      .velocity = {speed, 0.7 * speed, 0}}
                   .text();
    const RunResult result = run_text(scene);
    EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
    EXPECT_TRUE(result.impacts.empty()) << speed;
  }
  // plastic: from the impact on they go on together, along any line
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int sample = 0; sample < 100; ++sample) {
    const Vector3 along = Vector3(normal(random), normal(random), normal(random)).normalized();
    std::string scene = "[time]\nend = 20\n";
    for (int i = 0; i < 4; ++i)
      scene += BallOf{.name = "b" + std::to_string(i),
                      .radius = 0.05,
                      .position = (0.1 * i - (i == 0 ? 1.0 : 0.0)) * along,
                      .velocity = (i == 0 ? 1.0 : 0.0) * along,
                      .more = "restitution = 0\n"}
                   .text();
    const RunResult result = run_text(scene);
    ASSERT_EQ(result.status, RunStatus::finished) << sample << result.failure;
    // a ball may touch its neighbour only by rounding: then that is an impact of its own
    EXPECT_LE(result.impacts.size(), 6u) << sample;
    for (const BodyState& state : result.final.bodies)
      EXPECT_NEAR((state.velocity - 0.25 * along).norm(), 0.0, 1e-12) << sample;
  }
}

TEST(SimultaneousImpacts, BallsThatTouchAtTheStartMayApproach) {
  std::string scene = "[time]\nend = 1\n";
  for (int i = 0; i < 3; ++i)
    scene += BallOf{.name = "b" + std::to_string(i),
                    .radius = 0.05,
                    .position = {0.1 * i, 0, 0},
                    .velocity = {i == 0 ? 1.0 : 0.0, 0, 0}}
                 .text();
  const RunResult result = run_text(scene);
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  EXPECT_EQ(speeds(result), (List{0, 0, 1}));
  for (const Impact& impact : result.impacts) EXPECT_EQ(impact.time, 0.0);
}

constexpr double kRadius = 0.028575;

std::string rack(double gap, double restitution, const std::string& law = "") {
  const double radius = kRadius, apart = 2.0 * radius + gap;
  const std::string more = "restitution = " + number(restitution) + "\n" + law;
  std::string scene =
      BallOf{.name = "cue", .radius = radius, .mass = 0.17, .position = {-1, 0, 0}, .velocity = {8, 0, 0}, .more = more}
          .text();
  for (int row = 0; row < 5; ++row)
    for (int k = 0; k <= row; ++k)
      scene += BallOf{.name = "b" + std::to_string(row) + std::to_string(k),
                      .radius = radius,
                      .mass = 0.17,
                      .position = {row * apart * std::sqrt(0.75), (k - 0.5 * row) * apart, 0},
                      .more = more}
                   .text();
  for (const double side : {-1.0, 1.0})
    scene += plane(side < 0.0 ? "left" : "right", {0, 0.635 * side, 0}, {0, -side, 0}, 0.8) +
             plane(side < 0.0 ? "near" : "far", {1.27 * side, 0, 0}, {-side, 0, 0}, 0.8);
  return scene;
}

void expect_symmetric(const RunResult& result) {
  for (int row = 0; row < 5; ++row)
    for (int k = 0; k <= row; ++k) {
      const BodyState& one = final_of(result, "b" + std::to_string(row) + std::to_string(k));
      const BodyState& other = final_of(result, "b" + std::to_string(row) + std::to_string(row - k));
      const Vector3 mirrored(other.position.x(), -other.position.y(), other.position.z());
      EXPECT_NEAR((one.position - mirrored).norm(), 0.0, 1e-9) << row << k;
    }
}

TEST(SimultaneousImpacts, ASymmetricBreakStaysSymmetric) {
  for (const double gap : {0.0, 1e-4})
    for (const double restitution : {1.0, 0.95})
      for (const std::string& method : {kReflections, kMoreau}) {
        const RunResult result = run_text("[time]\nend = 1\n" + method + rack(gap, restitution));
        SCOPED_TRACE(number(gap) + " " + number(restitution) + " " + method);
        ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
        expect_symmetric(result);
        EXPECT_LE(energy(result, 0.17), 0.5 * 0.17 * 64.0 * (1.0 + 1e-14));
      }
}

/// On a table that rubs, on which no impact presses: the break is what it is without one.
TEST(SimultaneousImpacts, OnATableWithFrictionABreakStaysSymmetric) {
  const std::string table =
      plane("table", {0, 0, -kRadius}, Vector3::UnitZ(), 0.5) + "friction = 0.2\nrolling_friction = \"0.05 mm\"\n";
  const RunResult result = run_text("[time]\nend = 0.4\n" + rack(0.0, 0.95, "acceleration = [0, 0, -9.81]\n") + table);
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  expect_symmetric(result);
  const RunResult free = run_text("[time]\nend = 0.4\n" + rack(0.0, 0.95));
  const auto breaks = [](const RunResult& of) {
    std::vector<Impact> group;
    for (const Impact& impact : of.impacts)
      if (impact.group == std::optional<int>(1)) group.push_back(impact);
    return group;
  };
  const std::vector<Impact> on_table = breaks(result), in_space = breaks(free);
  ASSERT_EQ(on_table.size(), in_space.size());
  EXPECT_GT(on_table.size(), 20u);
  // friction has slowed the cue ball down
  const double slower = on_table[0].velocity_before.norm() / in_space[0].velocity_before.norm();
  for (std::size_t i = 0; i < on_table.size(); ++i)
    EXPECT_NEAR((on_table[i].velocity_after - slower * in_space[i].velocity_after).norm(), 0.0, 1e-9) << i;
}

TEST(SimultaneousImpacts, ABreakOfBallsThatRubStaysSymmetric) {
  const std::string table = plane("table", {0, 0, -kRadius}, Vector3::UnitZ(), 0.5) + "friction = 0.2\n";
  const RunResult result =
      run_text("[time]\nend = 0.3\n" + rack(0.0, 0.95, "acceleration = [0, 0, -9.81]\nfriction = 0.06\n") + table);
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  expect_symmetric(result);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_GT(std::abs(final_of(result, "b11").angular_velocity.z()), 1.0);
}

/// G. Galperin, Regular and Chaotic Dynamics 8 (2003) 375: the digits of pi.
TEST(SimultaneousImpacts, GalperinsBallsCountTheDigitsOfPi) {
  double mass = 1.0;
  for (const std::size_t count : {3u, 31u, 314u, 3141u}) {
    const RunResult result = run_text(
        "[time]\nend = 100000\n" + BallOf{.name = "small", .radius = 0.1, .mass = 1.0, .position = {1, 0, 0}}.text() +
        BallOf{.name = "big", .radius = 0.1, .mass = mass, .position = {2, 0, 0}, .velocity = {-1, 0, 0}}.text() +
        plane("wall", Vector3::Zero(), Vector3::UnitX()));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    EXPECT_EQ(result.impacts.size(), count);
    mass *= 100.0;
  }
}

/// The same where all touch from the start: the count is that of the rounds, which the velocities show.
TEST(SimultaneousImpacts, GalperinsBallsTouchingEndAsTheyDoApart) {
  double mass = 1.0;
  for (int n = 0; n < 4; ++n, mass *= 100.0) {
    const auto run_from = [&](double small, double big) {
      return run_text(
          "[time]\nend = 1000\n" +
          BallOf{.name = "small", .radius = 0.1, .mass = 1.0, .position = {small, 0, 0}}.text() +
          BallOf{.name = "big", .radius = 0.1, .mass = mass, .position = {big, 0, 0}, .velocity = {-1, 0, 0}}.text() +
          plane("wall", Vector3::Zero(), Vector3::UnitX()));
    };
    const RunResult touching = run_from(0.1, 0.5), apart = run_from(1, 2);
    ASSERT_EQ(touching.status, RunStatus::finished) << touching.failure;
    for (const char* name : {"small", "big"})
      EXPECT_NEAR(final_of(touching, name).velocity.x(), final_of(apart, name).velocity.x(), 1e-9) << n;
  }
}

TEST(SimultaneousImpacts, FromARightAngledCornerABallComesBackTheWayItCame) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> part(0.1, 1.0);
  for (int sample = 0; sample < 200; ++sample) {
    const Vector3 velocity(-part(random), -part(random), -part(random));
    const double radius = sample % 2 == 0 ? 0.0 : 0.25;
    const std::string method = sample % 4 < 2 ? kReflections : kMoreau;
    std::string scene =
        "[time]\nend = 2\n" + method +
        BallOf{.name = "ball", .radius = radius, .position = Vector3::Constant(radius) - velocity, .velocity = velocity}
            .text();
    for (int i = 0; i < 3; ++i) scene += plane("w" + std::to_string(i), Vector3::Zero(), Vector3::Unit(i));
    const RunResult result = run_text(scene);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    EXPECT_NEAR((final_of(result, "ball").velocity + velocity).norm(), 0.0, 1e-15) << sample;
    EXPECT_TRUE(result.warnings.empty());
    ASSERT_EQ(result.impacts.size(), 3u);
    Vector3 impulse = Vector3::Zero();
    for (const Impact& impact : result.impacts) impulse += impact.impulse;
    EXPECT_NEAR((impulse + 2.0 * velocity).norm(), 0.0, 1e-15);
  }
}

/// Into the corner of several planes, in any order in the file: what the group makes of the velocity.
TEST(SimultaneousImpacts, OfACornerTheOrderOfTheFileDoesNotMatter) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int sample = 0; sample < 200; ++sample) {
    const Vector3 velocity(normal(random), normal(random), normal(random));
    std::vector<Vector3> normals;
    while (normals.size() < 2 + static_cast<std::size_t>(sample % 2)) {
      const Vector3 each = Vector3(normal(random), normal(random), normal(random)).normalized();
      if (each.dot(velocity) < -0.1) normals.push_back(each);
    }
    const double e = sample % 3 == 0 ? 0.0 : sample % 3 == 1 ? 1.0 : 0.6;
    const std::string method = sample % 4 < 2 ? kReflections : kMoreau;
    std::vector<GroupBody> bodies(1 + normals.size());
    bodies[0].velocity = velocity;
    bodies[0].inverse_mass = 1.0;
    std::vector<GroupContact> contacts;
    for (std::size_t i = 0; i < normals.size(); ++i)
      contacts.push_back({.first = 0, .second = static_cast<int>(i) + 1, .normal = normals[i], .restitution = e});
    const GroupResponse response =
        resolve_group(bodies, contacts, sample % 4 < 2 ? Simultaneous::reflections : Simultaneous::group);
    std::vector<std::size_t> order(normals.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    do {
      std::string scene =
          "[time]\nend = 1.5\n" + method + BallOf{.name = "p", .position = -velocity, .velocity = velocity}.text();
      for (const std::size_t i : order) scene += plane("w" + std::to_string(i), Vector3::Zero(), normals[i], e);
      const RunResult result = run_text(scene);
      ASSERT_EQ(result.status, RunStatus::finished) << sample << ": " << result.failure;
      EXPECT_NEAR((final_of(result, "p").velocity - response.after[0].velocity).norm(), 0.0, 1e-9) << sample;
      Vector3 impulses = Vector3::Zero();
      for (const Impact& impact : result.impacts) impulses += impact.impulse;
      EXPECT_NEAR((velocity + impulses - response.after[0].velocity).norm(), 0.0, 1e-9) << sample;
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

/// With friction too: what all walls of a corner do at once has no order.
TEST(SimultaneousImpacts, OfACornerThatRubsTheOrderOfTheFileDoesNotMatter) {
  std::vector<int> order{0, 1, 2};
  std::vector<BodyState> finals;
  do {
    std::string scene =
        "[time]\nend = 2\n" +
        BallOf{.name = "ball", .radius = 0.25, .position = {1.25, 1.05, 1.55}, .velocity = {-1, -0.8, -1.3}}.text();
    for (const int i : order)
      scene += plane("w" + std::to_string(i), Vector3::Zero(), Vector3::Unit(i), 0.9 - 0.1 * i) + "friction = 0.3\n";
    const RunResult result = run_text(scene);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    EXPECT_TRUE(result.warnings.empty());
    Vector3 impulse = Vector3::Zero();
    for (const Impact& impact : result.impacts) impulse += impact.impulse;
    finals.push_back(final_of(result, "ball"));
    EXPECT_NEAR((impulse - finals.back().velocity - Vector3(1, 0.8, 1.3)).norm(), 0.0, 1e-14);
    EXPECT_GT(finals.back().angular_velocity.norm(), 0.1);
    EXPECT_NEAR((finals.back().velocity - finals.front().velocity).norm(), 0.0, 1e-14);
    EXPECT_NEAR((finals.back().angular_velocity - finals.front().angular_velocity).norm(), 0.0, 1e-14);
  } while (std::next_permutation(order.begin(), order.end()));
}

/// A cluster of touching balls of any masses that one ball hits: with the bodies in another order of the file.
TEST(SimultaneousImpacts, OfAClusterTheOrderOfTheFileDoesNotMatter) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int sample = 0; sample < 40; ++sample) {
    const double e = sample % 2 == 0 ? 1.0 : 0.7;
    std::vector<BallOf> balls;
    // a triangle of three rows, in the plane of z = 0
    for (int row = 0; row < 3; ++row)
      for (int k = 0; k <= row; ++k)
        balls.push_back({.name = "b" + std::to_string(row) + std::to_string(k),
                         .radius = 0.5,
                         .mass = 0.5 + part(random),
                         .position = {row * std::sqrt(0.75), k - 0.5 * row, 0},
                         .more = "restitution = " + number(e) + "\n"});
    balls.push_back({.name = "cue",
                     .radius = 0.5,
                     .mass = 1.0,
                     .position = {-3.0, 0.3 * part(random), 0.2 * part(random)},
                     .velocity = {1, 0, 0},
                     .more = "restitution = " + number(e) + "\n"});
    const std::string head = "[time]\nend = 2.5\n" + (sample % 4 < 2 ? kReflections : kMoreau);
    const auto run_all = [&] {
      std::string scene = head;
      for (const BallOf& ball : balls) scene += ball.text();
      return run_text(scene);
    };
    const RunResult first = run_all();
    std::shuffle(balls.begin(), balls.end(), random);
    const RunResult second = run_all();
    ASSERT_EQ(first.status, RunStatus::finished) << first.failure;
    ASSERT_EQ(second.status, RunStatus::finished) << second.failure;
    Vector3 momentum = Vector3::Zero();
    double after = 0.0;
    for (const BallOf& ball : balls) {
      const Vector3 velocity = final_of(first, ball.name).velocity;
      EXPECT_NEAR((velocity - final_of(second, ball.name).velocity).norm(), 0.0, 1e-11) << sample << ball.name;
      momentum += ball.mass * velocity;
      after += 0.5 * ball.mass * velocity.squaredNorm();
    }
    EXPECT_NEAR((momentum - Vector3::UnitX()).norm(), 0.0, 1e-14) << sample;
    EXPECT_LE(after, 0.5 * (1.0 + 1e-14)) << sample;
    EXPECT_GE(after, e == 1.0 ? 0.5 * (1.0 - 1e-14) : 0.0) << sample;
  }
}

}  // namespace
}  // namespace trajet::test
