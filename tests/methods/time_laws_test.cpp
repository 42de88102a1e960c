#include <gtest/gtest.h>

#include <cmath>

#include "problems/acceleration.hpp"
#include "problems/drag.hpp"
#include "problems/driven.hpp"
#include "trajet/ode/difference.hpp"
#include "trajet/ode/quadrature.hpp"
#include "trajet/ode/solve.hpp"

// The methods for laws of time alone: difference-linear, difference-quadratic, quadrature.

namespace trajet {
namespace {

using problems::ConstantAcceleration;
using problems::Driven;
using problems::LinearAcceleration;

double observed_order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

template <class Method, class Problem>
auto solve_in_steps(const Problem& problem, int steps) {
  SolveOptions options;
  options.step = (Problem::end_time() - Problem::start_time()) / steps;
  return solve<Method>(problem, Problem::start_time(), Problem::start(), Problem::end_time(), options);
}

// Erratum A1: the factor of t^3/6 is 1 + 1/(2 N^2); z(10) = 171 and 167.875 in the course's example. All numbers on the
// way are short binary fractions or thirds: rounding is a few units in the last place of 171.
TEST(DifferenceLinear, GivesTheFactorOfErratumA1) {
  EXPECT_NEAR(solve_in_steps<DifferenceLinear>(LinearAcceleration(), 5).end()[5], 171.0, 1e-13);
  EXPECT_NEAR(solve_in_steps<DifferenceLinear>(LinearAcceleration(), 20).end()[5], 167.875, 1e-13);
  for (const int n : {1, 2, 3, 7, 50})
    EXPECT_NEAR(solve_in_steps<DifferenceLinear>(LinearAcceleration(), n).end()[5] - 1.0,
                1000.0 / 6.0 * (1.0 + 1.0 / (2.0 * n * n)), 2e-13);
}

TEST(DifferenceLinear, TakesUnequalSteps) {
  SolveOptions options;
  options.nodes = {1.0, 3.0, 6.0, 10.0};
  const auto trajectory =
      solve<DifferenceLinear>(LinearAcceleration(), 0.0, LinearAcceleration::start(), 10.0, options);
  EXPECT_EQ(trajectory.end()[5], 176.0);
}

TEST(DifferenceQuadratic, IsExactForLinearAccelerations) {
  SolveOptions unequal;
  unequal.nodes = {1.0, 3.0, 6.0, 10.0};
  for (const int n : {1, 5, 20})
    EXPECT_LT(
        (solve_in_steps<DifferenceQuadratic>(LinearAcceleration(), n).end() - LinearAcceleration::exact(10.0)).norm(),
        1e-12);
  const auto trajectory =
      solve<DifferenceQuadratic>(LinearAcceleration(), 0.0, LinearAcceleration::start(), 10.0, unequal);
  EXPECT_LT((trajectory.end() - LinearAcceleration::exact(10.0)).norm(), 1e-12);
  for (const auto& segment : trajectory.segments) {
    const double t = segment.t0() + 0.3 * segment.duration();
    EXPECT_LT((segment.state(t) - LinearAcceleration::exact(t)).norm(), 1e-12);
  }
}

TEST(Difference, BothFormulasAreExactForConstantAccelerations) {
  EXPECT_LT(
      (solve_in_steps<DifferenceLinear>(ConstantAcceleration(), 7).end() - ConstantAcceleration::exact(10.0)).norm(),
      1e-13);
  EXPECT_LT(
      (solve_in_steps<DifferenceQuadratic>(ConstantAcceleration(), 7).end() - ConstantAcceleration::exact(10.0)).norm(),
      1e-13);
}

// dr/dt = v needs no evaluation: one at the start and one a step, as the course counts; one a Segment for its bound.
TEST(Difference, CostsOneEvaluationAStep) {
  EXPECT_EQ(solve_in_steps<DifferenceQuadratic>(Driven(), 10).statistics.law_evaluations, 1 + 10 + 10);
}

template <class Method>
class Difference : public testing::Test {};
using DifferenceMethods = testing::Types<DifferenceLinear, DifferenceQuadratic>;
TYPED_TEST_SUITE(Difference, DifferenceMethods);

TYPED_TEST(Difference, ErrorsAreOfOrderTwo) {
  const auto end_error = [](int steps) {
    return (solve_in_steps<TypeParam>(Driven(), steps).end() - Driven::exact(10.0)).eval();
  };
  for (const int steps : {200, 400}) {
    const auto coarse = end_error(steps), fine = end_error(2 * steps);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(observed_order(coarse[i], fine[i]), 2.0, 0.1) << steps;
  }
}

template <class Method>
Segment<2> one_step(double t0, double h) {
  SolveOptions options;
  options.step = h;
  return solve<Method>(Driven(), t0, Driven::exact(t0), t0 + h, options).segments.front();
}

TYPED_TEST(Difference, SegmentsAreOfTheirOrderAndWithinTheirBounds) {
  const double t0 = 0.5;
  // the velocity is a parabola; so is the first formula's position, the second one's is a cubic
  const double powers[2] = {3.0, std::is_same_v<TypeParam, DifferenceLinear> ? 3.0 : 4.0};
  for (const double part : {0.2, 0.7, 1.0}) {
    const auto coarse = one_step<TypeParam>(t0, 0.02), fine = one_step<TypeParam>(t0, 0.01);
    for (int i = 0; i < 2; ++i) {
      const double coarse_error = coarse.value(i, t0 + part * 0.02) - Driven::exact(t0 + part * 0.02)[i];
      const double fine_error = fine.value(i, t0 + part * 0.01) - Driven::exact(t0 + part * 0.01)[i];
      EXPECT_NEAR(observed_order(coarse_error, fine_error), powers[i], 0.1) << part;
      // the bound is the leading term of the largest error within the step: the next one is smaller by h
      EXPECT_LE(std::abs(coarse_error), coarse.error_bound()[i] * 1.02) << part;
      EXPECT_NEAR(observed_order(coarse.error_bound()[i], fine.error_bound()[i]), powers[i], 0.1);
    }
  }
}

// F26: the scheme needs a(t_n), which nobody knows before v(t_n).
TEST(LawsOfTime, OthersAreRefused) {
  SolveOptions options;
  options.step = 0.1;
  const auto start = problems::Drag::start();
  EXPECT_THROW(solve<DifferenceLinear>(problems::Drag(), 0.0, start, 1.0, options), std::invalid_argument);
  EXPECT_THROW(solve<Quadrature>(problems::Drag(), 0.0, start, 1.0, options), std::invalid_argument);
}

/// An energy that depends on the velocity, a velocity that depends on time: known beforehand too. v = 3 t^2,
/// e = 9 t^5 / 5 of de/dt = v^2, and a position that drifts, dx/dt = v + t.
struct Levelled {
  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector& q, Rate& dq) const {
    dq[0] = q[1] * q[1];
    dq[1] = 6.0 * t;
    dq[2] = q[1] + t;
  }
  static Eigen::Vector3d exact(double t) { return {1.8 * std::pow(t, 5), 3 * t * t, t * t * t + t * t / 2}; }
};

TEST(LawsOfTime, RatesMayUseWhatIsKnownAlready) {
  SolveOptions options;
  options.rtol = options.atol = 1e-12;
  const auto exact = solve<Quadrature>(Levelled(), 0.0, Levelled::exact(0.0), 2.0, options);
  EXPECT_LT((exact.end() - Levelled::exact(2.0)).cwiseAbs().maxCoeff(), 1e-12);
  const auto error = [](int steps) {
    SolveOptions given;
    given.step = 2.0 / steps;
    const auto trajectory = solve<DifferenceQuadratic>(Levelled(), 0.0, Levelled::exact(0.0), 2.0, given);
    EXPECT_LT(trajectory.end()[2] - Levelled::exact(2.0)[2], 1e-12);
    return trajectory.end()[0] - Levelled::exact(2.0)[0];
  };
  EXPECT_NEAR(observed_order(error(10), error(20)), 4.0, 0.1);  // Simpson's rule
}

TEST(Quadrature, ErrorsStayBelowTheToleranceWithinTheSegmentsToo) {
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
    SolveOptions options;
    options.rtol = options.atol = tolerance;
    // a resonance of width 0.05 at t = 3, whose integral is an arc tangent
    const auto law = [](const auto& t, const auto& q, auto& dq) {
      dq[0] = 1.0 / (1.0 + (t - 3.0) * (t - 3.0) * 400.0);
      dq[1] = q[0];
    };
    const auto v = [](double t) { return (std::atan(20.0 * (t - 3.0)) + std::atan(60.0)) / 20.0; };
    const auto trajectory = solve<Quadrature>(law, 0.0, Eigen::Vector2d(0.0, 0.0), 10.0, options);
    ASSERT_EQ(trajectory.status, IntegrationStatus::finished);
    for (const auto& segment : trajectory.segments) {
      for (const double part : {0.0, 0.1, 0.4, 0.75, 1.0}) {
        const double t = segment.t0() + part * segment.duration();
        // every step may add the tolerance; the estimate is far above the error, measured at most 0.1 of this
        EXPECT_LT(std::abs(segment.value(0, t) - v(t)), tolerance + 1e-15) << t;
      }
      EXPECT_LE(segment.error_bound()[0], 2.0 * tolerance + 1e-14);
    }
  }
}

// Rates of degree 9 have none of the two last terms by which the step is judged: one step, exact.
TEST(Quadrature, IsExactForPolynomials) {
  const auto law = [](const auto& t, const auto& q, auto& dq) {
    auto power = t;
    for (int k = 1; k < 8; ++k) power = power * t;
    dq[0] = 9.0 * power;
    dq[1] = 10.0 * q[0];
  };
  SolveOptions options;
  options.step = 2.0;                   // one step for the whole way
  options.rtol = options.atol = 1e-10;  // above the rounding of what judges the step
  const auto trajectory = solve<Quadrature>(law, -1.0, Eigen::Vector2d(-1.0, 1.0), 1.0, options);
  ASSERT_EQ(trajectory.segments.size(), 1u);
  for (const double t : {-0.9, -0.5, 0.1, 0.6, 1.0}) {
    // about t = -1, over a step of 2, the terms of the polynomial reach 8000 with alternating signs: rounding of 1e-12
    EXPECT_NEAR(trajectory.state(t)[0], std::pow(t, 9), 2e-11) << t;
    EXPECT_NEAR(trajectory.state(t)[1], std::pow(t, 10), 2e-11) << t;
  }
}

TEST(Quadrature, AConstantAccelerationGivesAParabola) {
  SolveOptions options;
  options.step = 10.0;
  const auto trajectory = solve<Quadrature>(ConstantAcceleration(), 0.0, ConstantAcceleration::start(), 10.0, options);
  ASSERT_EQ(trajectory.segments.size(), 1u);
  EXPECT_EQ(trajectory.segments[0].coefficients().rightCols(10).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_LT((trajectory.end() - ConstantAcceleration::exact(10.0)).norm(), 1e-13);
}

TEST(Quadrature, FindsItsWayOverAJump) {
  // the acceleration jumps from 0 to 1 at t = pi: v = t - pi behind it
  const double jump = std::acos(-1.0);
  const auto law = [jump](const auto& t, const auto&, auto& dq) {
    dq[0] = where(less(t, jump + 0.0 * t), 0.0 * t, 1.0 + 0.0 * t);
  };
  SolveOptions options;
  options.rtol = options.atol = 1e-10;
  const auto trajectory = solve<Quadrature>(law, 0.0, Eigen::Matrix<double, 1, 1>(0.0), 10.0, options);
  EXPECT_EQ(trajectory.status, IntegrationStatus::finished);
  EXPECT_NEAR(trajectory.end()[0], 10.0 - jump, 1e-9);
  EXPECT_LT(trajectory.statistics.steps, 200);
}

TEST(Quadrature, ASingularityEndsItWhereItIs) {
  const auto law = [](const auto& t, const auto&, auto& dq) { dq[0] = 1.0 / (t - 2.0); };
  const auto trajectory = solve<Quadrature>(law, 0.0, Eigen::Matrix<double, 1, 1>(0.0), 10.0, SolveOptions{});
  EXPECT_NE(trajectory.status, IntegrationStatus::finished);
  EXPECT_NEAR(trajectory.end_time(), 2.0, 1e-6);
}

TEST(Quadrature, GoesBackward) {
  const auto trajectory = solve<Quadrature>(Driven(), 10.0, Driven::exact(10.0), 0.0, SolveOptions{});
  EXPECT_LT((trajectory.end() - Driven::start()).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace trajet
