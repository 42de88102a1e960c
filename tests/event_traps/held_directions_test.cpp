// Dry friction that is written by the direction of the velocity, `-b*unit(v)`: what it has stopped it holds, until the
// pull is stronger.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "event_traps/tolerated_methods.hpp"
#include "scene_run.hpp"

namespace trajet {
namespace {

using test::events_named;
using test::number;
using test::run_text;
using test::ToleratedWay;
using test::vector;

std::vector<ToleratedWay> ways_for(double end) {
  std::vector<ToleratedWay> all = test::controlled_ways();
  for (const auto& [name, tolerance] : std::initializer_list<std::pair<const char*, double>>{
           {"rk4", 1e-5}, {"gauss6", 1e-5}, {"midpoint", 1e-3}, {"heun", 1e-3}})
    all.push_back({test::fixed(name, end / 500.0), tolerance});
  return all;
}

/// Ways to write friction of the size b.
std::string friction(std::size_t way, double b) {
  const std::string size = number(b);
  const std::string texts[] = {"- " + size + "*unit(v)", "- " + size + "*v/norm(v)", "- " + size + "/norm(v)*v",
                               "- unit(2*v)*" + size};
  return texts[way % 4];
}

// Along a line, whichever way it points in space: x'' = a - b sign(x').
TEST(HeldDirections, ABlockStopsAndStaysOrTurnsBack) {
  std::mt19937 random(18);
  std::uniform_real_distribution<> uniform(-1.0, 1.0);
  std::size_t stuck = 0;
  constexpr double kEnd = 3.0;
  for (std::size_t i = 0; i < 1000; ++i) {
    const double a = 2.0 * uniform(random), b = 2.5 + 1.5 * uniform(random);
    const double v0 = i % 7 == 0 ? 0.0 : 4.0 * uniform(random);
    if (std::abs(std::abs(a) - b) < 0.05 || (v0 != 0.0 && std::abs(v0) < 0.1)) continue;
    const bool holds = std::abs(a) < b;
    const Vector3 along =
        i % 2 == 0 ? Vector3::UnitX() : Vector3(uniform(random), uniform(random), uniform(random)).normalized();
    const double slowing = b - a * (v0 > 0.0 ? 1.0 : -1.0);
    const double stop = v0 == 0.0 ? 0.0 : slowing > 0.0 ? std::abs(v0) / slowing : 2.0 * kEnd;
    const double s = v0 > 0.0 ? 1.0 : -1.0;
    double x = v0 * kEnd + 0.5 * (a - s * b) * kEnd * kEnd, v = v0 + (a - s * b) * kEnd;
    if (stop < kEnd) {
      const double rest = kEnd - stop, pull = holds ? 0.0 : a - std::copysign(b, a);
      x = 0.5 * v0 * stop + 0.5 * pull * rest * rest;
      v = pull * rest;
    }
    const std::vector<ToleratedWay> ways = ways_for(kEnd);
    const ToleratedWay& way = ways[i % ways.size()];
    const std::string text = "[time]\nend = 3\n[method]\nmax_steps = 20000\n" + way.way.lines +
                             "[[body]]\nname = \"block\"\nvelocity = " + vector(v0 * along) + "\nacceleration = \"" +
                             vector(a * along) + " " + friction(i / 15, b) + "\"\n";
    SCOPED_TRACE(text);
    const RunResult result = run_text(text);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    const BodyState& final = test::final_of(result, "block");
    ASSERT_NEAR((final.position - x * along).norm(), 0.0, 10.0 * way.tolerance);
    ASSERT_NEAR((final.velocity - v * along).norm(), 0.0, 10.0 * way.tolerance);
    const std::vector<EventRecord> sticks = events_named(result, "sticks");
    ASSERT_EQ(sticks.size(), holds && stop < kEnd ? 1u : 0u);
    ASSERT_TRUE(events_named(result, "slips").empty());
    if (sticks.empty()) continue;
    ++stuck;
    ASSERT_NEAR(sticks[0].time, stop, 10.0 * way.tolerance);
    ASSERT_EQ(sticks[0].law, "acceleration of body 'block'");
    ASSERT_LT(final.velocity.norm(), 1e-15);
  }
  EXPECT_GT(stuck, 300u);
}

// Across an incline the way bends. With the pull a and friction b: d(b |v| + a v_x)/dt = a^2 - b^2, and the work of
// both is what its energy loses.
TEST(HeldDirections, ABlockThrownAcrossAnInclineStops) {
  for (const ToleratedWay& way : ways_for(3.0)) {
    const RunResult result =
        run_text("[time]\nend = 3\n[method]\nmax_steps = 20000\n" + way.way.lines +
                 "[[state]]\nname = \"way\"\nvalue = 0\nrate = \"norm(b.v)\"\n"
                 "[[body]]\nname = \"b\"\nvelocity = [2, 1, 0]\nacceleration = \"[1, 0, 0] - 3*unit(v)\"\n");
    SCOPED_TRACE(way.way.name + result.failure);
    ASSERT_EQ(result.status, RunStatus::finished);
    const BodyState& final = test::final_of(result, "b");
    EXPECT_EQ(final.velocity.norm(), 0.0);
    // v^2/2 = 5/2 = b s - a x
    EXPECT_NEAR(3.0 * test::state_of(result, "way") - final.position.x(), 2.5, 100.0 * way.tolerance);
    ASSERT_EQ(events_named(result, "sticks").size(), 1u);
    EXPECT_NEAR(events_named(result, "sticks")[0].time, (3.0 * std::sqrt(5.0) + 2.0) / 8.0, 100.0 * way.tolerance);
  }
}

TEST(HeldDirections, AGrowingForceTearsABlockLoose) {
  // x'' = 5 sin t - 3 sign(v), from rest: it slips where 5 sin t = 3
  const double slip = std::asin(0.6), end = 2.0;
  const double v = 5.0 * (std::cos(slip) - std::cos(end)) - 3.0 * (end - slip);
  for (const ToleratedWay& way : ways_for(end)) {
    const RunResult result = run_text("[time]\nend = 2\n[method]\nmax_steps = 20000\n" + way.way.lines +
                                      "[[body]]\nname = \"block\"\nacceleration = \"[5*sin(t), 0, 0] - 3*unit(v)\"\n");
    SCOPED_TRACE(way.way.name + result.failure);
    EXPECT_NEAR(test::final_of(result, "block").velocity.x(), v, 10.0 * way.tolerance);
    ASSERT_EQ(result.events.size(), 2u);
    EXPECT_EQ(result.events[0].event, "sticks");
    EXPECT_EQ(result.events[0].time, 0.0);
    EXPECT_EQ(result.events[1].event, "slips");
    EXPECT_NEAR(result.events[1].time, slip, 10.0 * way.tolerance);
  }
}

TEST(HeldDirections, WhatNothingHoldsGoesThrough) {
  // a force of constant size to the origin: to and fro
  constexpr double kStep = 4.0 / 500.0;
  std::vector<ToleratedWay> ways = test::controlled_ways();
  // a step that is set and goes over the origin is as wrong as it is long
  for (const char* name : {"rk4", "gauss6"}) ways.push_back({test::fixed(name, kStep), 0.1 * kStep});
  for (const ToleratedWay& way : ways) {
    const RunResult result = run_text("[time]\nend = 4\n[method]\n" + way.way.lines +
                                      "[[body]]\nname = \"b\"\nposition = [1, 0, 0]\nacceleration = \"-unit(r)\"\n");
    const double since = 4.0 - 2.0 * std::sqrt(2.0);
    EXPECT_NEAR(test::final_of(result, "b").position.x(), 0.5 * since * since - 1.0, 10.0 * way.tolerance)
        << way.way.name;
    EXPECT_TRUE(events_named(result, "sticks").empty());
  }
}

}  // namespace
}  // namespace trajet
