// Laws that push to a border from both sides, as dry friction does: the motion stays there, and leaves when one side no
// longer pushes.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "event_traps/tolerated_methods.hpp"
#include "scene_run.hpp"

namespace trajet {
namespace {

using test::events_named;
using test::number;
using test::run_text;
using test::ToleratedWay;

std::vector<ToleratedWay> methods_for(double end) {
  std::vector<ToleratedWay> all = test::controlled_ways();
  const auto add = [&](const std::string& name, double tolerance) {
    all.push_back({test::fixed(name, end / 500.0), tolerance});
  };
  add("rk4", 1e-5);
  add("rk4-3/8", 1e-5);
  add("gauss6", 1e-6);
  add("series", 1e-5);
  add("midpoint", 1e-3);
  add("heun", 1e-3);
  add("rk4-doubling", 1e-5);
  add("euler", 1e-2);
  return all;
}

/// Ways to write friction of the size b against the velocity.
std::string friction(int way, double b) {
  const std::string size = number(b), twice = number(2.0 * b);
  switch (way % 4) {
    case 0:
      return "- " + size + "*sign(vx)";
    case 1:
      return "- where(vx > 0, " + size + ", where(vx < 0, -" + size + ", 0))";
    case 2:
      return "+ " + size + " - " + twice + "*(vx >= 0)";
    default:
      return "- where(vx >= 0, 1, -1)*" + size;
  }
}

TEST(Sticking, ABlockOnAnInclinedPlane) {
  std::mt19937 random(5);
  std::uniform_real_distribution<> uniform(0.0, 1.0);
  int stuck = 0;
  for (int i = 0; i < 1200; ++i) {
    const double gravity = 9.81, angle = 0.1 + 0.9 * uniform(random), mu = 0.1 + uniform(random);
    const double a = gravity * std::sin(angle), b = mu * gravity * std::cos(angle);
    const double v0 = i % 7 == 0 ? 0.0 : (i % 2 == 0 ? 1.0 : -1.0) * (0.5 + 4.0 * uniform(random));
    const double end = 3.0;
    const bool holds = b > a;
    if (std::abs(a - b) < 0.05) continue;
    // x'' = a - b sign(v): the time at which it stands still, if it does
    const double slowing = v0 > 0.0 ? b - a : a + b;
    const double stop = v0 == 0.0 ? 0.0 : slowing > 0.0 ? std::abs(v0) / slowing : 2.0 * end;
    double x = v0 * end + 0.5 * (a - b) * end * end, v = v0 + (a - b) * end;
    if (stop < end) {
      const double rest = holds ? 0.0 : end - stop;
      x = 0.5 * v0 * stop + 0.5 * (a - b) * rest * rest;
      v = (a - b) * rest;
    } else if (v0 < 0.0) {
      x = v0 * end + 0.5 * (a + b) * end * end;
      v = v0 + (a + b) * end;
    }
    const std::vector<ToleratedWay> methods = methods_for(end);
    const ToleratedWay& method = methods[static_cast<std::size_t>(i) % methods.size()];
    const std::string text = "[time]\nend = 3\n[method]\nmax_steps = 20000\n" + method.way.lines +
                             "[[body]]\nname = \"block\"\nvelocity = [" + number(v0) + ", 0, 0]\nacceleration = [\"" +
                             number(a) + " " + friction(i / 19, b) + "\", 0, 0]\n";
    SCOPED_TRACE(text);
    const RunResult result = run_text(text);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    const BodyState& final = test::final_of(result, "block");
    ASSERT_NEAR(final.position.x(), x, method.tolerance * 10.0);
    ASSERT_NEAR(final.velocity.x(), v, method.tolerance * 10.0);
    const std::vector<EventRecord> sticks = events_named(result, "sticks");
    ASSERT_TRUE(events_named(result, "slips").empty());
    ASSERT_EQ(sticks.size(), holds && stop < end ? 1u : 0u);
    if (sticks.empty()) continue;
    ++stuck;
    ASSERT_NEAR(sticks[0].time, stop, method.tolerance * 10.0);
    ASSERT_EQ(sticks[0].law, "acceleration of body 'block'");
    if (v0 != 0.0) {
      ASSERT_EQ(sticks[0].direction, v0 > 0.0 ? -1 : 1);
    }
    ASSERT_NEAR(final.velocity.x(), 0.0, 1e-9);
    ASSERT_NEAR(final.acceleration.x(), 0.0, 1e-9);
  }
  EXPECT_GT(stuck, 300);
}

TEST(Sticking, AGrowingForceTearsABlockLoose) {
  // x'' = 5 sin t - 3 sign(v), from rest: it slips where 5 sin t = 3
  const double slip = std::asin(0.6), end = 2.0;
  const double v = 5.0 * (std::cos(slip) - std::cos(end)) - 3.0 * (end - slip);
  for (const ToleratedWay& method : methods_for(end)) {
    const RunResult result = run_text("[time]\nend = 2\n[method]\n" + method.way.lines +
                                      "[[body]]\nname = \"block\"\nacceleration = [\"5*sin(t) - 3*sign(vx)\", 0, 0]\n");
    SCOPED_TRACE(method.way.name + result.failure);
    EXPECT_NEAR(test::final_of(result, "block").velocity.x(), v, 10.0 * method.tolerance);
    ASSERT_EQ(result.events.size(), 2u);
    EXPECT_EQ(result.events[0].event, "sticks");
    EXPECT_EQ(result.events[0].time, 0.0);
    EXPECT_EQ(result.events[1].event, "slips");
    EXPECT_EQ(result.events[1].direction, 1);
    EXPECT_NEAR(result.events[1].time, slip, 10.0 * method.tolerance);
  }
}

TEST(Sticking, AThermostatHoldsItsTemperature) {
  for (const ToleratedWay& method : methods_for(10.0)) {
    const RunResult result =
        run_text("[time]\nend = 10\n[method]\n" + method.way.lines +
                 "[[state]]\nname = \"u\"\nvalue = 10\nrate = \"where(u < 20, 5, -3) - 0.1*(u - 20)\"\n");
    SCOPED_TRACE(method.way.name + result.failure);
    EXPECT_NEAR(test::state_of(result, "u"), 20.0, 1e-6);
    // u = 70 - 60 exp(-t/10)
    const std::vector<EventRecord> sticks = events_named(result, "sticks");
    ASSERT_EQ(sticks.size(), 1u);
    EXPECT_NEAR(sticks[0].time, 10.0 * std::log(1.2), 100.0 * method.tolerance);
    EXPECT_EQ(sticks[0].law, "rate of state 'u'");
  }
}

// The upper block rides on the lower one, which the ground slows: two borders at once where both stand.
TEST(Sticking, ABlockOnABlock) {
  for (const ToleratedWay& method : methods_for(3.0)) {
    const RunResult result = run_text("[time]\nend = 3\n[method]\n" + method.way.lines + R"scene([[body]]
name = "lower"
velocity = [2, 0, 0]
acceleration = ["-2*2*sign(lower.vx) + 3*sign(upper.vx - lower.vx)", 0, 0]
[[body]]
name = "upper"
velocity = [2, 0, 0]
acceleration = ["-3*sign(upper.vx - lower.vx)", 0, 0]
)scene");
    SCOPED_TRACE(method.way.name + result.failure);
    // together they are slowed by 2
    for (const char* name : {"lower", "upper"}) {
      EXPECT_NEAR(test::final_of(result, name).position.x(), 1.0, 10.0 * method.tolerance) << name;
      EXPECT_NEAR(test::final_of(result, name).velocity.x(), 0.0, 1e-9) << name;
    }
    const std::vector<EventRecord> sticks = events_named(result, "sticks");
    ASSERT_EQ(sticks.size(), 2u);
    EXPECT_NEAR(sticks[1].time, 1.0, 10.0 * method.tolerance);
    EXPECT_TRUE(events_named(result, "slips").empty());
  }
}

// A chain of stick and slip: a block on a belt, pulled back by a spring.
TEST(Sticking, ABlockOnABeltSticksAndSlipsAgainAndAgain) {
  // It rides on the belt to x = 0.5, and then swings, x = 0.5 + 0.2 sin: it is as fast as the belt a turn later only.
  const double slip = 0.5 / 0.2, stick = slip + 2.0 * std::numbers::pi;
  for (const ToleratedWay& method : methods_for(10.0)) {
    const RunResult result = run_text("[time]\nend = 10\n[method]\n" + method.way.lines + R"scene([[body]]
name = "block"
velocity = [0.2, 0, 0]
acceleration = ["-x - 0.5*sign(vx - 0.2)", 0, 0]
)scene");
    SCOPED_TRACE(method.way.name + result.failure);
    const std::vector<EventRecord> slips = events_named(result, "slips");
    ASSERT_GE(slips.size(), 1u);
    EXPECT_NEAR(slips[0].time, slip, 100.0 * method.tolerance);
    EXPECT_EQ(slips[0].direction, -1);
    for (const EventRecord& event : events_named(result, "sticks"))
      EXPECT_TRUE(std::abs(event.time) < 1e-9 || event.time > stick - 1.0) << event.time;
  }
}

// Whatever the clock shows: from 1 the state comes to 0 in 1 s, and its rate would turn round again and again.
TEST(Sticking, AStateStaysWhereItsRateTurnsRound) {
  for (const ToleratedWay& method : methods_for(3.0))
    for (const std::string start : {"0", "1e8"}) {
      const RunResult result = run_text("[time]\nstart = " + start + "\nend = \"" + start +
                                        " + 3\"\n[method]\nmax_steps = 10000\n" + method.way.lines +
                                        "[[state]]\nname = \"calm\"\nvalue = 1\nrate = 1\n"
                                        "[[state]]\nname = \"x\"\nvalue = 1\nrate = \"where(x > 0, -k, k)\"\n"
                                        "[parameters]\nk = 1\n");
      SCOPED_TRACE(method.way.name + " " + start + result.failure);
      EXPECT_EQ(result.status, RunStatus::finished);
      EXPECT_NEAR(test::state_of(result, "x"), 0.0, 1e-9);
      EXPECT_NEAR(test::state_of(result, "calm"), 4.0, 1e-9);
      const std::vector<EventRecord> sticks = events_named(result, "sticks");
      ASSERT_EQ(sticks.size(), 1u);
      EXPECT_NEAR(sticks[0].elapsed, 1.0, 1e-9);
    }
}

/// A thermostat whose wanted temperature is that of a table of points at i, i = 0 … `last`.
Scene thermostat(const std::vector<double>& wanted) {
  Scene scene = parse_scene("[time]\nend = 10\n[[state]]\nname = \"u\"\nvalue = 1\nrate = \"0\"\n", "test.toml");
  std::vector<double> times;
  for (std::size_t i = 0; i < wanted.size(); ++i) times.push_back(static_cast<double>(i));
  scene.tables["wanted"] = std::make_shared<const LookupTable>(times, wanted);
  scene.states[0].rate = Expression::parse("where(u > table(\"wanted\", t), -5, 5)", SourceLocation{"test.toml", 6, 9});
  return scene;
}

// Times at which the table's pieces end are ends of steps, along the border too.
TEST(Sticking, ABorderMayFollowATableOfTime) {
  const std::vector<double> wanted{0.1, 1.0, 2.3, 1.7, -0.4, 0.6, 0.2, 1.9, 2.4, 2.2, 1.25};
  for (const ToleratedWay& method : methods_for(10.0)) {
    Scene scene = thermostat(wanted);
    scene.method = parse_scene("[time]\nend = 10\n[method]\n" + method.way.lines, "m.toml").method;
    const RunResult result = run(scene);
    SCOPED_TRACE(method.way.name + result.failure);
    ASSERT_EQ(result.status, RunStatus::finished);
    EXPECT_NEAR(test::state_of(result, "u"), 1.25, 10.0 * method.tolerance);
    const std::vector<EventRecord> sticks = events_named(result, "sticks");
    ASSERT_GE(sticks.size(), 1u);
    // the table's first cell is met on its way down: 1 - 5 t = wanted(t)
    const double met = sticks[0].time;
    EXPECT_NEAR((*scene.tables["wanted"])(met), 1.0 - 5.0 * met, 10.0 * method.tolerance);
    // it slips where the table falls or rises by more than 5 a second: here it never does
    EXPECT_TRUE(events_named(result, "slips").empty());
  }
}

// The parabola along one cell of this table meets the next one at its end: what a multistep method remembers of the old
// cell fits its error test, and is wrong.
TEST(Sticking, WhatIsRememberedOfTheLawBeforeACornerIsNotUsedBehindIt) {
  const std::vector<double> wanted{0.0, 1.0, 3.0, 2.0, -1.0, 0.5, 0.0, 4.0, 4.5, 4.0, 1.25};
  for (const ToleratedWay& method : test::controlled_ways()) {
    Scene scene = thermostat(wanted);
    scene.method = parse_scene("[time]\nend = 10\n[method]\n" + method.way.lines, "m.toml").method;
    const RunResult result = run(scene);
    SCOPED_TRACE(method.way.name + result.failure);
    ASSERT_EQ(result.status, RunStatus::finished);
    EXPECT_NEAR(test::state_of(result, "u"), 1.25, 10.0 * method.tolerance);
  }
}

TEST(Sticking, WhatCannotBeDecidedIsSaidWithItsPlace) {
  // so many points that a law along them is too long
  std::vector<double> wanted;
  for (int i = 0; i <= 300; ++i) wanted.push_back(std::sin(i));
  Scene scene = thermostat(wanted);
  const RunResult result = run(scene);
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_EQ(result.failure,
            "the law switches to and fro, and which of its branches holds cannot be decided: rate of state 'u' "
            "(test.toml:6:9: where(u > table(\"wanted\", t), -5, 5))");
}

}  // namespace
}  // namespace trajet
