#include <gtest/gtest.h>

#include <cmath>

#include "methods/steppers.hpp"
#include "problems/coupled.hpp"
#include "problems/kepler.hpp"

namespace trajet {
namespace {

using problems::Coupled;
using State = Coupled::State;
using Fixed = FixedSteps<Dop853Tableau>;

double observed_order(double error, double error_of_half_the_step) { return std::log2(error / error_of_half_the_step); }

auto solve_fixed(double t0, double t1, double step) {
  SolveOptions options;
  options.step = step;
  return solve<Fixed>(Coupled(), t0, Coupled::exact(t0), t1, options);
}

// Steps of 1/8 and 1/16 leave errors of 1e-10 and 1e-13: with longer ones the leading term does not rule yet, with
// shorter ones rounding does. The orders measured lie between 7.86 and 8.20.
void expect_order_eight(double t0, double t1) {
  const State coarse = solve_fixed(t0, t1, 1.0 / 8).end() - Coupled::exact(t1);
  const State fine = solve_fixed(t0, t1, 1.0 / 16).end() - Coupled::exact(t1);
  for (int i = 0; i < Coupled::kDimension; ++i) EXPECT_NEAR(observed_order(coarse[i], fine[i]), 8.0, 0.3) << i;
}

TEST(Dop853, IsOfOrderEightInBothDirections) {
  expect_order_eight(0.5, 1.0);
  expect_order_eight(1.0, 0.5);
}

/// The Segment of one step from the exact solution at 1.
Segment<2> first_segment(double h) { return solve_fixed(1.0, 1.0 + h, h).segments.front(); }

// The local order measured is 7.67 to 8.32.
TEST(Dop853, DenseOutputIsOfOrderSeven) {
  const double h = 0.1;
  for (const double part : {0.15, 0.35, 0.55}) {
    State error[2];
    for (int half = 0; half < 2; ++half) {
      const double step = half == 0 ? h : h / 2;
      error[half] = first_segment(step).state(1.0 + part * step) - Coupled::exact(1.0 + part * step);
    }
    for (int i = 0; i < Coupled::kDimension; ++i)
      EXPECT_NEAR(observed_order(error[0][i], error[1][i]), 8.0, 0.4) << "component " << i << " at " << part;
  }
}

TEST(Dop853, DenseOutputMeetsStateAndRateAtBothEnds) {
  const double h = 0.1;
  const auto trajectory = solve_fixed(1.0, 1.0 + h, h);
  const Segment<2>& segment = trajectory.segments.front();
  State start_rate, end_rate;
  Coupled()(1.0, Coupled::exact(1.0), start_rate);
  Coupled()(1.0 + h, trajectory.end(), end_rate);
  for (int i = 0; i < Coupled::kDimension; ++i) {
    // Rounding of eight coefficients of the size of the rate, a few units.
    EXPECT_NEAR(segment.derivative(i, 1.0), start_rate[i], 1e-14);
    EXPECT_NEAR(segment.derivative(i, 1.0 + h), end_rate[i], 3e-13);  // degree 7 and 1/h: 70 times that
  }
}

// The estimate of one step falls as h^8 and lies above the error, which falls as h^9.
TEST(Dop853, ErrorBoundFallsWithTheEighthPowerAndHolds) {
  const double h = 0.1;
  const double bound = first_segment(h).error_bound().maxCoeff();
  const double bound_half = first_segment(h / 2).error_bound().maxCoeff();
  EXPECT_NEAR(observed_order(bound, bound_half), error_power<Dop853Tableau>(), 0.5);
  const State error = (first_segment(h).state(1.0 + h) - Coupled::exact(1.0 + h)).cwiseAbs();
  for (int i = 0; i < Coupled::kDimension; ++i) EXPECT_LE(error[i], first_segment(h).error_bound()[i]);
}

// An error of the semi-major axis grows with the square of time: over ten periods 5000 to 11000 tolerances are
// measured.
TEST(Dop853, KeepsItsToleranceOnAnOrbit) {
  double previous = 0.0;
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
    SolveOptions options;
    options.rtol = options.atol = tolerance;
    const auto orbit = solve_problem<Dop853>(problems::Kepler(), options);
    const double error = (orbit.end() - problems::Kepler::start()).cwiseAbs().maxCoeff();
    EXPECT_LT(error, 2e4 * tolerance) << "tolerance " << tolerance;
    if (previous > 0.0) {
      EXPECT_LT(error, 1e-2 * previous);
    }
    previous = error;
  }
}

}  // namespace
}  // namespace trajet
