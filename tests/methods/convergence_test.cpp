#include <gtest/gtest.h>

#include <cmath>

#include "methods/steppers.hpp"
#include "problems/coupled.hpp"
#include "problems/drag.hpp"

namespace trajet {
namespace {

using problems::Coupled;
using State = Coupled::State;

/// log2 of the ratio of two errors with their signs: not a number where the sign changes.
double observed_order(double error, double error_of_half_the_step) { return std::log2(error / error_of_half_the_step); }

/// Signed error at the end of [t0, t1] with `steps` equal steps; backward if t1 < t0.
template <class Method>
State end_error(double t0, double t1, int steps) {
  SolveOptions options;
  options.step = std::abs(t1 - t0) / steps;
  return solve<Method>(Coupled(), t0, Coupled::exact(t0), t1, options).end() - Coupled::exact(t1);
}

template <class Method>
class Convergence : public testing::Test {};
TYPED_TEST_SUITE(Convergence, FixedStepMethods);

// Steps short enough that the leading term rules and long enough that rounding does not: the measured deviations from
// the order are below 0.1, the bound of 0.2 would not let the neighbouring orders pass.
template <class Method>
void expect_order(double t0, double t1) {
  using Tableau = typename Method::Tableau;
  const int first = Tableau::kOrder == 1 ? 800 : Tableau::kOrder < 5 ? 200 : 100;
  State coarse = end_error<Method>(t0, t1, first);
  int compared = 0;
  for (int steps = 2 * first; steps <= 8 * first; steps *= 2) {
    const State fine = end_error<Method>(t0, t1, steps);
    if (fine.cwiseAbs().minCoeff() < 1e-13) break;
    for (int i = 0; i < Coupled::kDimension; ++i)
      EXPECT_NEAR(observed_order(coarse[i], fine[i]), Tableau::kOrder, 0.2)
          << "component " << i << ", " << steps << " steps";
    coarse = fine;
    ++compared;
  }
  EXPECT_GT(compared, 0) << "only rounding was seen";
}

TYPED_TEST(Convergence, ErrorAtTheEndFallsWithTheOrder) {
  expect_order<TypeParam>(Coupled::start_time(), Coupled::end_time());
}

// Not back to the start: there the leading term of rk4-3/8's error in the first component nearly vanishes.
TYPED_TEST(Convergence, SoItDoesBackward) { expect_order<TypeParam>(Coupled::end_time(), 0.5); }

// Long and short steps in turn, 3 : 2.
template <class Method>
State end_error_of_unequal_steps(int steps) {
  const double t0 = Coupled::start_time();
  const double t1 = Coupled::end_time();
  SolveOptions options;
  for (int k = 1; k <= steps; ++k) options.nodes.push_back(t0 + (t1 - t0) * (k + (k % 2 == 1 ? 0.2 : 0.0)) / steps);
  const auto trajectory = solve<Method>(Coupled(), t0, Coupled::exact(t0), t1, options);
  EXPECT_EQ(trajectory.segments.size(), options.nodes.size());
  for (std::size_t k = 0; k < trajectory.segments.size(); ++k) EXPECT_EQ(trajectory.segments[k].t1(), options.nodes[k]);
  return trajectory.end() - Coupled::exact(t1);
}

TYPED_TEST(Convergence, UnequalStepsKeepTheOrder) {
  const int steps = TypeParam::Tableau::kOrder == 1 ? 800 : 200;
  const State coarse = end_error_of_unequal_steps<TypeParam>(steps);
  const State fine = end_error_of_unequal_steps<TypeParam>(2 * steps);
  for (int i = 0; i < Coupled::kDimension; ++i)
    EXPECT_NEAR(observed_order(coarse[i], fine[i]), TypeParam::Tableau::kOrder, 0.2) << "component " << i;
}

/// The Segment of one step from the exact solution at t0.
template <class Method>
Segment<2> first_segment(double t0, double h) {
  SolveOptions options;
  options.step = h;
  return solve<Method>(Coupled(), t0, Coupled::exact(t0), t0 + h, options).segments.front();
}

TYPED_TEST(Convergence, DenseOutputIsOfItsOrderWithinTheStep) {
  const double t0 = 1.0;
  const double h = TypeParam::Tableau::kOrder < 3 ? 1e-3 : 0.01;
  for (const double part : {0.15, 0.35, 0.55}) {
    State error[2];
    for (int half = 0; half < 2; ++half) {
      const double step = half == 0 ? h : h / 2;
      error[half] = first_segment<TypeParam>(t0, step).state(t0 + part * step) - Coupled::exact(t0 + part * step);
    }
    for (int i = 0; i < Coupled::kDimension; ++i)
      EXPECT_NEAR(observed_order(error[0][i], error[1][i]), TypeParam::Tableau::kDenseOrder + 1, 0.2)
          << "component " << i << " at " << part;
  }
}

TYPED_TEST(Convergence, ErrorBoundFallsWithTheCompanionsOrderAndHolds) {
  using Tableau = typename TypeParam::Tableau;
  const double t0 = 1.0;
  const double h = Tableau::kOrder < 4 ? 1e-3 : 1.0 / 64;
  const State bound = first_segment<TypeParam>(t0, h).error_bound();
  const State bound_half = first_segment<TypeParam>(t0, h / 2).error_bound();
  const State error = (first_segment<TypeParam>(t0, h).state(t0 + h) - Coupled::exact(t0 + h)).cwiseAbs();
  // The midpoint rule's companion has the same order; elsewhere the lower order of the two rules the difference.
  const int power = std::min(Tableau::kOrder, Tableau::kCompanionOrder) + 1;
  for (int i = 0; i < Coupled::kDimension; ++i) {
    EXPECT_NEAR(observed_order(bound[i], bound_half[i]), power, 0.2) << "component " << i;
    // Euler's bound is the leading term of its error: it may be missed by the next term, h times smaller.
    EXPECT_LE(error[i], bound[i] * (1.0 + 10.0 * h)) << "component " << i;
    EXPECT_GT(error[i], 0.0);
  }
}

TYPED_TEST(Convergence, GoingBackUndoesTheWayUpToTheError) {
  const int order = TypeParam::Tableau::kOrder;
  const int steps = 1000;
  SolveOptions options;
  options.step = (Coupled::end_time() - Coupled::start_time()) / steps;
  const auto way = solve_problem<TypeParam>(Coupled(), options);
  const auto back = solve<TypeParam>(Coupled(), way.end_time(), way.end(), Coupled::start_time(), options);
  // measured: 10 h^p for euler, less for the others
  EXPECT_LE((back.end() - Coupled::start()).cwiseAbs().maxCoeff(), 15.0 * std::pow(*options.step, order) + 1e-14);
  EXPECT_EQ(back.end_time(), Coupled::start_time());
}

TYPED_TEST(Convergence, TimeMirroredGivesTheSameSolution) {
  const auto mirrored = [](double t, const auto& q, auto& dq) {
    Coupled()(-t, q, dq);
    dq = -dq;
  };
  SolveOptions options;
  options.step = 0.01;
  const auto forward = solve<TypeParam>(Coupled(), 0.25, Coupled::start(), 2.0, options);
  const auto backward = solve<TypeParam>(mirrored, -0.25, Coupled::start(), -2.0, options);
  // 150 steps; the compiler may fuse the mirrored law's operations in another way.
  EXPECT_LE((forward.end() - backward.end()).cwiseAbs().maxCoeff(), 1e-13);
}

// The course's F48 and F49: the largest error of any component at any node of the 3-D drag, as the errata recomputed
// it.
template <class Method>
double largest_error_on_drag(int steps) {
  SolveOptions options;
  options.step = problems::Drag::end_time() / steps;
  double largest = 0.0;
  for (const auto& segment : solve_problem<Method>(problems::Drag(), options).segments) {
    const double t = segment.t1();
    largest = std::max(largest, (segment.state(t) - problems::Drag::exact(t)).cwiseAbs().maxCoeff());
  }
  return largest;
}

TEST(DragOfTheCourse, ErrorsAreThePublishedOnes) {
  // 15 digits are given; rounding in the sums costs the last one of the error's own digits.
  EXPECT_NEAR(largest_error_on_drag<Euler>(10), 1.39789527279837, 2e-14);
  EXPECT_NEAR(largest_error_on_drag<Euler>(40), 0.0702641221366347, 2e-14);
  EXPECT_NEAR(largest_error_on_drag<Rk4>(10), 0.0542477931734899, 2e-14);
  EXPECT_NEAR(largest_error_on_drag<Rk4>(40), 7.53983131197348e-5, 2e-14);
}

}  // namespace
}  // namespace trajet
