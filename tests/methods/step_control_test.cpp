#include "trajet/ode/step_control.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "methods/steppers.hpp"
#include "problems/coupled.hpp"
#include "problems/drag.hpp"
#include "problems/kepler.hpp"

namespace trajet {
namespace {

TEST(RoughPowers, AreAsCloseAsTheySay) {
  for (double x = 1e-300; x < 1e300; x *= 1.0173) EXPECT_NEAR(detail::rough_log2(x), std::log2(x), 0.003);
  EXPECT_EQ(detail::rough_log2(0.0), -1023.0);
  EXPECT_EQ(detail::rough_log2(1.0), 0.0);
  for (double y = -999.0; y < 999.0; y += 0.173) EXPECT_NEAR(detail::rough_exp2(y) / std::exp2(y), 1.0, 0.0004);
  EXPECT_EQ(detail::rough_exp2(-3.0), 0.125);
}

TEST(StepController, AimsAtTheToleranceWithinItsLimits) {
  StepController controller(5);
  controller.reset();
  EXPECT_NEAR(controller.accepted(0.0), 10.0, 0.004);
  controller.reset();
  const double grow = controller.accepted(0.01);
  EXPECT_GT(grow, 1.2);
  EXPECT_LT(grow, 0.9 * std::pow(0.01, -0.2));
  // The step that suits an error of 2 at order 5 is shorter by 2^(-1/5), and a tenth for safety.
  EXPECT_NEAR(controller.rejected(2.0), 0.9 * std::pow(2.0, -0.2), 0.001);
  EXPECT_LE(controller.accepted(0.01), 1.0) << "a step after a rejection must not grow";
  EXPECT_NEAR(controller.rejected(1e12), 0.2, 1e-3);
  EXPECT_EQ(controller.rejected(std::numeric_limits<double>::quiet_NaN()), 0.1);
  EXPECT_EQ(controller.rejected(std::numeric_limits<double>::infinity()), 0.1);
}

TEST(StepController, KeepsAStepThatIsNearlyRight) {
  StepController controller(5);
  controller.accepted(0.6);
  EXPECT_EQ(controller.accepted(0.7), 1.0);
  EXPECT_EQ(controller.accepted(0.75), 1.0);
  EXPECT_LT(controller.accepted(0.94), 1.0) << "the next error would be 0.94^2 / 0.75 > 1";
  EXPECT_EQ(controller.accepted(0.94), 1.0);
  EXPECT_LT(controller.accepted(0.99), 1.0);
  EXPECT_GT(controller.accepted(0.2), 1.0);
}

template <class Problem>
double end_error(double tolerance) {
  SolveOptions options;
  options.rtol = options.atol = tolerance;
  const auto trajectory = solve_problem<Dopri5>(Problem(), options);
  EXPECT_EQ(trajectory.status, IntegrationStatus::finished);
  return (trajectory.end() - Problem::exact(Problem::end_time())).cwiseAbs().maxCoeff();
}

// The estimate is of order 4 and the state of order 5, so that the error falls in proportion to the tolerance: over
// eight powers of ten the slope must be 1. Measured: 0.97 to 1.07.
template <class Problem>
void expect_proportional() {
  const double slope = std::log10(end_error<Problem>(1e-3) / end_error<Problem>(1e-11)) / 8.0;
  EXPECT_NEAR(slope, 1.0, 0.15);
}

TEST(Dopri5, ErrorIsProportionalToTheTolerance) {
  expect_proportional<problems::Coupled>();
  expect_proportional<problems::Drag>();
  expect_proportional<problems::Kepler>();
}

TEST(Dopri5, FewStepsAreRejected) {
  SolveOptions options;
  options.rtol = options.atol = 1e-9;
  // Kepler's steps change by a factor of five and back, ten times.
  const StepStatistics statistics = solve_problem<Dopri5>(problems::Kepler(), options).statistics;
  EXPECT_LT(statistics.rejected_steps, statistics.steps / 10);
  // Six evaluations an attempt, and one each for the start and the choice of the first step.
  EXPECT_EQ(statistics.law_evaluations, 6 * (statistics.steps + statistics.rejected_steps) + 2);
}

TEST(Dopri5, GivenFirstStepIsTaken) {
  SolveOptions options;
  options.rtol = options.atol = 1e-6;
  options.step = 1e-3;
  EXPECT_EQ(solve_problem<Dopri5>(problems::Drag(), options).segments.front().t1(), 1e-3);
}

TEST(Dopri5, ChosenFirstStepIsNeitherRejectedNorTiny) {
  for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
    SolveOptions options;
    options.rtol = options.atol = tolerance;
    const auto trajectory = solve_problem<Dopri5>(problems::Drag(), options);
    const double first = trajectory.segments[0].duration();
    const double second = trajectory.segments[1].duration();
    EXPECT_EQ(trajectory.statistics.rejected_steps, 0);
    EXPECT_LT(second, 10.0 * first);
  }
}

TEST(Dopri5, ACutStepDoesNotShortenTheNext) {
  StepOptions options;
  options.rtol = options.atol = 1e-6;
  auto stepper = Dopri5::make_stepper<6>(problems::Drag(), 6, options);
  stepper.start(0.0, problems::Drag::start());
  ASSERT_EQ(stepper.advance(10.0), StepStatus::ok);
  const double first = stepper.time();
  ASSERT_EQ(stepper.advance(first + 1e-7), StepStatus::ok);
  EXPECT_EQ(stepper.time(), first + 1e-7);
  ASSERT_EQ(stepper.advance(10.0), StepStatus::ok);
  EXPECT_GT(stepper.time() - first, 0.9 * first);
}

// A falling body that is stopped by strong friction and a jump of the law: the steps shrink at the jump and go on
// behind it.
TEST(Dopri5, StepsOverAJumpOfTheLaw) {
  const auto law = [](double t, const auto&, auto& dq) { dq[0] = t < 1.0 ? 1.0 : -2.0; };
  SolveOptions options;
  options.rtol = options.atol = 1e-10;
  const auto trajectory = solve<Dopri5>(law, 0.0, Eigen::Matrix<double, 1, 1>(0.0), 3.0, options);
  ASSERT_EQ(trajectory.status, IntegrationStatus::finished);
  // the error of each of the few steps about the jump is within the tolerance, their sum was measured as 6e-9
  EXPECT_NEAR(trajectory.end()[0], -3.0, 2e-8);
  EXPECT_GT(trajectory.statistics.rejected_steps, 0);
}

}  // namespace
}  // namespace trajet
