// Runs whose clock starts far from zero: Unix seconds, years of mission time. What happens does not depend on the year;
// only what reports can say of its time does.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "scene_run.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using test::number;
using test::run_text;

bool warns_of_clock(double start, double duration) {
  const RunResult result = run_text("[time]\nstart = " + number(start) + "\nend = " + number(start + duration) +
                                    "\n[[body]]\nname = \"b\"\n");
  for (const std::string& warning : result.warnings)
    if (warning.find("s apart") != std::string::npos) return true;
  return false;
}

TEST(Clock, AStartWithTooFewDigitsForTheReportsIsWarnedOf) {
  EXPECT_FALSE(warns_of_clock(0.0, 1e-9));
  EXPECT_FALSE(warns_of_clock(0.0, 1e9));
  EXPECT_FALSE(warns_of_clock(1e3, 10.0));  // 1.1e-13 s
  EXPECT_FALSE(warns_of_clock(1e8, 1e5));   // 1.5e-8 s
  EXPECT_TRUE(warns_of_clock(1e8, 10.0));
  EXPECT_TRUE(warns_of_clock(1.7e9, 10.0));  // 2.4e-7 s
  EXPECT_TRUE(warns_of_clock(-1.7e9, 10.0));
}

/// A ball under a pulse and a force of t, between a floor and what events make of it. Its times are multiples of 1/64
/// s, so that they are numbers on every clock here.
class Flight {
 public:
  explicit Flight(unsigned seed) : random_(seed) {
    method_ = std::vector<std::string>{"taylor", "dopri5", "dop853", "rodas5p", "bdf", "adams", "rk4"}[seed % 7];
    height_ = uniform(0.5, 4.0);
    restitution_ = uniform(0.0, 0.95);
    push_ = uniform(-3.0, 3.0);
    frequency_ = uniform(0.5, 5.0);
    begin_ = time();
    end_ = begin_ + 1.0 / 64.0;
    kick_ = time();
  }

  std::string text(double start) const {
    const std::string t0 = number(start);
    const auto at = [&](double elapsed) { return "(" + t0 + " + " + number(elapsed) + ")"; };
    return "[time]\nstart = " + t0 + "\nend = " + number(start + 4.0) + "\n[method]\nname = \"" + method_ + "\"\n" +
           (method_ == "rk4" ? "step = 0.0078125\n" : "") + "[[body]]\nname = \"ball\"\nposition = [0, 0, " +
           number(height_) + "]\nvelocity = [1, 0, 0]\nacceleration = \"[" + number(push_) + "*sin(" +
           number(frequency_) + "*(t - " + t0 + ")), where(t >= " + at(begin_) + " and t < " + at(end_) +
           ", 50, 0), -9.81]\"\n" +
           "[[obstacle]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\non_hit = "
           "\"bounce\"\nrestitution = " +
           number(restitution_) + "\n[[event]]\nname = \"kick\"\nwhen = \"t - " + at(kick_) +
           "\"\nset = {\"ball.v\" = \"ball.v + [0, 0, 1]\"}\n[[event]]\nname = \"east\"\nwhen = \"ball.x - 2\"\n";
  }

 private:
  double uniform(double a, double b) { return a + (b - a) * (static_cast<double>(random_()) / 4294967296.0); }
  double time() { return std::floor(uniform(16.0, 240.0)) / 64.0; }

  std::mt19937 random_;
  std::string method_;
  double height_, restitution_, push_, frequency_, begin_, end_, kick_;
};

TEST(Clock, WhatHappensIsTheSameInEveryYear) {
  std::size_t impacts = 0, events = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    const Flight flight(seed);
    const double start = std::round(std::pow(10.0, 0.01 * seed)) * (seed % 3 == 0 ? -1.0 : 1.0);  // 1 … 1e10 s
    const RunResult now = run_text(flight.text(0.0)), then = run_text(flight.text(start));
    ASSERT_EQ(now.status, RunStatus::finished) << seed << ": " << now.failure;
    ASSERT_EQ(then.status, now.status) << seed << ": " << then.failure;
    EXPECT_EQ(then.final.bodies[0].position, now.final.bodies[0].position) << seed;
    EXPECT_EQ(then.final.bodies[0].velocity, now.final.bodies[0].velocity) << seed;
    ASSERT_EQ(then.impacts.size(), now.impacts.size()) << seed;
    for (std::size_t i = 0; i < now.impacts.size(); ++i) {
      EXPECT_EQ(then.impacts[i].elapsed, now.impacts[i].elapsed) << seed;
      EXPECT_EQ(then.impacts[i].time, start + now.impacts[i].elapsed) << seed;
      // what the clock cannot show is part of the bound
      const auto apart = static_cast<double>((static_cast<Extended>(then.impacts[i].time) - start) -
                                             static_cast<Extended>(now.impacts[i].elapsed));
      EXPECT_LE(std::abs(apart), then.impacts[i].time_error_bound) << seed;
      EXPECT_EQ(then.impacts[i].velocity_after, now.impacts[i].velocity_after) << seed;
    }
    ASSERT_EQ(then.events.size(), now.events.size()) << seed;
    for (std::size_t i = 0; i < now.events.size(); ++i)
      EXPECT_EQ(then.events[i].elapsed, now.events[i].elapsed) << seed;
    impacts += now.impacts.size();
    events += now.events.size();
  }
  EXPECT_GT(impacts, 3000u);
  EXPECT_GT(events, 1000u);
}

TEST(Clock, ABallBouncesInUnixSecondsAsAtNoon) {
  const RunResult result = run_text(
      "[time]\nstart = 1.7e9\nend = 1700000010\n[[body]]\nname = \"ball\"\nposition = [0, 0, 10]\nvelocity = [1, 0, "
      "0]\nacceleration = [0, 0, -9.81]\n[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal "
      "= [0, 0, 1]\non_hit = \"bounce\"\nrestitution = 0.8\n");
  ASSERT_EQ(result.impacts.size(), 7u);
  double time = std::sqrt(2.0 * 10.0 / 9.81);
  for (int n = 0; n < 7; ++n) {
    EXPECT_NEAR(result.impacts[static_cast<std::size_t>(n)].elapsed, time, 1e-13 * (n + 1)) << n;
    time += 2.0 * std::pow(0.8, n + 1) * std::sqrt(2.0 * 10.0 / 9.81);
  }
}

}  // namespace
}  // namespace trajet
