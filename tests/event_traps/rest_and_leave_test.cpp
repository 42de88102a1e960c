// A body that lies on something: from the start on, until the force points away, whatever the method and the place.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "scene_run.hpp"

namespace trajet::test {
namespace {

constexpr double kGravity = 9.80665;

std::vector<std::string> kinds_of(const RunResult& result) {
  std::vector<std::string> kinds;
  for (const Impact& impact : result.impacts)
    kinds.push_back(impact.kind == ImpactKind::hit     ? "hit"
                    : impact.kind == ImpactKind::rest  ? "rest"
                    : impact.kind == ImpactKind::leave ? "leave"
                                                       : "graze");
  return kinds;
}

std::string on_the_ground(const std::string& time_and_method, double height, const std::string& acceleration,
                          const std::string& restitution) {
  return time_and_method + "[[body]]\nname = \"b\"\nposition = [0.3, 0, " + number(height) + "]\nacceleration = \"" +
         acceleration + "\"\n[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, " + number(height) +
         "]\nnormal = [0, 0, 1]\non_hit = \"bounce\"\n" + restitution;
}

TEST(RestAndLeave, WhatLiesThereRestsFromTheStart) {
  for (const std::string restitution : {"", "restitution = 0.7\n", "restitution = 0\n"})
    for (const double height : {0.0, 1.7, -0.3, 1234.5})
      for (const std::string method : {"taylor", "dopri5", "dop853", "rodas5p", "bdf"}) {
        const RunResult result = run_text(on_the_ground("[time]\nend = 1\n[method]\nname = \"" + method + "\"\n",
                                                        height, "[0, 0, -9.80665]", restitution));
        ASSERT_EQ(result.status, RunStatus::finished) << method << height << result.failure;
        EXPECT_EQ(kinds_of(result), std::vector<std::string>{"rest"}) << method << " at " << height;
        EXPECT_NEAR(result.impacts.front().time, 0.0, 2e-6);
        EXPECT_NEAR(final_of(result, "b").position.z(), height, 1e-9);
      }
}

/// A force that grows smoothly past the weight.
struct Lift {
  std::string text;
  std::function<double(double)> force;  // per mass
};

std::vector<Lift> lifts() {
  std::mt19937 random(7);
  const auto scaled = [&](double low, double high) {
    return low * std::pow(high / low, static_cast<double>(random()) / 4294967296.0);
  };
  std::vector<Lift> all;
  for (int k = 0; k < 20; ++k) {
    const double a = scaled(10.5, 1e4);
    all.push_back({number(a) + "*sin(t)", [a](double t) { return a * std::sin(t); }});
    const double b = scaled(10.0, 1e3);
    all.push_back({number(b) + "*t^2", [b](double t) { return b * t * t; }});
    const double c = scaled(5.0, 1e3);
    all.push_back({number(c) + "*(exp(t) - 1)", [c](double t) { return c * std::expm1(t); }});
    const double d = scaled(12.0, 1e3);
    all.push_back({number(d) + "*t*exp(-(t - 1)^2)", [d](double t) { return d * t * std::exp(-(t - 1) * (t - 1)); }});
  }
  return all;
}

/// The first time at which the force exceeds the weight, by bisection.
double take_off(const Lift& lift) {
  double low = 0.0, high = 1.6;
  for (double t = 0.0; t < high; t += 1e-4)
    if (lift.force(t) > kGravity) {
      high = t;
      break;
    }
  for (int step = 0; step < 100; ++step) {
    const double middle = 0.5 * (low + high);
    (lift.force(middle) > kGravity ? high : low) = middle;
  }
  return high;
}

TEST(RestAndLeave, EndsWhereTheForcePointsAway) {
  int runs = 0;
  for (const Lift& lift : lifts()) {
    const double expected = take_off(lift);
    for (const double height : {0.0, 1.7, 1234.5})
      for (const std::string method :
           {"taylor", "dopri5", "dop853", "rk4\"\nstep = \"10 ms", "rodas5p", "taylor-extended"}) {
        const RunResult result = run_text(
            on_the_ground("[time]\nend = " + number(expected + 0.3) + "\n[method]\nname = \"" + method + "\"\n", height,
                          "[0, 0, -9.80665 + " + lift.text + "]", "restitution = 0\n"));
        ++runs;
        ASSERT_EQ(result.status, RunStatus::finished)
            << method << " " << lift.text << " at " << height << ": " << result.failure;
        ASSERT_EQ(kinds_of(result), (std::vector<std::string>{"rest", "leave"}))
            << method << " " << lift.text << " at " << height;
        // the law is evaluated at rounded times and its terms cancel
        EXPECT_NEAR(result.impacts[1].time, expected, 1e-12 + 1e-12 * expected) << method << " " << lift.text;
        EXPECT_GT(result.impacts[1].time_error_bound, 0.0);
        EXPECT_LT(result.impacts[1].time_error_bound, 1e-11);
        EXPECT_GT(final_of(result, "b").position.z(), height);
      }
  }
  EXPECT_GE(runs, 1000);
}

/// The scene of the shaken table: it stays while the table never falls faster than gravity, else it is thrown.
TEST(RestAndLeave, ABeadOnAShakenTable) {
  const auto run_with = [](double amplitude) {
    const std::string omega = "(2*pi*10)";
    return run_text(on_the_ground("[time]\nend = 5\n", 0.0,
                                  "[0, 0, -9.81 + " + number(amplitude) + "*" + omega + "^2*sin(" + omega + "*t)]",
                                  "restitution = 0.5\n"));
  };
  const RunResult stays = run_with(0.0024);  // 0.0024 (2 pi 10)^2 = 9.47 m/s^2
  EXPECT_EQ(kinds_of(stays), std::vector<std::string>{"rest"});
  const RunResult thrown = run_with(0.005);
  ASSERT_EQ(thrown.status, RunStatus::finished) << thrown.failure;
  ASSERT_GE(thrown.impacts.size(), 20u);
  EXPECT_EQ(thrown.impacts[0].kind, ImpactKind::rest);
  EXPECT_EQ(thrown.impacts[1].kind, ImpactKind::leave);
  // sin(omega t) = g / (A omega^2)
  const double omega = 20.0 * std::acos(-1.0);
  EXPECT_NEAR(thrown.impacts[1].time, std::asin(9.81 / (0.005 * omega * omega)) / omega, 1e-13);
  EXPECT_GE(final_of(thrown, "b").position.z(), -1e-12);
}

/// It waits for its thrust, flies, lands and lies again.
TEST(RestAndLeave, ARocketWaitsOnItsPad) {
  const RunResult result = run_text(on_the_ground(
      "[time]\nend = 30\n", 0.0, "[0, 0, -9.80665 + where(t > 8 and t < 9, 60*(t - 8)*(9 - t), 0)] - 0.01*norm(v)*v",
      "restitution = 0\n"));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  EXPECT_EQ(kinds_of(result), (std::vector<std::string>{"rest", "leave", "hit", "rest"}));
  // 60 x (1 - x) = g
  EXPECT_NEAR(result.impacts[1].time, 8.0 + 0.5 * (1.0 - std::sqrt(1.0 - 4.0 * kGravity / 60.0)), 1e-12);
  EXPECT_NEAR(final_of(result, "b").position.z(), 0.0, 1e-12);
}

}  // namespace
}  // namespace trajet::test
