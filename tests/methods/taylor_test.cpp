#include "trajet/ode/taylor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "problems/drag.hpp"
#include "problems/free_kick.hpp"
#include "trajet/math/series.hpp"
#include "trajet/ode/solve.hpp"

namespace trajet {
namespace {

using Vector1 = Eigen::Matrix<double, 1, 1>;
using Vector2 = Eigen::Matrix<double, 2, 1>;

/// All functions that a law can call, on numbers that stay inside their domains.
struct ManyFunctions {
  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector& q, Rate& dq) const {
    using std::sin, std::cos, std::exp, std::sqrt, std::tan, std::tanh, std::asin, std::acos, std::atan, std::sinh, std::cosh,
        std::log, std::log10, std::cbrt, std::pow, std::atan2, std::abs, std::min, std::max;
    const auto x = 0.5 + 0.1 * sin(q[0]);
    dq[0] = cos(t) * exp(-q[0]) + sqrt(1.0 + q[1] * q[1]) / (2.0 + q[0] * q[0]) - tan(0.3 * x) + tanh(q[1]);
    dq[1] = asin(x) + acos(x) * atan(q[0]) - sinh(0.2 * q[1]) + cosh(x) * log(x) + log10(2.0 + x) + cbrt(x) + pow(x, 2.5) +
            pow(x, 3.0) + atan2(x, 1.0 + q[1] * q[1]) + abs(x) - max(x, 0.1) + min(x, q[1] + 10.0) - 3.0 / (1.0 + x) +
            (2.0 - x) - x / 3.0;
  }
};

/// Coefficients by the slow way: the law on whole series, one more coefficient known after each pass.
template <class Law, int Order>
Eigen::Matrix<double, 2, Order + 1> expand_by_series(double t, const Vector2& q0) {
  using S = Series<double, Order>;
  Eigen::Matrix<S, 2, 1> q{S(q0[0]), S(q0[1])}, dq;
  for (int pass = 0; pass < Order; ++pass) {
    Law{}(S::variable(t), q, dq);
    for (int i = 0; i < 2; ++i) q[i][pass + 1] = dq[i][pass] / (pass + 1);
  }
  Eigen::Matrix<double, 2, Order + 1> coefficients;
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k <= Order; ++k) coefficients(i, k) = q[i][k];
  return coefficients;
}

TEST(LawExpansion, AgreesWithSeriesArithmetic) {
  constexpr int kOrder = 10;
  const Vector2 q(0.3, -0.4);
  const auto expected = expand_by_series<ManyFunctions, kOrder>(0.2, q);
  LawExpansion<ManyFunctions, 2> expansion({}, 2);
  Eigen::Matrix<double, 2, kOrder + 1> coefficients;
  for (int repeat = 0; repeat < 2; ++repeat) {  // the second time on a tape that has grown
    expansion.expand(0.2, q, kOrder, coefficients.data());
    for (int k = 0; k <= kOrder; ++k)
      for (int i = 0; i < 2; ++i)
        // the two ways round differently; measured below 1e-14 of the size of the coefficients
        EXPECT_NEAR(coefficients(i, k), expected(i, k), 1e-13 * std::max(1.0, std::abs(expected(i, k)))) << i << " " << k;
  }
}

TEST(Taylor, DragIsExactToTheTolerance) {
  using problems::Drag;
  const auto trajectory = solve(Drag{}, 0.0, Drag::start(), 10.0, {{.rtol = 1e-13, .atol = 1e-13}});
  ASSERT_EQ(trajectory.status, IntegrationStatus::finished);
  for (const auto& segment : trajectory.segments)
    EXPECT_LT((segment.state(segment.t1()) - Drag::exact(segment.t1())).lpNorm<Eigen::Infinity>(), 2e-13) << segment.t1();
}

/// The error follows the tolerance over its whole range; the law's own amplification is below 20 on this problem (measured).
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
  // ceil(1 - ln(tolerance) / 2)
  EXPECT_EQ(taylor_order(1e-4), 6);
  EXPECT_EQ(taylor_order(1e-12), 15);
  EXPECT_EQ(taylor_order(1e-16), 20);
  EXPECT_EQ(taylor_order(0.0), 20);  // no better than rounding
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
    dq[0] = t9 * t9 * t9 * t9;  // t^36: a polynomial of a higher degree than the series, whose first coefficients all vanish
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

}  // namespace
}  // namespace trajet
