#include "trajet/ode/taylor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "problems/drag.hpp"
#include "problems/free_kick.hpp"
#include "trajet/ode/solve.hpp"

namespace trajet {
namespace {

using Vector1 = Eigen::Matrix<double, 1, 1>;
using Vector2 = Eigen::Matrix<double, 2, 1>;

TEST(Taylor, DragIsExactToTheTolerance) {
  using problems::Drag;
  const auto trajectory = solve(Drag{}, 0.0, Drag::start(), 10.0, {{.rtol = 1e-13, .atol = 1e-13}});
  ASSERT_EQ(trajectory.status, IntegrationStatus::finished);
  for (const auto& segment : trajectory.segments)
    EXPECT_LT((segment.state(segment.t1()) - Drag::exact(segment.t1())).lpNorm<Eigen::Infinity>(), 2e-13)
        << segment.t1();
}

/// The error follows the tolerance over its whole range; the law's own amplification is below 20 on this problem
/// (measured).
TEST(Taylor, ErrorIsAtTheTolerance) {
  using problems::FreeKick;
  for (double tolerance = 1e-3; tolerance > 1e-14; tolerance *= 0.1) {
    const auto trajectory = solve(FreeKick{}, 0.0, FreeKick::start(), 2.0, {{.rtol = tolerance, .atol = tolerance}});
    const auto& last = trajectory.segments.back();
    const double error = (last.state(2.0) - FreeKick::reference_end()).lpNorm<Eigen::Infinity>();
    EXPECT_LT(error, 20.0 * tolerance + 2e-14) << tolerance;
  }
}

TEST(Taylor, DefaultOrderGrowsWithTheTolerance) {
  // ceil(3 - 0.6 ln(tolerance))
  EXPECT_EQ(taylor_order(1e-4), 9);
  EXPECT_EQ(taylor_order(1e-12), 20);
  EXPECT_EQ(taylor_order(1e-15), 24);
  EXPECT_EQ(taylor_order(0.0), 26);  // no better than rounding
}

struct Ballistic {
  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = q[1];
    dq[1] = -9.8;
  }
};

TEST(Taylor, PolynomialSolutionsAreOneExactSegment) {
  const auto trajectory = solve(Ballistic{}, 0.0, Vector2(1.5, 7.0), 1000.0);
  ASSERT_EQ(trajectory.segments.size(), 1u);
  EXPECT_EQ(trajectory.segments[0].degree(), 2);
  EXPECT_EQ(trajectory.segments[0].value(0, 1000.0), 1.5 + 1000.0 * (7.0 - 1000.0 * 4.9));
}

struct HighPower {
  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector&, Rate& dq) const {
    const auto t3 = t * t * t;
    const auto t9 = t3 * t3 * t3;
    dq[0] = t9 * t9 * t9 *
            t9;  // t^36: a polynomial of a higher degree than the series, whose first coefficients all vanish
  }
};

TEST(Taylor, VanishingFirstCoefficientsDoNotHideTheLaw) {
  const auto trajectory = solve(HighPower{}, 0.0, Vector1(0.0), 2.0);
  const double exact = std::pow(2.0, 37) / 37.0;
  EXPECT_NEAR(trajectory.segments.back().value(0, 2.0), exact, 1e-11 * exact);
}

struct Pulse {
  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector&, Rate& dq) const {
    using std::exp;
    const auto s = (t - 5.0) * 2.0;
    dq[0] = exp(-(s * s));
  }
};

TEST(Taylor, ADistantPulseIsSeen) {
  const auto trajectory = solve(Pulse{}, 0.0, Vector1(0.0), 30.0);
  // integral of exp(-4 (t - 5)^2) over all t, erfc(10) apart
  EXPECT_NEAR(trajectory.segments.back().value(0, 30.0), 0.5 * std::sqrt(std::numbers::pi), 1e-11);
}

struct Thrust {
  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector& q, Rate& dq) const {
    dq[0] = q[1];
    if (t < 1.0)
      dq[1] = 0.0 * q[0] + 3.0;
    else
      dq[1] = -q[0];
  }
};

/// The thrust ends in the middle of what would be one step.
TEST(Taylor, StepsEndWhereTheLawBranches) {
  const auto trajectory = solve(Thrust{}, 0.0, Vector2(0.0, 0.0), 3.0);
  // x(1) = 1.5, v(1) = 3, then an oscillator of unit frequency for 2 s
  const double x = 1.5 * std::cos(2.0) + 3.0 * std::sin(2.0);
  EXPECT_NEAR(trajectory.segments.back().value(0, 3.0), x, 1e-11);
}

struct VerticalDrag {
  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    using std::abs, std::sqrt;
    dq[0] = q[1];
    dq[1] = -9.8 - 0.1 * sqrt(q[1] * q[1]) * q[1];
  }
};

/// Straight up against quadratic drag and down again. At the apex the speed vanishes, where its power series ends.
TEST(Taylor, AVerticalThrowComesDownAgain) {
  const double g = 9.8, k = 0.1, v0 = 20.0;
  const double terminal = std::sqrt(g / k), rate = std::sqrt(g * k);
  const double apex_time = std::atan(v0 / terminal) / rate;
  const double apex = -std::log(std::cos(rate * apex_time)) / k;
  const double t = apex_time + 1.3;
  const double height = apex - std::log(std::cosh(rate * 1.3)) / k;
  const auto trajectory = solve(VerticalDrag{}, 0.0, Vector2(0.0, v0), t);
  ASSERT_EQ(trajectory.status, IntegrationStatus::finished);
  EXPECT_NEAR(trajectory.segments.back().value(0, t), height, 1e-10);
  EXPECT_NEAR(trajectory.segments.back().value(1, t), -terminal * std::tanh(rate * 1.3), 1e-10);
}

TEST(Taylor, RunsBackward) {
  using problems::FreeKick;
  const auto trajectory = solve(FreeKick{}, 2.0, FreeKick::reference_end(), 0.0);
  // back through the drag errors grow: by e^(integral of 3 K |v| / 2 ...) < 30
  EXPECT_LT((trajectory.segments.back().state(0.0) - FreeKick::start()).lpNorm<Eigen::Infinity>(), 1e-10);
}

struct BlowUp {
  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = q[0] * q[0];
  }
};

/// q = 1 / (1 - t): the end of the solution is reported, not stepped over.
TEST(Taylor, AnInfiniteSolutionEnds) {
  const auto trajectory = solve(BlowUp{}, 0.0, Vector1(1.0), 2.0);
  EXPECT_NE(trajectory.status, IntegrationStatus::finished);
  EXPECT_LT(trajectory.segments.back().t1(), 1.0 + 1e-9);
  EXPECT_GT(trajectory.segments.back().t1(), 0.99);
}

// A small motion about a large value: each of the 10,000 steps rounds the state by half of 1.1e-13. Added up at random
// that would be 5e-12 (measured without the remainder: 3e-12); carried along, it stays one rounding.
TEST(Taylor, RoundingOfTheStateDoesNotAddUp) {
  const auto law = [](const auto& t, const auto&, auto& dq) {
    using std::cos;
    dq[0] = cos(t);
  };
  using State = Eigen::Matrix<double, 1, 1>;
  auto stepper = Taylor::make_stepper<1>(law, 1, {.rtol = 1e-15, .atol = 1e-18});
  stepper.start(0.0, State(1000.0));
  for (int k = 1; k <= 10000; ++k) ASSERT_EQ(stepper.advance(1e-3 * k), StepStatus::ok);
  EXPECT_NEAR(stepper.state()[0], 1000.0 + std::sin(10.0), 2e-13);
}

}  // namespace
}  // namespace trajet
