#include "trajet/ode/rk4_doubling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "problems/coupled.hpp"
#include "problems/drag.hpp"
#include "trajet/ode/solve.hpp"

namespace trajet {
namespace {

using problems::Coupled;
using problems::Drag;

SolveOptions options(double accuracy, double interval) {
  SolveOptions options;
  options.rtol = accuracy;
  options.step = interval;
  return options;
}

struct DragRun {
  double largest_error = 0.0;  ///< of any component at the ends of the intervals of 1 s
  long evaluations = 0;
  std::vector<std::string> warnings;
};

DragRun run_drag(double accuracy) {
  auto stepper = Rk4Doubling::make_stepper<6>(Drag(), 6, options(accuracy, 1.0));
  DragRun run;
  integrate(stepper, 0.0, Drag::start(), 10.0, kDefaultMaxSteps, [&](const auto& s) {
    if (s.time() != std::round(s.time())) return;
    run.largest_error = std::max(run.largest_error, (s.state() - Drag::exact(s.time())).cwiseAbs().maxCoeff());
  });
  run.evaluations = stepper.statistics().law_evaluations;
  run.warnings = stepper.warnings();
  return run;
}

// The errata's own computation of the course's example, in another language: A18 and the counts of evaluations. The
// states, up to 4.4, are rounded at other places here: a few units in their last place.
TEST(Rk4Doubling, GivesThePublishedErrorsForThePublishedWork) {
  constexpr double kRounding = 4e-15;
  const DragRun loose = run_drag(1e-3), middle = run_drag(1e-6), tight = run_drag(1e-9);
  EXPECT_EQ(loose.evaluations, 136);
  EXPECT_NEAR(loose.largest_error, 7.14018282718735e-5, kRounding);
  EXPECT_EQ(middle.evaluations, 584);
  EXPECT_NEAR(middle.largest_error, 4.33428301292192e-8, kRounding);
  EXPECT_EQ(tight.evaluations, 2840);
  EXPECT_NEAR(tight.largest_error, 9.0234e-12, kRounding);
  EXPECT_TRUE(tight.warnings.empty());
}

// A18: the course drops the extrapolation where it does not converge, and errs by 5.2e-11 there.
TEST(Rk4Doubling, KeepsTheExtrapolationAtTheCapAndWarns) {
  const DragRun run = run_drag(1e-12);
  EXPECT_EQ(run.evaluations, 8152);
  EXPECT_LT(run.largest_error, 1e-12);  // 6.6e-13
  ASSERT_EQ(run.warnings.size(), 1u);
  EXPECT_NE(run.warnings[0].find("3 intervals, the first from t = 0 s"), std::string::npos) << run.warnings[0];
  EXPECT_NE(run.warnings[0].find("128 sub-steps"), std::string::npos);
}

// B9: the course compares 0/0 with the accuracy, in vain.
TEST(Rk4Doubling, ABodyAtRestConvergesAtOnce) {
  const auto law = [](double, const auto& q, auto& dq) {
    dq[0] = 0.0;
    dq[1] = q[0];
  };
  const auto trajectory = solve<Rk4Doubling>(law, 0.0, Eigen::Vector2d(0.0, 0.0), 3.0, options(1e-12, 1.0));
  EXPECT_EQ(trajectory.status, IntegrationStatus::finished);
  EXPECT_EQ(trajectory.statistics.law_evaluations, 3 * 4 * (1 + 2));
  EXPECT_TRUE(trajectory.warnings.empty());
  EXPECT_EQ(trajectory.end(), Eigen::Vector2d(0.0, 0.0));
}

// A14: c of the first marches of the first interval, eps = 1e-6: 0.0854 s with eps |q|, not the 0.0740 s of eps alone.
// The proposal goes as eps^(1/4), so that an accuracy which the first marches reach tells it.
TEST(Rk4Doubling, ProposesTheNextStepFromTheRelativeError) {
  const auto trajectory = solve<Rk4Doubling>(Drag(), 0.0, Drag::start(), 1.0, options(1.0, 1.0));
  ASSERT_EQ(trajectory.statistics.law_evaluations, 12);
  EXPECT_NEAR(trajectory.statistics.proposed_step * std::pow(1e-6, 0.25), 0.0854, 1e-4);
}

/// log2 of the ratio of two errors.
double observed_order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

// An accuracy that every pair of marches reaches leaves steps of half the interval, extrapolated: order 5.
constexpr double kAnything = 10.0;

TEST(Rk4Doubling, ErrorFallsWithTheFifthPowerOfTheInterval) {
  const auto end_error = [](int intervals) {
    const double t1 = Coupled::end_time();
    const SolveOptions some = options(kAnything, (t1 - Coupled::start_time()) / intervals);
    return (solve<Rk4Doubling>(Coupled(), Coupled::start_time(), Coupled::start(), t1, some).end() - Coupled::exact(t1))
        .eval();
  };
  for (const int intervals : {100, 200}) {
    const auto coarse = end_error(intervals), fine = end_error(2 * intervals);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(observed_order(coarse[i], fine[i]), 5.0, 0.2) << intervals;
  }
}

TEST(Rk4Doubling, SegmentsAreOfOrderFour) {
  const auto error_within = [](double part, double interval) {
    const double t0 = 1.0;
    const auto trajectory =
        solve<Rk4Doubling>(Coupled(), t0, Coupled::exact(t0), t0 + interval, options(kAnything, interval));
    const double t = t0 + part * interval;
    return (trajectory.segments.front().state(t) - Coupled::exact(t)).eval();
  };
  for (const double part : {0.15, 0.3, 0.8}) {
    const auto coarse = error_within(part, 0.02), fine = error_within(part, 0.01);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(observed_order(coarse[i], fine[i]), 5.0, 0.2) << part;
  }
}

// What a piece adds to the error stays below its bound, between its ends too.
TEST(Rk4Doubling, ErrorBoundsHold) {
  for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
    const auto trajectory = solve<Rk4Doubling>(Drag(), 0.0, Drag::start(), 10.0, options(accuracy, 1.0));
    double error_before = 0.0, sum_of_bounds = 0.0;
    for (const auto& segment : trajectory.segments) {
      sum_of_bounds += segment.error_bound().maxCoeff();
      for (const double part : {0.25, 0.5, 0.8, 1.0}) {
        const double t = segment.t0() + part * segment.duration();
        const double error = (segment.state(t) - Drag::exact(t)).cwiseAbs().maxCoeff();
        EXPECT_LE(error, sum_of_bounds) << accuracy << " at " << t;
        error_before = error;
      }
    }
    EXPECT_GT(error_before, 0.0);
  }
}

TEST(Rk4Doubling, GoesBackward) {
  const auto back = solve<Rk4Doubling>(Drag(), 10.0, Drag::exact(10.0), 0.0, options(1e-9, 1.0));
  EXPECT_EQ(back.end_time(), 0.0);
  // errors of the end grow on the way back, by (1 + t)^2 for the fastest component
  EXPECT_LT((back.end() - Drag::start()).cwiseAbs().maxCoeff(), 121 * 1e-9);
}

TEST(Rk4Doubling, ANearerLimitBeginsANewInterval) {
  auto stepper = Rk4Doubling::make_stepper<6>(Drag(), 6, options(1e-9, 1.0));
  stepper.start(0.0, Drag::start());
  ASSERT_EQ(stepper.advance(10.0), StepStatus::ok);
  ASSERT_LT(stepper.time(), 0.4);
  while (stepper.time() != 0.4) ASSERT_EQ(stepper.advance(0.4), StepStatus::ok);
  EXPECT_LT((stepper.state() - Drag::exact(0.4)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Rk4Doubling, ALawThatIsNotFiniteFailsAtTheIntervalsStart) {
  const auto law = [](double t, const auto& q, auto& dq) { dq[0] = q[0] / (t < 2.5 ? 1.0 : 0.0); };
  using Vector1 = Eigen::Matrix<double, 1, 1>;
  const auto trajectory = solve<Rk4Doubling>(law, 0.0, Vector1(1.0), 5.0, options(1e-6, 1.0));
  EXPECT_EQ(trajectory.status, IntegrationStatus::not_finite);
  EXPECT_EQ(trajectory.end_time(), 2.0);
}

}  // namespace
}  // namespace trajet
