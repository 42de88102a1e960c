// Events that come faster and faster: infinitely many before a time that is known in closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "scene_run.hpp"

namespace trajet {
namespace {

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

/// The time that a failure names.
double time_in(const std::string& failure) {
  const auto at = failure.find("t = ");
  return at == std::string::npos ? std::nan("") : std::strtod(failure.c_str() + at + 4, nullptr);
}

/// `tolerance` of the limit that the failure names, s; `unseen`: how long flights last that are too low to be seen, s.
void expect_limit(const Ball& ball, const Way& way, double tolerance, double unseen = 0.0) {
  SCOPED_TRACE(ball.text(way));
  const RunResult result = run_text(ball.text(way));
  ASSERT_EQ(result.status, RunStatus::failed);
  EXPECT_NE(result.failure.find("infinitely often"), std::string::npos) << result.failure;
  EXPECT_NEAR(time_in(result.failure), ball.limit(), tolerance);
  // what is left when all further bounces seem to lie within 256 roundings of time, some of which are in that estimate
  const double roundings = 1000.0 * 0x1p-53 * std::max(std::abs(ball.limit()), ball.limit() - ball.start);
  EXPECT_NEAR(result.end_time, ball.limit(), unseen + roundings);
  EXPECT_NEAR(test::state_of(result, "y"), ball.floor, 1e-12);
}

TEST(Accumulation, ABounceWrittenAsAnEventEndsAtTheLimitOfItsBounces) {
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

TEST(Accumulation, RandomBallsEndAtTheirLimits) {
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
    // heights above a floor up to 2 m away from zero are told from it by some 2e-14 m: lower flights are not seen, nor
    // is the time that they last
    const double unseen = 2.0 * std::sqrt(2.0 * 2e-14 / ball.gravity) / (1.0 - ball.restitution);
    expect_limit(ball, ways()[static_cast<std::size_t>(i) % ways().size()], ball.floor == 0.0 ? 1e-12 : 1e-9,
                 ball.floor == 0.0 ? 0.0 : unseen);
    if (HasFailure()) return;
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
