#include "trajet/ode/series_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "problems/acceleration.hpp"
#include "problems/coupled.hpp"
#include "trajet/ode/solve.hpp"

namespace trajet {
namespace {

using problems::Coupled;

double observed_order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

SolveOptions options(int order, double step) {
  SolveOptions options;
  options.order = order;
  options.step = step;
  return options;
}

TEST(SeriesSteps, ErrorsAreOfTheOrderAskedFor) {
  const auto end_error = [](int order, int steps) {
    const double t1 = Coupled::end_time();
    return (solve<SeriesSteps>(Coupled(), Coupled::start_time(), Coupled::start(), t1, options(order, 1.75 / steps))
                .end() -
            Coupled::exact(t1))
        .eval();
  };
  for (const int order : {1, 2, 3, 4, 6}) {
    const int steps = order < 6 ? 200 : 100;  // rounding is far below the errors; measured deviations: up to 0.1
    const auto coarse = end_error(order, steps), fine = end_error(order, 2 * steps);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(observed_order(coarse[i], fine[i]), order, 0.2) << order;
  }
  EXPECT_EQ(end_error(0, 100), end_error(SeriesStepper<LawExpansion<Coupled, 2>>::kDefaultOrder, 100));
}

TEST(SeriesSteps, SegmentsAreOfTheOrderEverywhereAndWithinTheirBounds) {
  for (const int order : {2, 4}) {
    const double h = order == 2 ? 1e-3 : 0.02;
    for (const double part : {0.5, 1.0}) {
      Eigen::Vector2d errors[2], bounds[2];
      for (int half = 0; half < 2; ++half) {
        const double step = half == 0 ? h : h / 2;
        const auto segment =
            solve<SeriesSteps>(Coupled(), 1.0, Coupled::exact(1.0), 1.0 + step, options(order, step)).segments.front();
        EXPECT_EQ(segment.degree(), order);
        errors[half] = segment.state(1.0 + part * step) - Coupled::exact(1.0 + part * step);
        bounds[half] = segment.error_bound();
      }
      for (int i = 0; i < 2; ++i) {
        EXPECT_NEAR(observed_order(errors[0][i], errors[1][i]), order + 1, 0.2) << order;
        // the first term left out; the one behind it is smaller by h, here with a factor of up to 50 (measured)
        EXPECT_LE(std::abs(errors[0][i]), (1.0 + 50.0 * h) * bounds[0][i]) << order;
      }
    }
  }
}

// The course's example of F10: one more derivative of a(t) than it has makes the scheme exact.
TEST(SeriesSteps, IsExactForPolynomialsOfItsOrder) {
  using problems::LinearAcceleration;
  const auto trajectory =
      solve<SeriesSteps>(LinearAcceleration(), 0.0, LinearAcceleration::start(), 10.0, options(3, 2.5));
  EXPECT_EQ(trajectory.segments.size(), 4u);
  EXPECT_LT((trajectory.end() - LinearAcceleration::exact(10.0)).norm(), 1e-12);
  EXPECT_EQ(trajectory.statistics.law_evaluations, 4);
}

// q' = |t - 0.35|: the step over the kink is cut there and goes on to its node.
TEST(SeriesSteps, AStepEndsWhereTheLawBranches) {
  const auto law = [](const auto& t, const auto&, auto& dq) {
    using std::abs;
    dq[0] = abs(t - 0.35);
  };
  const auto trajectory = solve<SeriesSteps>(law, 0.0, Eigen::Matrix<double, 1, 1>(0.0), 1.0, options(2, 0.1));
  ASSERT_EQ(trajectory.segments.size(), 11u);
  EXPECT_NEAR(trajectory.segments[3].t1(), 0.35, 1e-15);
  EXPECT_EQ(trajectory.segments[4].t1(), 0.4);
  EXPECT_NEAR(trajectory.end()[0], 0.5 * (0.35 * 0.35 + 0.65 * 0.65), 1e-15);
}

// The speed sqrt(v^2) has no series at v = 0, where a fall with drag begins: a step of rk4 leads away from rest.
TEST(SeriesSteps, LeavesASingularPoint) {
  const auto law = [](const auto& t, const auto& q, auto& dq) {
    using std::sqrt;
    dq[0] = 1.0 - 0.1 * sqrt(q[0] * q[0]) * q[0] + 0.0 * t;
  };
  const auto trajectory = solve<SeriesSteps>(law, 0.0, Eigen::Matrix<double, 1, 1>(0.0), 2.0, options(6, 0.02));
  ASSERT_EQ(trajectory.status, IntegrationStatus::finished);
  // v' = 1 - v^2/10: v = sqrt(10) tanh(t / sqrt(10))
  EXPECT_NEAR(trajectory.end()[0], std::sqrt(10.0) * std::tanh(2.0 / std::sqrt(10.0)), 1e-10);
}

TEST(SeriesSteps, RefusesOrdersThatNoTapeHolds) {
  EXPECT_THROW(solve<SeriesSteps>(Coupled(), 0.25, Coupled::start(), 1.0, options(1000, 0.1)), std::invalid_argument);
}

}  // namespace
}  // namespace trajet
