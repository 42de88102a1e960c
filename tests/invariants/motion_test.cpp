// What a solver must keep whatever it computes: conserved quantities, and the symmetries of the laws.

#include <gtest/gtest.h>

#include <cmath>

#include "problems/drag.hpp"
#include "problems/free_kick.hpp"
#include "problems/kepler.hpp"
#include "problems/lotka_volterra.hpp"
#include "problems/oscillator.hpp"
#include "trajet/ode/solve.hpp"

namespace trajet {
namespace {

using namespace problems;

template <class Method>
SolveOptions options_for() {
  SolveOptions options;
  options.rtol = options.atol = 1e-12;
  options.step = 1.0 / 512;
  return options;
}

template <class Method, class Problem>
double largest_drift() {
  const auto trajectory =
      solve<Method>(Problem(), Problem::start_time(), Problem::start(), Problem::end_time(), options_for<Method>());
  const auto at_start = Problem::invariants(Problem::start());
  double drift = 0.0;
  for (const auto& segment : trajectory.segments)
    drift = std::max(drift, (Problem::invariants(segment.state(segment.t1())) - at_start).cwiseAbs().maxCoeff());
  return drift;
}

struct Drift {
  double rk4, dopri5, taylor;
};

/// Bounds are three times what was measured.
template <class Problem>
void expect_conserved(const Drift& bound) {
  EXPECT_LE((largest_drift<Rk4, Problem>()), bound.rk4);
  EXPECT_LE((largest_drift<Dopri5, Problem>()), bound.dopri5);
  EXPECT_LE((largest_drift<Taylor, Problem>()), bound.taylor);
}

TEST(Conserved, EnergyOfTheOscillator) { expect_conserved<Oscillator>({4e-14, 4e-11, 4e-13}); }
TEST(Conserved, EnergyAndAngularMomentumOfTheOrbit) { expect_conserved<Kepler>({3e-10, 4e-11, 2e-12}); }
TEST(Conserved, QuantityOfPreyAndPredator) { expect_conserved<LotkaVolterra>({3e-10, 2e-11, 2e-11}); }

template <class Method>
class Symmetry : public testing::Test {};
using Methods = testing::Types<Euler, Midpoint, Rk4, Dopri5, Taylor>;
TYPED_TEST_SUITE(Symmetry, Methods);

// A power of two as the unit of length changes exponents only: the same bits. Tolerances scale with it.
TYPED_TEST(Symmetry, AnotherUnitOfLengthGivesTheSameBits) {
  constexpr double kUnit = 1024.0;
  const auto drag = [](const auto&, const auto& q, auto& dq) {
    for (int i = 0; i < 3; ++i) {
      dq[i] = -q[i] * q[i] * (1.0 / (kUnit * (i + 1)));
      dq[3 + i] = q[i];
    }
  };
  const auto drag_in_km = [](const auto&, const auto& q, auto& dq) {
    for (int i = 0; i < 3; ++i) {
      dq[i] = -q[i] * q[i] * (1.0 / (i + 1));
      dq[3 + i] = q[i];
    }
  };
  SolveOptions options;
  options.step = 0.125;
  options.atol = 1e-9;
  const auto large = solve<TypeParam>(drag, 0.0, Eigen::Matrix<double, 6, 1>(kUnit * Drag::start()), 10.0, options);
  options.atol /= kUnit;
  const auto small = solve<TypeParam>(drag_in_km, 0.0, Drag::start(), 10.0, options);
  EXPECT_EQ(large.end(), (kUnit * small.end()).eval());
}

// The drag of the flight through wind: an observer who moves with it sees the same flight (to rounding and tolerance).
TYPED_TEST(Symmetry, AMovingObserverSeesTheSameMotion) {
  const Eigen::Vector2d w(3.0, -2.0);  // m/s
  const auto law_of = [](double wx, double wy) {
    return [wx, wy](const auto&, const auto& q, auto& dq) {
      using std::sqrt;
      const auto ux = q[0] - wx;
      const auto uy = q[1] - wy;
      const auto drag = 0.1 * sqrt(ux * ux + uy * uy);
      dq[0] = -drag * ux;
      dq[1] = -9.81 - drag * uy;
      dq[2] = q[0];
      dq[3] = q[1];
    };
  };
  const double t = 2.0;
  const Eigen::Vector4d start(20.0, 10.0, 0.0, 0.0);
  const Eigen::Vector4d shift(w[0], w[1], 0.0, 0.0);
  const auto at_rest = solve<TypeParam>(law_of(w[0], w[1]), 0.0, start, t, options_for<TypeParam>()).end();
  const auto moving =
      solve<TypeParam>(law_of(0.0, 0.0), 0.0, Eigen::Vector4d(start - shift), t, options_for<TypeParam>()).end();
  const Eigen::Vector4d seen(moving[0] + w[0], moving[1] + w[1], moving[2] + w[0] * t, moving[3] + w[1] * t);
  // Runge-Kutta methods with given steps commute with the shift, 1024 roundings of numbers up to 50; the others choose
  // their steps by the size of the state.
  EXPECT_LE((at_rest - seen).cwiseAbs().maxCoeff(), 1e-11);
}

template <class Method>
double error_there_and_back() {
  const auto there = solve<Method>(FreeKick(), 0.0, FreeKick::start(), 2.0, options_for<Method>());
  const auto back = solve<Method>(FreeKick(), 2.0, there.end(), 0.0, options_for<Method>());
  return (back.end() - FreeKick::start()).cwiseAbs().maxCoeff();
}

TEST(GoingBack, ComesToTheStartWithinTheTolerance) {
  EXPECT_LE(error_there_and_back<Dopri5>(), 1e-10);
  EXPECT_LE(error_there_and_back<Taylor>(), 1e-10);
}

// A component that stays exactly zero must not meet a division by a zero tolerance.
TEST(Dopri5, PurelyRelativeToleranceAllowsAComponentThatIsZero) {
  const auto law = [](double, const auto& q, auto& dq) {
    dq[0] = -q[0];
    dq[1] = 0.0;
  };
  SolveOptions options;
  options.rtol = 1e-9;
  options.atol = 0.0;
  const auto trajectory = solve<Dopri5>(law, 0.0, Eigen::Vector2d(1.0, 0.0), 5.0, options);
  ASSERT_EQ(trajectory.status, IntegrationStatus::finished);
  EXPECT_NEAR(trajectory.end()[0] / std::exp(-5.0), 1.0, 1e-8);
  EXPECT_EQ(trajectory.end()[1], 0.0);
}

}  // namespace
}  // namespace trajet
