#ifdef TRAJET_WITH_SUNDIALS

#include <gtest/gtest.h>

#include <cmath>

#include "problems/coupled.hpp"
#include "trajet/ode/implicit_methods.hpp"

namespace trajet {
namespace {

using problems::Coupled;
using State = Coupled::State;

template <class Method>
class Multistep : public testing::Test {};
using Methods = testing::Types<Adams, Bdf>;
TYPED_TEST_SUITE(Multistep, Methods);

template <class Method>
auto solve_coupled(double t0, double t1, double tolerance) {
  SolveOptions options;
  options.rtol = options.atol = tolerance;
  return solve<Method>(Coupled(), t0, Coupled::exact(t0), t1, options);
}

// Errors add up over 20 to 560 steps: measured up to 15 times the tolerance at the ends, 220 times on the way, where
// the solution is 2 to 3 times as large.
TYPED_TEST(Multistep, ErrorFollowsTheToleranceAtTheEndAndWithinTheSteps) {
  for (const double tolerance : {1e-4, 1e-6, 1e-9, 1e-12}) {
    const auto way = solve_coupled<TypeParam>(0.25, 2.0, tolerance);
    EXPECT_EQ(way.end_time(), 2.0);
    EXPECT_LT((way.end() - Coupled::exact(2.0)).cwiseAbs().maxCoeff(), 300.0 * tolerance);
    for (const auto& segment : way.segments)
      for (const double part : {0.0, 0.3, 0.7, 1.0}) {
        const double t = segment.t0() + part * segment.duration();
        EXPECT_LT((segment.state(t) - Coupled::exact(t)).cwiseAbs().maxCoeff(), 1000.0 * tolerance);
      }
    const auto back = solve_coupled<TypeParam>(2.0, 0.25, tolerance);
    EXPECT_EQ(back.end_time(), 0.25);
    EXPECT_LT((back.end() - Coupled::start()).cwiseAbs().maxCoeff(), 300.0 * tolerance);
  }
}

// CVODE's polynomial passes through both ends of its step.
TYPED_TEST(Multistep, SegmentsMeet) {
  const auto way = solve_coupled<TypeParam>(0.25, 2.0, 1e-8);
  State known = Coupled::start();
  double time = 0.25;
  int highest = 0;
  for (const auto& segment : way.segments) {
    EXPECT_EQ(segment.t0(), time);
    EXPECT_LE((segment.state(time) - known).cwiseAbs().maxCoeff(), 2e-15);
    known = segment.state(segment.t1());
    time = segment.t1();
    highest = std::max(highest, segment.degree());
  }
  EXPECT_GE(highest, 5);
}

TYPED_TEST(Multistep, LandsTurnsAndStartsAnew) {
  StepOptions options;
  options.rtol = options.atol = 1e-9;
  auto stepper = TypeParam::template make_stepper<2>(Coupled(), 2, options);
  const auto run = [&] {
    stepper.start(0.25, Coupled::start());
    // limits ahead, next to each other to the last bit, then backward
    for (const double limit : {0.5, 0.5 + 1e-16 * 2, std::nextafter(0.5 + 1e-16 * 2, 1.0), 1.5, 1.0}) {
      while (stepper.time() != limit) {
        const double before = stepper.time();
        EXPECT_EQ(stepper.advance(limit), StepStatus::ok);
        if (stepper.time() == before) return State(stepper.state());
        EXPECT_LE(std::abs(limit - stepper.time()), std::abs(limit - before));
      }
    }
    return State(stepper.state());
  };
  const State first = run();
  EXPECT_EQ(stepper.time(), 1.0);
  EXPECT_LT((first - Coupled::exact(1.0)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(run(), first);
}

TYPED_TEST(Multistep, SaysWhatItCannotDo) {
  const auto run = [](auto law, double q) {
    SolveOptions options;
    options.rtol = options.atol = 1e-6;
    return solve<TypeParam>(law, 0.0, Eigen::Matrix<double, 1, 1>(q), 2.0, options);
  };
  const auto explosion = run([](const auto&, const auto& q, auto& dq) { dq[0] = q[0] * q[0]; }, 1.0);
  EXPECT_NE(explosion.status, IntegrationStatus::finished);
  EXPECT_NEAR(explosion.end_time(), 1.0, 1e-3);
  const auto root = [](const auto& t, const auto&, auto& dq) {
    using std::sqrt;
    dq[0] = sqrt(1.0 - t);
  };
  const auto ends = run(root, 0.0);
  EXPECT_EQ(ends.status, IntegrationStatus::not_finite);
  EXPECT_NEAR(ends.end_time(), 1.0, 1e-3);
  EXPECT_GT(ends.segments.size(), 5u);
  const auto logarithm = [](const auto&, const auto& q, auto& dq) {
    using std::log;
    dq[0] = log(q[0]);
  };
  EXPECT_EQ(run(logarithm, -1.0).status, IntegrationStatus::not_finite);
}

// The law jumps: the step shrinks as far as it takes.
TYPED_TEST(Multistep, GetsPastAJump) {
  SolveOptions options;
  options.rtol = options.atol = 1e-8;
  const auto law = [](const auto& t, const auto&, auto& dq) { dq[0] = t < 1.0 ? 0.0 : 1e3; };
  const auto trajectory = solve<TypeParam>(law, 0.0, Eigen::Matrix<double, 1, 1>(0.0), 2.0, options);
  EXPECT_EQ(trajectory.status, IntegrationStatus::finished);
  EXPECT_NEAR(trajectory.end()[0], 1e3, 1e-3);
}

TYPED_TEST(Multistep, NoToleranceIsAnError) {
  SolveOptions options;
  options.rtol = options.atol = 0.0;
  EXPECT_THROW(solve<TypeParam>(Coupled(), 0.25, Coupled::start(), 1.0, options), std::invalid_argument);
}

TEST(Bdf, StiffnessCostsNoSteps) {
  const auto law = [](const auto& t, const auto& q, auto& dq) {
    using std::cos, std::sin;
    dq[0] = -1e9 * (q[0] - cos(t)) - sin(t);
  };
  SolveOptions options;
  options.rtol = options.atol = 1e-6;
  const auto trajectory = solve<Bdf>(law, 0.0, Eigen::Matrix<double, 1, 1>(2.0), 10.0, options);
  EXPECT_LT(trajectory.segments.size(), 1000u);
  EXPECT_NEAR(trajectory.end()[0], std::cos(10.0), 1e-5);
}

}  // namespace
}  // namespace trajet

#endif
