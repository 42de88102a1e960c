#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "methods/order_conditions.hpp"
#include "problems/coupled.hpp"
#include "problems/kepler.hpp"
#include "trajet/ode/implicit_methods.hpp"

namespace trajet {
namespace {

using problems::Coupled;
using problems::Kepler;
using State = Coupled::State;
using Stepper = decltype(Gauss6::make_stepper<2>(Coupled(), 2, StepOptions()));

constexpr int kStages = Stepper::kStages;
using Weights = std::array<double, 3>;

Weights factors(const Tree& tree) {
  Weights result{1.0, 1.0, 1.0};
  for (const Tree& branch : tree.branches) {
    const Weights inner = factors(branch);
    for (std::size_t i = 0; i < 3; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < 3; ++j) sum += Stepper::kA[i][j] * inner[j];
      result[i] *= sum;
    }
  }
  return result;
}

double defect(int order) {
  double largest = 0.0;
  for (const Tree& tree : trees_up_to(order)) {
    if (tree.order() != order) continue;
    const Weights phi = factors(tree);
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) sum += Stepper::kB[i] * phi[i];
    largest = std::max(largest, std::abs(sum - 1.0 / static_cast<double>(tree.density())));
  }
  return largest;
}

TEST(Gauss6Tableau, MeetsTheConditionsOfOrderSixAndNoMore) {
  for (int order = 1; order <= 6; ++order) EXPECT_LT(defect(order), 1e-15) << order;  // rounding of three products
  EXPECT_GT(defect(7), 1e-5);
}

// b_i a_ij + b_j a_ji = b_i b_j, [HairerLubichWanner2006] VI.4 (4.2); b_i = b_4-i, a_ij + a_4-i,4-j = b_j, V.2 (2.4).
TEST(Gauss6Tableau, IsSymplecticAndSymmetric) {
  const auto& a = Stepper::kA;
  const auto& b = Stepper::kB;
  for (std::size_t i = 0; i < kStages; ++i)
    for (std::size_t j = 0; j < kStages; ++j) {
      EXPECT_NEAR(b[i] * a[i][j] + b[j] * a[j][i], b[i] * b[j], 1e-16);
      EXPECT_NEAR(a[i][j] + a[2 - i][2 - j], b[j], 1e-16);
    }
}

auto solve_coupled(double t0, const State& start, double t1, int steps) {
  SolveOptions options;
  options.step = std::abs(t1 - t0) / steps;
  return solve<Gauss6>(Coupled(), t0, start, t1, options);
}

/// Errors at the end of [1, 1.5] of `steps` steps, forward or backward.
State end_error(double t0, double t1, int steps) {
  return solve_coupled(t0, Coupled::exact(t0), t1, steps).end() - Coupled::exact(t1);
}

// From 16 steps on the leading term rules, from 64 on rounding does: measured orders 5.96 to 6.05.
TEST(Gauss6, ErrorAtTheEndFallsWithTheSixthPower) {
  for (const auto& [t0, t1] : {std::array{1.0, 1.5}, std::array{1.5, 1.0}}) {
    const State coarse = end_error(t0, t1, 16), fine = end_error(t0, t1, 32);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(std::log2(coarse[i] / fine[i]), 6.0, 0.2) << t0 << ' ' << i;
  }
}

// Of order 3 within the step: the error of one falls with h^4, and the bound is its largest value, at the middle.
TEST(Gauss6, ErrorWithinAStepFallsWithTheFourthPowerAsItsBoundSays) {
  const auto error = [](double h, double part) {
    const Segment<2> segment = solve_coupled(1.0, Coupled::exact(1.0), 1.0 + h, 1).segments.front();
    return State(segment.state(1.0 + part * h) - Coupled::exact(1.0 + part * h));
  };
  for (const double part : {0.3, 0.5, 0.6})
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(std::log2(error(0.01, part)[i] / error(0.005, part)[i]), 4.0, 0.2) << part;
  const State bound = solve_coupled(1.0, Coupled::exact(1.0), 1.01, 1).segments.front().error_bound();
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(bound[i] / std::abs(error(0.01, 0.5)[i]), 1.0, 0.1);
}

TEST(Gauss6, GoingBackIsTheInverse) {
  const auto way = solve_coupled(0.25, Coupled::start(), 2.0, 40);
  const auto back = solve_coupled(2.0, way.end(), 0.25, 40);
  // rounding alone, though the error on the way is 4e-10
  EXPECT_LT((back.end() - Coupled::start()).cwiseAbs().maxCoeff(), 2e-15);
}

// 2000 periods of 100 steps: measured 7.0e-8 and 7e-15, and the same 7.0e-8 over a million steps.
TEST(Gauss6, EnergyOfAnOrbitStaysAndAngularMomentumIsKept) {
  StepOptions options;
  options.step = Kepler::kPeriod / 100;
  auto stepper = Gauss6::make_stepper<4>(Kepler(), 4, options);
  const Eigen::Vector2d start = Kepler::invariants(Kepler::start());
  double energy = 0.0, early_energy = 0.0, momentum = 0.0;
  stepper.start(0.0, Kepler::start());
  for (int step = 1; step <= 200'000; ++step) {
    ASSERT_EQ(stepper.advance(1e9), StepStatus::ok);
    const Eigen::Vector2d change = (Kepler::invariants(stepper.state()) - start).cwiseAbs();
    energy = std::max(energy, change[0]);
    momentum = std::max(momentum, change[1]);
    if (step == 100) early_energy = energy;
  }
  EXPECT_LT(early_energy, 1e-7);
  EXPECT_LT(energy, 1.001 * early_energy);
  EXPECT_LT(momentum, 5e-14);
}

// The energy of an oscillator is quadratic, so that only rounding can change it: measured 4.4e-16 after 20000 steps,
// and 2e-14 if the sums of the steps were not compensated.
TEST(Gauss6, RoundingOfTheSumsDoesNotAddUp) {
  const auto oscillator = [](const auto&, const auto& q, auto& dq) {
    dq[0] = q[1];
    dq[1] = -q[0];
  };
  StepOptions options;
  options.step = 0.01;
  auto stepper = Gauss6::make_stepper<2>(oscillator, 2, options);
  stepper.start(0.0, State(1.0, 0.0));
  for (int step = 0; step < 20'000; ++step) {
    ASSERT_EQ(stepper.advance(1e9), StepStatus::ok);
    ASSERT_NEAR(stepper.state().squaredNorm(), 1.0, 3e-15);
  }
}

TEST(Gauss6, UnequalStepsLandOnTheirNodes) {
  SolveOptions options;
  options.nodes = {0.3, 0.5, 0.55, 0.9, 1.2, 1.25, 1.3};
  const auto trajectory = solve<Gauss6>(Coupled(), 0.25, Coupled::start(), 1.3, options);
  ASSERT_EQ(trajectory.segments.size(), options.nodes.size());
  for (std::size_t k = 0; k < options.nodes.size(); ++k) EXPECT_EQ(trajectory.segments[k].t1(), options.nodes[k]);
  EXPECT_LT((trajectory.end() - Coupled::exact(1.3)).cwiseAbs().maxCoeff(), 5e-6);  // measured: 3.0e-6
}

TEST(Gauss6, SolvesStiffEquationsOfItsStages) {
  const auto law = [](const auto& t, const auto& q, auto& dq) {
    using std::cos, std::sin;
    dq[0] = -1e6 * (q[0] - cos(t)) - sin(t);
  };
  SolveOptions options;
  options.step = 0.1;
  const auto trajectory = solve<Gauss6>(law, 0.0, Eigen::Matrix<double, 1, 1>(1.0), 5.0, options);
  EXPECT_EQ(trajectory.status, IntegrationStatus::finished);
  EXPECT_NEAR(trajectory.end()[0], std::cos(5.0), 1e-5);
}

TEST(Gauss6, SaysWhatItCannotDo) {
  SolveOptions options;
  options.step = 0.1;
  const auto root = [](const auto& t, const auto&, auto& dq) {
    using std::sqrt;
    dq[0] = sqrt(1.0 - t);
  };
  const auto ends = solve<Gauss6>(root, 0.0, Eigen::Matrix<double, 1, 1>(0.0), 2.0, options);
  EXPECT_EQ(ends.status, IntegrationStatus::not_finite);
  EXPECT_NEAR(ends.end_time(), 1.0, 1e-12);
  // q = 1/(1 - t) has no solution of the stage equations near t = 1
  const auto square = [](const auto&, const auto& q, auto& dq) { dq[0] = q[0] * q[0]; };
  const auto explosion = solve<Gauss6>(square, 0.0, Eigen::Matrix<double, 1, 1>(1.0), 2.0, options);
  EXPECT_NE(explosion.status, IntegrationStatus::finished);
  EXPECT_LT(explosion.end_time(), 1.2);
}

}  // namespace
}  // namespace trajet
