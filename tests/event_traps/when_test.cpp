// `when` events through whole runs: direction, action, and the places where counting goes wrong.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::run_text;
using test::Way;

std::vector<Way> ways() {
  return {{"taylor", "name = \"taylor\"\n"}, {"dopri5", "name = \"dopri5\"\n"}, test::fixed("rk4", 0.25),
          test::fixed("rk4", 0.1),           test::fixed("rk4", 1.0),           test::fixed("midpoint", 0.125)};
}

std::string event(const std::string& name, const std::string& when, const std::string& more = "") {
  return "[[event]]\nname = \"" + name + "\"\nwhen = \"" + when + "\"\n" + more;
}

/// A throw: z = 1 + 4.9 t - 4.9 t^2, apex at t = 1/2.
std::string thrown(const Way& way, double end = 2.0) {
  return "[time]\nend = " + test::number(end) + "\n[method]\n" + way.lines + R"([[body]]
name = "ball"
position = [0, 0, 1]
velocity = [1, 0, 4.9]
acceleration = [0, 0, -9.8]
)";
}

TEST(When, DirectionsAreToldApart) {
  for (const Way& way : ways()) {
    const RunResult result = run_text(
        thrown(way) + event("up", "ball.z - 2", "direction = \"rising\"\n") +
        event("down", "ball.z - 2", "direction = \"falling\"\n") + event("both", "ball.z - 2") +
        event("apex", "ball.vz", "direction = \"falling\"\n") + event("never", "ball.vz", "direction = \"rising\"\n"));
    // 1 = 4.9 (t - t^2)
    const double half = std::sqrt(0.25 - 1.0 / 4.9);
    struct Crossing {
      const char* name;
      double time;
      int direction;
    };
    const Crossing expected[] = {{"up", 0.5 - half, 1},
                                 {"both", 0.5 - half, 1},
                                 {"apex", 0.5, -1},
                                 {"down", 0.5 + half, -1},
                                 {"both", 0.5 + half, -1}};
    SCOPED_TRACE(way.name);
    ASSERT_EQ(result.events.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(result.events[i].event, expected[i].name);
      EXPECT_NEAR(result.events[i].time, expected[i].time, 1e-14);
      EXPECT_EQ(result.events[i].direction, expected[i].direction);
    }
    EXPECT_EQ(result.status, RunStatus::finished);
  }
}

TEST(When, StopEndsTheRunThere) {
  for (const Way& way : ways()) {
    const RunResult result = run_text(thrown(way) + event("apex", "ball.vz", "action = \"stop\"\n"));
    EXPECT_EQ(result.status, RunStatus::stopped);
    EXPECT_NEAR(result.end_time, 0.5, 1e-15);
    EXPECT_EQ(result.events.size(), 1u);
    EXPECT_NEAR(test::final_of(result, "ball").position.z(), 1.0 + 4.9 / 4.0, 1e-14);
  }
}

/// How far a method of fixed step is off in the integral of 20/m, the mass m falling by 1 kg/s: the next term of the
/// composite midpoint rule or Simpson's.
double quadrature_error(const Way& way, double from_mass, double to_mass) {
  if (way.lines.find("step") == std::string::npos) return 0.0;
  const double h = std::stod(way.name.substr(way.name.find(' ')));
  const auto derivative = [](int order, double m) { return order == 1 ? 20.0 / (m * m) : 120.0 / std::pow(m, 4); };
  const int order = way.name.starts_with("midpoint") ? 1 : 3;
  const double factor = order == 1 ? -h * h / 24.0 : std::pow(h, 4) / 2880.0;
  return factor * (derivative(order, to_mass) - derivative(order, from_mass));
}

TEST(When, SetDropsAStage) {
  // Thrust 20 N; the mass burns down from 10 kg by 1 kg/s and at 8 kg drops by 4 more: a = 20/(10 - t), then 20/(4 - (t
  // - 2)).
  for (const Way& way : ways()) {
    const RunResult result = run_text("[time]\nend = 4\n[method]\n" + way.lines + R"(
[[body]]
name = "rocket"
force = [20, 0, 0]
mass = "mass"
[[state]]
name = "mass"
value = 10
rate = -1
)" + event("staging", "mass - 8", "direction = \"falling\"\nset = { mass = \"mass - 4\" }\n"));
    SCOPED_TRACE(way.name);
    ASSERT_EQ(result.events.size(), 1u) << result.failure;
    EXPECT_NEAR(result.events[0].time, 2.0, 1e-13);
    EXPECT_NEAR(test::state_of(result, "mass"), 2.0, 1e-13);
    const double speed = 20.0 * (std::log(10.0 / 8.0) + std::log(4.0 / 2.0));
    // the terms that follow are (h/m)^2 of this one, m at least 2 kg
    const double error = quadrature_error(way, 10.0, 8.0) + quadrature_error(way, 4.0, 2.0);
    EXPECT_NEAR(test::final_of(result, "rocket").velocity.x(), speed + error, 1e-10 + 0.3 * std::abs(error));
  }
}

TEST(When, SetIsComputedFromTheStateBefore) {
  const RunResult result = run_text(
      "[time]\nend = 2\n[[state]]\nname = \"a\"\nvalue = 1\nrate = 0\n"
      "[[state]]\nname = \"b\"\nvalue = 2\nrate = 0\n" +
      event("swap", "t - 1 + 0*a", "set = { a = \"b\", b = \"a\" }\n"));
  EXPECT_EQ(test::state_of(result, "a"), 2.0);
  EXPECT_EQ(test::state_of(result, "b"), 1.0);
}

TEST(When, SetMovesABody) {
  // A portal: whatever falls to z = 0 comes out at z = 1 with the same velocity.
  const RunResult result =
      run_text(thrown(ways()[0]) +
               event("portal", "ball.z", "direction = \"falling\"\nset = { ball.z = \"1\", ball.v = \"ball.v\" }\n"));
  ASSERT_GE(result.events.size(), 2u);
  const double first = 0.5 + std::sqrt(0.25 + 1.0 / 4.9);
  EXPECT_NEAR(result.events[0].time, first, 1e-14);
  const double speed = 9.8 * (first - 0.5);
  EXPECT_NEAR(result.events[1].time - first, (-speed + std::sqrt(speed * speed + 2.0 * 9.8)) / 9.8, 1e-14);
}

TEST(When, AtTheEndsOfStepsExactlyOnce) {
  // The apex and the crossings of z = 1 at t = 1 lie on step ends.
  for (const Way& way : ways()) {
    const RunResult result = run_text(thrown(way) + event("apex", "ball.vz") + event("level", "ball.z - 1"));
    ASSERT_EQ(result.events.size(), 2u) << way.name;
    EXPECT_EQ(result.events[0].event, "apex");
    EXPECT_NEAR(result.events[0].time, 0.5, 1e-15) << way.name;
    // the start on zero is no crossing, the return is
    EXPECT_EQ(result.events[1].event, "level");
    EXPECT_NEAR(result.events[1].time, 1.0, 1e-14) << way.name;
  }
}

TEST(When, OfTimeAlone) {
  for (const Way& way : ways()) {
    const RunResult result =
        run_text(thrown(way) + event("clock", "sin(2*pi*(t - 0.125))", "direction = \"rising\"\n"));
    ASSERT_EQ(result.events.size(), 2u) << way.name;
    EXPECT_NEAR(result.events[0].time, 0.125, 1e-14) << way.name;
    EXPECT_NEAR(result.events[1].time, 1.125, 1e-14) << way.name;
  }
}

TEST(When, ExactlyAtTheStartIsNone) {
  for (const Way& way : ways()) {
    const RunResult result =
        run_text(thrown(way) + event("start", "t") + event("height", "ball.z - 1", "direction = \"rising\"\n"));
    EXPECT_TRUE(result.events.empty()) << way.name;
  }
}

TEST(When, AConditionIsRefusedSinceItCrossesNoZero) {
  for (const char* condition : {"ball.z > 1", "ball.z > 1 and t < 2", "not t"}) {
    try {
      run_text(thrown(ways()[0]) + event("high", condition));
      ADD_FAILURE() << condition;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("'when' is a condition"), std::string::npos) << error.what();
    }
  }
  // what only contains one jumps across zero where it changes
  const RunResult result = run_text(thrown(ways()[0]) + event("late", "where(t > 0.125, 1, -1)"));
  ASSERT_EQ(result.events.size(), 1u);
  EXPECT_NEAR(result.events[0].time, 0.125, 1e-14);
}

TEST(When, TwoAtOneTimeInTheOrderOfTheScene) {
  for (const Way& way : ways()) {
    const RunResult result =
        run_text(thrown(way) + event("b", "t - 0.5") + event("a", "0.5 - t") + event("c", "ball.x - 0.5"));
    ASSERT_EQ(result.events.size(), 3u) << way.name;
    for (const EventRecord& each : result.events) EXPECT_NEAR(each.time, 0.5, 1e-15) << way.name;
    std::string of_time;  // the third has a rounding of its own
    for (const EventRecord& each : result.events) of_time += each.event == "c" ? "" : each.event;
    EXPECT_EQ(of_time, "ba") << way.name;
  }
}

TEST(When, ASetAtTheTimeOfAnotherEventHidesNeither) {
  for (const Way& way : ways()) {
    const RunResult result = run_text(thrown(way) + "[[state]]\nname = \"n\"\nvalue = 0\nrate = 0\n" +
                                      event("first", "t - 0.5 + 0*n", "set = { n = \"n + 1\" }\n") +
                                      event("second", "t - 0.5 + 0*n", "set = { n = \"n + 10\" }\n"));
    EXPECT_EQ(result.events.size(), 2u) << way.name;
    EXPECT_EQ(test::state_of(result, "n"), 11.0) << way.name;
  }
}

TEST(When, ADoubleCrossingWithinAStepCountsTwice) {
  // The height peeps 1e-9 m over the level.
  for (const Way& way : ways()) {
    const RunResult result =
        run_text(thrown(way) + event("peep", "ball.z - 2.225 + 1e-9") + event("miss", "ball.z - 2.225 - 1e-9"));
    ASSERT_EQ(result.events.size(), 2u) << way.name;
    const double half = std::sqrt(1e-9 / 4.9);
    EXPECT_NEAR(result.events[0].time, 0.5 - half, 1e-10) << way.name;
    EXPECT_NEAR(result.events[1].time, 0.5 + half, 1e-10) << way.name;
  }
}

TEST(When, OverTwoBodiesAndAVectorFunction) {
  // Two bodies that pass each other: their distance falls below 1 m and rises above it again.
  for (const Way& way : ways()) {
    const RunResult result = run_text("[time]\nend = 10\n[method]\n" + way.lines + R"(
[[body]]
name = "a"
velocity = [1, 0, 0]
[[body]]
name = "b"
position = [10, 0.6, 0]
velocity = [-1, 0, 0]
)" + event("near", "norm(a.r - b.r) - 1", "direction = \"falling\"\n") +
                                      event("far", "norm(a.r - b.r) - 1", "direction = \"rising\"\n"));
    ASSERT_EQ(result.events.size(), 2u) << way.name;
    EXPECT_NEAR(result.events[0].time, 4.6, 1e-13) << way.name;
    EXPECT_NEAR(result.events[1].time, 5.4, 1e-13) << way.name;
  }
}

TEST(When, AnEventAndAnImpactAtOneTimeAreBothSeen) {
  for (const Way& way : ways()) {
    const RunResult result = run_text("[time]\nend = 3\n[method]\n" + way.lines + R"(
[[body]]
name = "ball"
position = [0, 0, 2]
velocity = [1, 0, -1]
[[obstacle]]
name = "floor"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
)" + event("level", "ball.x - 2"));
    EXPECT_EQ(result.events.size(), 1u) << way.name;
    EXPECT_EQ(result.impacts.size(), 1u) << way.name;
    EXPECT_EQ(test::final_of(result, "ball").velocity, Vector3(1, 0, 1)) << way.name;
  }
}

TEST(When, ABounceIsACrossingOfWhatItStopsAndOfWhatJumps) {
  // The speed jumps over zero at a bounce. The height comes to zero, and the bounce turns it back.
  for (const Way& way : ways()) {
    const RunResult result = run_text("[time]\nend = 3.5\n[method]\n" + way.lines + R"(
[[body]]
name = "ball"
position = [0, 0, 4.9]
acceleration = [0, 0, -9.8]
[[obstacle]]
name = "floor"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
)" + event("apex", "ball.vz") + event("height", "ball.z"));
    std::string names;
    for (const EventRecord& each : result.events) {
      names += each.event + (each.direction > 0 ? " up, " : " down, ");
    }
    EXPECT_EQ(names, "height down, apex up, apex down, height down, apex up, ") << way.name;
    EXPECT_EQ(result.impacts.size(), 2u) << way.name;
  }
}

TEST(When, ABouncingBallMadeOfSets) {
  // As MATLAB's ballode makes it: a crossing of zero turns the speed round. Whatever the direction watched, the turn
  // itself is no second crossing.
  for (const Way& way : ways()) {
    for (const char* direction : {"any", "falling"}) {
      const RunResult result = run_text("[time]\nend = 6.5\n[method]\n" + way.lines + R"(
[[body]]
name = "ball"
position = [0, 0, 4.9]
acceleration = [0, 0, -9.8]
)" + event("bounce", "ball.z", std::string("direction = \"") + direction + "\"\nset = { ball.vz = \"-ball.vz\" }\n"));
      ASSERT_EQ(result.events.size(), 3u) << way.name << " " << direction;
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(result.events[static_cast<std::size_t>(i)].time, 1.0 + 2.0 * i, 1e-13) << way.name;
    }
  }
}

TEST(When, ASetInsideAnObstacleThatIsPassed) {
  // Who is inside a sphere stays inside it when only a mass changes; who is moved out is out.
  const std::string scene = R"(
[time]
end = 10
[[body]]
name = "probe"
velocity = [1, 0, 0]
[[state]]
name = "n"
value = 0
rate = 0
[[obstacle]]
name = "cloud"
shape = "sphere"
center = [5, 0, 0]
radius = 2
on_hit = "pass"
)";
  const RunResult stays = run_text(scene + event("count", "probe.x - 5 + 0*n", "set = { n = \"n + 1\" }\n"));
  ASSERT_EQ(stays.status, RunStatus::finished) << stays.failure;
  ASSERT_EQ(stays.impacts.size(), 2u);
  EXPECT_EQ(stays.impacts[1].time, 7.0);
  const RunResult jumps =
      run_text(scene + event("jump", "probe.x - 5", "direction = \"rising\"\nset = { probe.x = \"0\" }\n"));
  EXPECT_EQ(jumps.status, RunStatus::finished) << jumps.failure;
  EXPECT_EQ(jumps.events.size(), 2u);
  EXPECT_EQ(jumps.impacts.size(), 2u);  // in at 3 and at 8
}

TEST(When, AJumpAcrossZeroIsACrossing) {
  // q = t, at least up to 2; at the ends of steps (rk4 0.25, 0.1; of taylor where the law jumps) and within.
  const std::vector<std::string> jumps = {"where(t < 2, -1, 1)", "where(t <= 2, -1, 1)", "sign(q - 2)",
                                          "floor(t) - 1.5", "where(q > 2, 3 - t, -1)"};
  for (const std::string rate : {"1", "where(t < 2, 1, 1.5)"})
    for (const std::string& jump : jumps)
      for (const Way& way : ways()) {
        SCOPED_TRACE(way.name + ", " + jump + ", rate " + rate);
        const RunResult result =
            run_text("[time]\nend = 2.9\n[method]\n" + way.lines + "[[state]]\nname = \"q\"\nvalue = 0\nrate = \"" +
                     rate + "\"\n" + event("jump", jump));
        ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
        ASSERT_EQ(result.events.size(), 1u);
        // methods that step across the law's jump know q there to their interpolant's error only
        const bool is_exact = rate == "1" || way.name == "taylor" || jump.find('q') == std::string::npos;
        EXPECT_NEAR(result.events[0].time, 2.0, is_exact ? 1e-13 : 0.5);
        EXPECT_EQ(result.events[0].direction, 1);
      }
}

}  // namespace
}  // namespace trajet
