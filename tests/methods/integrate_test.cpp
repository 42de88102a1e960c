#include "trajet/ode/integrate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "methods/steppers.hpp"
#include "problems/coupled.hpp"
#include "problems/lotka_volterra.hpp"

namespace trajet {
namespace {

using problems::Coupled;
using Scalar = Eigen::Matrix<double, 1, 1>;

SolveOptions some_options() {
  SolveOptions options;
  options.rtol = options.atol = 1e-9;
  options.step = 0.01;
  return options;
}

template <class Method>
class Integrate : public testing::Test {};
using Methods = testing::Types<Euler, Midpoint, Rk4, Dopri5>;
TYPED_TEST_SUITE(Integrate, Methods);

TYPED_TEST(Integrate, LandsExactlyOnAnyEnd) {
  for (const double end : {0.1 + 0.2, std::nextafter(1.0, 2.0), 1.0 / 3.0, 0.25 + 1e-9, 0.0, -1.7}) {
    const auto trajectory = solve<TypeParam>(Coupled(), 0.25, Coupled::start(), end, some_options());
    EXPECT_EQ(trajectory.status, IntegrationStatus::finished);
    EXPECT_EQ(trajectory.end_time(), end);
  }
}

// Each Segment begins with the state that the stepper held, and ends in the next one's to rounding.
TYPED_TEST(Integrate, SegmentsPartitionTimeAndJoin) {
  for (const double end : {2.0, -1.0}) {
    const auto trajectory = solve<TypeParam>(Coupled(), 0.25, Coupled::start(), end, some_options());
    EXPECT_EQ(trajectory.segments.front().t0(), 0.25);
    EXPECT_EQ(trajectory.segments.front().coefficients().col(0), Coupled::start());
    for (std::size_t k = 1; k < trajectory.segments.size(); ++k) {
      const auto& before = trajectory.segments[k - 1];
      const auto& after = trajectory.segments[k];
      ASSERT_EQ(before.t1(), after.t0());
      const Coupled::State gap = before.state(before.t1()) - after.coefficients().col(0);
      // dopri5's polynomials reach factors of 10: a few units in the last place of numbers up to 3.
      ASSERT_LE(gap.cwiseAbs().maxCoeff(), 4e-15);
    }
  }
}

TYPED_TEST(Integrate, FirstDerivativeOfASegmentIsTheRate) {
  const auto trajectory = solve<TypeParam>(Coupled(), 0.25, Coupled::start(), 1.0, some_options());
  for (const auto& segment : trajectory.segments) {
    const Coupled::State q = segment.coefficients().col(0);
    Coupled::State rate;
    Coupled()(segment.t0(), q, rate);
    // bit by bit but for the compiler's choice of fused operations
    ASSERT_LE((segment.coefficients().col(1) - rate).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TYPED_TEST(Integrate, NothingToDoTakesNoStep) {
  const auto trajectory = solve<TypeParam>(Coupled(), 0.25, Coupled::start(), 0.25, some_options());
  EXPECT_EQ(trajectory.status, IntegrationStatus::finished);
  EXPECT_TRUE(trajectory.segments.empty());
  EXPECT_EQ(trajectory.end(), Coupled::start());
  EXPECT_EQ(trajectory.statistics.steps, 0);
}

TYPED_TEST(Integrate, StopsAfterTooManySteps) {
  SolveOptions options = some_options();
  options.max_steps = 3;
  const auto trajectory = solve<TypeParam>(Coupled(), 0.25, Coupled::start(), 2.0, options);
  EXPECT_EQ(trajectory.status, IntegrationStatus::too_many_steps);
  EXPECT_EQ(trajectory.segments.size(), 3u);
  EXPECT_LT(trajectory.end_time(), 2.0);
}

TYPED_TEST(Integrate, TheSinkMayStopIt) {
  auto stepper = TypeParam::template make_stepper<2>(Coupled(), 2, some_options());
  const auto result = integrate(stepper, 0.25, Coupled::start(), 2.0, kDefaultMaxSteps,
                                [](const auto& s) { return s.statistics().steps == 2 ? Flow::stop : Flow::go_on; });
  EXPECT_EQ(result.status, IntegrationStatus::stopped);
  EXPECT_EQ(result.time, stepper.time());
  EXPECT_EQ(stepper.statistics().steps, 2);
}

TYPED_TEST(Integrate, StartAgainMeansANewStart) {
  auto stepper = TypeParam::template make_stepper<2>(Coupled(), 2, some_options());
  integrate(stepper, 0.25, Coupled::start(), 1.0);
  const Coupled::State first = stepper.state();
  integrate(stepper, 0.5, Coupled::start(), 0.75);
  integrate(stepper, 0.25, Coupled::start(), 1.0);
  EXPECT_EQ(stepper.state(), first);
}

TYPED_TEST(Integrate, ALawThatIsNotANumberFailsWhereItBegins) {
  const auto law = [](double t, const auto& q, auto& dq) { dq[0] = q[0] + std::sqrt(0.5 - t); };
  const auto trajectory = solve<TypeParam>(law, 0.0, Scalar(1.0), 2.0, some_options());
  EXPECT_EQ(trajectory.status, IntegrationStatus::not_finite);
  EXPECT_LE(trajectory.end_time(), 0.5 + 0.01);
  EXPECT_GE(trajectory.end_time(), 0.5 - 0.011);
  EXPECT_TRUE(std::isfinite(trajectory.end()[0]));
  const auto at_once = solve<TypeParam>(law, 1.0, Scalar(1.0), 2.0, some_options());
  EXPECT_EQ(at_once.status, IntegrationStatus::not_finite);
  EXPECT_EQ(at_once.end_time(), 1.0);
}

TEST(Dopri5, ASolutionThatExplodesEndsTheIntegrationAtThePole) {
  const auto law = [](double, const auto& q, auto& dq) { dq[0] = q[0] * q[0]; };
  const auto trajectory = solve<Dopri5>(law, 0.0, Scalar(1.0), 2.0, some_options());  // q = 1 / (1 - t)
  EXPECT_TRUE(trajectory.status == IntegrationStatus::step_too_small ||
              trajectory.status == IntegrationStatus::not_finite);
  EXPECT_NEAR(trajectory.end_time(), 1.0, 1e-8);
}

TEST(Trajectory, IsAFunctionOfTime) {
  const auto trajectory = solve<Dopri5>(Coupled(), 2.0, Coupled::exact(2.0), 0.25, some_options());
  for (double t = 0.25; t <= 2.0; t += 0.01)
    EXPECT_LE((trajectory.state(t) - Coupled::exact(t)).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_EQ(trajectory.state(2.0), Coupled::exact(2.0));
  EXPECT_THROW(trajectory.state(2.1), std::out_of_range);
  EXPECT_THROW(trajectory.state(0.2), std::out_of_range);
  EXPECT_THROW(trajectory.state(std::numeric_limits<double>::quiet_NaN()), std::out_of_range);
}

TEST(Solve, TakesStatesOfRunTimeDimension) {
  const Eigen::VectorXd start = problems::LotkaVolterra::start();
  const auto dynamic = solve<Rk4>(problems::LotkaVolterra(), 0.0, start, 1.0, some_options());
  const auto fixed = solve<Rk4>(problems::LotkaVolterra(), 0.0, problems::LotkaVolterra::start(), 1.0, some_options());
  // The compiler may fuse operations in one and not in the other: 100 steps.
  EXPECT_LE((dynamic.end() - fixed.end()).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Solve, WithoutAStepAFixedStepMethodRefuses) {
  EXPECT_THROW(solve<Rk4>(Coupled(), 0.25, Coupled::start(), 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace trajet
