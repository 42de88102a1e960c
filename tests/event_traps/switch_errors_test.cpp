// What a run says of how far its final state may be off, where its law has switched on the way: an error before the
// border moves the time of the switch, and what the law has done since.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::number;
using test::run_text;
using test::Way;

std::vector<Way> ways() {
  return {test::controlled("dopri5", 1e-6),       test::controlled("bs32", 1e-6), test::controlled("dop853", 1e-5),
          test::controlled("rosenbrock23", 1e-5), test::fixed("rk4", 0.05),       test::fixed("heun", 0.01)};
}

struct Off {
  double error, bound;
  double ratio() const { return error / bound; }
};

/// How far position and velocity are off, and may be.
std::vector<Off> off(const RunResult& result, double x, double v) {
  const BodyState& final = test::final_of(result, "p");
  return {{std::abs(final.position.x() - x), final.position_error_bound.value()},
          {std::abs(final.velocity.x() - v), final.velocity_error_bound.value()}};
}

TEST(SwitchErrors, ABorderTurnsErrorsOfThePlaceIntoErrorsOfTheVelocity) {
  std::mt19937 random(6);
  std::uniform_real_distribution<> uniform(0.0, 1.0);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < 600; ++i) {
    // x'' = -k x up to the border, and then a push that is much stronger
    const double k = 0.5 + 1.5 * uniform(random), w = std::sqrt(k), border = (0.5 + 0.4 * uniform(random)) / w;
    const double push = 20.0 + 40.0 * uniform(random);
    const double crossing = std::asin(border * w) / w, speed = std::cos(w * crossing), end = crossing + 1.0;
    const Way way = ways()[i % ways().size()];
    const std::string text = "[time]\nend = " + number(end) + "\n[method]\n" + way.lines +
                             "[[body]]\nname = \"p\"\nvelocity = [1, 0, 0]\nacceleration = [\"where(x < " +
                             number(border) + ", -" + number(k) + "*x, " + number(push) + ")\", 0, 0]\n";
    SCOPED_TRACE(text);
    const RunResult result = run_text(text);
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    for (const Off& each : off(result, border + speed + 0.5 * push, speed + push)) {
      // that of dop853 is an estimate of its end, and is seen to fall short between
      ASSERT_LE(each.error, (i % ways().size() == 2 ? 2.0 : 1.0) * each.bound) << each.ratio();
      ratios.push_back(each.ratio());
    }
  }
  std::sort(ratios.begin(), ratios.end());
  // not much wider than it has to be
  EXPECT_GT(ratios.back(), 0.3);
  EXPECT_GT(ratios[ratios.size() / 2], 0.01);
}

TEST(SwitchErrors, WhatSticksHasNoErrorOfTheVelocity) {
  for (const Way& way : ways()) {
    // x'' = -x - 2 sign(v) from x = 0, v = 1: about -2 it swings to its stop, and stays
    const RunResult result =
        run_text("[time]\nend = 3\n[method]\n" + way.lines +
                 "[[body]]\nname = \"p\"\nvelocity = [1, 0, 0]\nacceleration = [\"-x - 2*sign(vx)\", 0, 0]\n");
    ASSERT_EQ(result.status, RunStatus::finished) << way.name << result.failure;
    const std::vector<Off> found = off(result, std::sqrt(5.0) - 2.0, 0.0);
    EXPECT_LE(found[0].error, found[0].bound) << way.name;
    EXPECT_LE(found[0].bound, 1e3 * found[0].error + 1e-12) << way.name;
    EXPECT_LE(found[1].error, 1e-15) << way.name;
    EXPECT_LE(found[1].bound, 1e-12) << way.name;
  }
}

}  // namespace
}  // namespace trajet
