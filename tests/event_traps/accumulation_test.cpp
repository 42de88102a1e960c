// Events that come faster and faster: infinitely many before a time that is known in closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::events_named;
using test::number;
using test::run_text;
using test::Way;

std::vector<Way> ways() {
  return {{"taylor", "name = \"taylor\"\n"},
          {"dopri5", "name = \"dopri5\"\n"},
          {"dop853", "name = \"dop853\"\n"},
          test::fixed("rk4", 0.07)};
}

struct Ball {
  double start;        // s
  double floor;        // m
  double height;       // m, above the floor
  double gravity;      // m/s^2
  double restitution;  // of each bounce
  std::string direction;
  std::string more;  // of the set

  std::string text(const Way& way) const {
    return "[time]\nstart = " + number(start) + "\nend = " + number(start + 100.0) + "\n[method]\n" + way.lines +
           "[[state]]\nname = \"y\"\nvalue = " + number(floor + height) +
           "\nrate = \"u\"\n[[state]]\nname = \"u\"\nvalue = 0\nrate = " + number(-gravity) +
           "\n[[event]]\nname = \"bounce\"\nwhen = \"y - (" + number(floor) + ")\"\ndirection = \"" + direction +
           "\"\nset = { u = \"-" + number(restitution) + "*u\"" + more + " }\n";
  }

  /// Behind the fall, each flight lasts as long as the one before times the restitution.
  double limit() const { return start + std::sqrt(2.0 * height / gravity) * (1.0 + restitution) / (1.0 - restitution); }
};

/// `tolerance` of the limit, s, at which the ball comes to rest.
void expect_limit(const Ball& ball, const Way& way, double tolerance) {
  SCOPED_TRACE(ball.text(way));
  const RunResult result = run_text(ball.text(way));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  const std::vector<EventRecord> sticks = events_named(result, "sticks");
  ASSERT_EQ(sticks.size(), 1u);
  EXPECT_NEAR(sticks[0].time, ball.limit(), tolerance);
  EXPECT_EQ(sticks[0].law, "event 'bounce'");
  EXPECT_EQ(sticks[0].direction, -1);
  EXPECT_EQ(result.events.back().event, "sticks");
  EXPECT_NEAR(test::state_of(result, "y"), ball.floor, 1e-12);
  EXPECT_EQ(test::state_of(result, "u"), 0.0);
}

TEST(Accumulation, ABounceWrittenAsAnEventComesToRestAtTheLimitOfItsBounces) {
  for (const Way& way : ways()) {
    expect_limit({0.0, 0.0, 1.0, 9.81, 0.7, "falling", ""}, way, 1e-14);
    expect_limit({0.0, 0.0, 1.0, 9.81, 0.7, "any", ""}, way, 1e-14);
    expect_limit({0.0, 0.0, 1.0, 9.81, 0.7, "falling", ", y = 0"}, way, 1e-14);
  }
  EXPECT_NEAR((Ball{0.0, 0.0, 1.0, 9.81, 0.7, "", ""}.limit()), 2.55863396558581, 1e-14);
}

TEST(Accumulation, WhatASetStopsIsNotDrivenThroughZero) {
  for (const Way& way : ways()) expect_limit({0.0, 0.0, 1.0, 9.81, 0.0, "falling", ""}, way, 1e-14);
}

TEST(Accumulation, RandomBallsRestFromTheirLimitsOn) {
  std::mt19937 random(12);
  std::uniform_real_distribution<> uniform(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const Ball ball{.start = i % 3 == 0 ? 0.0 : 20.0 * uniform(random) - 10.0,
                    .floor = i % 2 == 0 ? 0.0 : 4.0 * uniform(random) - 2.0,
                    .height = std::pow(10.0, 2.0 * uniform(random) - 1.0),
                    .gravity = 1.0 + 20.0 * uniform(random),
                    .restitution = 0.05 + 0.85 * uniform(random),
                    .direction = i % 5 == 0 ? "any" : "falling",
                    .more = {}};
    // heights above a floor up to 2 m away from zero are told from it by some 2e-14 m: lower flights are not seen
    expect_limit(ball, ways()[static_cast<std::size_t>(i) % ways().size()], ball.floor == 0.0 ? 1e-12 : 1e-9);
    if (HasFailure()) return;
  }
}

std::string bouncing(const Way& way, const std::string& pull, const std::string& more = {}) {
  return "[time]\nend = 8\n[method]\n" + way.lines +
         "[[state]]\nname = \"y\"\nvalue = 1\nrate = \"u\"\n[[state]]\nname = \"u\"\nvalue = 0\nrate = \"" + pull +
         "\"\n[[event]]\nname = \"bounce\"\nwhen = \"y\"\ndirection = \"falling\"\nset = { u = \"-0.7*u\"" + more +
         " }\n";
}

TEST(Accumulation, WhatRestsLeavesWhereTheLawLetsItGo) {
  for (const Way& way : ways()) {
    const RunResult result = run_text(bouncing(way, "-9.81 + 5*max(t - 3, 0)"));
    ASSERT_EQ(result.status, RunStatus::finished) << way.name << result.failure;
    const double leave = 3.0 + 9.81 / 5.0;
    ASSERT_EQ(events_named(result, "slips").size(), 1u) << way.name;
    EXPECT_NEAR(events_named(result, "slips")[0].time, leave, 1e-9) << way.name;
    EXPECT_EQ(events_named(result, "slips")[0].direction, 1);
    EXPECT_NEAR(test::state_of(result, "y"), 5.0 / 6.0 * std::pow(8.0 - leave, 3), 1e-9) << way.name;
  }
}

TEST(Accumulation, APullThatTurnsAtOnceLetsGoAtOnce) {
  for (const Way& way : ways()) {
    const RunResult result = run_text(bouncing(way, "where(t < 5, -9.81, 3)"));
    ASSERT_EQ(events_named(result, "slips").size(), 1u) << way.name << result.failure;
    EXPECT_EQ(events_named(result, "slips")[0].time, 5.0) << way.name;
    EXPECT_NEAR(test::state_of(result, "y"), 13.5, 1e-12) << way.name;
  }
}

TEST(Accumulation, WhatIsKickedOffBouncesToRestAgain) {
  for (const Way& way : ways()) {
    const RunResult result =
        run_text(bouncing(way, "-9.81") + "[[event]]\nname = \"kick\"\nwhen = \"t - 4\"\nset = { u = 2 }\n");
    ASSERT_EQ(result.status, RunStatus::finished) << way.name << result.failure;
    const std::vector<EventRecord> sticks = events_named(result, "sticks"), slips = events_named(result, "slips");
    ASSERT_EQ(sticks.size(), 2u) << way.name;
    ASSERT_EQ(slips.size(), 1u) << way.name;
    EXPECT_EQ(slips[0].time, 4.0);
    EXPECT_NEAR(sticks[1].time, 4.0 + 2.0 * 2.0 / 9.81 / (1.0 - 0.7), 1e-13) << way.name;
    EXPECT_NEAR(test::state_of(result, "y"), 0.0, 1e-13);
  }
}

TEST(Accumulation, ABodyRestsInACornerOfTwoEvents) {
  for (const Way& way : ways()) {
    const RunResult result =
        run_text("[time]\nend = 8\n[method]\n" + way.lines +
                 "[[body]]\nname = \"b\"\nposition = [0.5, 0, 1]\nvelocity = [0, 1, 0]\nacceleration = [-2, 0, -9.81]\n"
                 "[[event]]\nname = \"floor\"\nwhen = \"b.z\"\nset = { b.v = \"[b.vx, b.vy, -0.7*b.vz]\" }\n"
                 "[[event]]\nname = \"wall\"\nwhen = \"b.x\"\nset = { b.vx = \"-0.5*b.vx\" }\n");
    ASSERT_EQ(result.status, RunStatus::finished) << way.name << result.failure;
    EXPECT_EQ(events_named(result, "sticks").size(), 2u) << way.name;
    EXPECT_NEAR((test::final_of(result, "b").position - Vector3(0.0, 8.0, 0.0)).norm(), 0.0, 1e-12) << way.name;
    EXPECT_NEAR((test::final_of(result, "b").velocity - Vector3::UnitY()).norm(), 0.0, 1e-14) << way.name;
  }
}

TEST(Accumulation, ASetThatStillChangesSomethingInTheLimitEndsTheRun) {
  for (const Way& way : ways()) {
    const RunResult result =
        run_text(bouncing(way, "-9.81", ", n = \"n + 1\"") + "[[state]]\nname = \"n\"\nvalue = 0\nrate = 0\n");
    EXPECT_EQ(result.status, RunStatus::failed);
    EXPECT_NE(result.failure.find("infinitely often before t = 2.558633965585"), std::string::npos) << result.failure;
  }
}

TEST(Accumulation, ASetThatLetsTheMotionThroughDoesNot) {
  for (const Way& way : ways()) {
    const RunResult result = run_text("[time]\nend = 2\n[method]\n" + way.lines +
                                      "[[state]]\nname = \"y\"\nvalue = -1\nrate = \"u\"\n[[state]]\nname = \"u\"\n"
                                      "value = 1\nrate = 0\n[[event]]\nname = \"slow\"\nwhen = \"y\"\n"
                                      "set = { u = \"0.5*u\" }\n");
    EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
    EXPECT_EQ(result.events.size(), 1u);
    EXPECT_NEAR(test::state_of(result, "y"), 0.5, 1e-14);
  }
}

}  // namespace
}  // namespace trajet
