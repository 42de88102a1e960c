// The named problems with a closed form or a published end, solved by every method.

#include <gtest/gtest.h>

#include <type_traits>

#include "problems/acceleration.hpp"
#include "problems/coupled.hpp"
#include "problems/drag.hpp"
#include "problems/free_kick.hpp"
#include "problems/kepler.hpp"
#include "problems/lotka_volterra.hpp"
#include "problems/oscillator.hpp"
#include "trajet/ode/solve.hpp"

namespace trajet {
namespace {

using namespace problems;

template <class Problem>
typename Problem::State known_end() {
  if constexpr (requires { Problem::exact(0.0); }) {
    return Problem::exact(Problem::end_time());
  } else {
    return Problem::reference_end();
  }
}

/// Largest error of any component at the end.
template <class Method, class Problem>
double end_error(const SolveOptions& options) {
  const auto trajectory =
      solve<Method>(Problem(), Problem::start_time(), Problem::start(), Problem::end_time(), options);
  EXPECT_EQ(trajectory.status, IntegrationStatus::finished);
  return (trajectory.end() - known_end<Problem>()).cwiseAbs().maxCoeff();
}

SolveOptions with_tolerance(double tolerance) {
  SolveOptions options;
  options.rtol = options.atol = tolerance;
  return options;
}

SolveOptions with_step(double step) {
  SolveOptions options;
  options.step = step;
  return options;
}

template <class Problem>
class Solutions : public testing::Test {
 public:
  /// How much the problem multiplies the errors made along the way: twice what was measured with dopri5. Ten orbits
  /// turn an error of the energy into one along the orbit.
  static double condition() {
    if (std::is_same_v<Problem, Kepler>) return 5e4;
    return std::is_same_v<Problem, LotkaVolterra> ? 20.0 : 10.0;
  }
};
using Problems = testing::Types<Drag, FreeKick, Oscillator, Kepler, LotkaVolterra, Coupled, ConstantAcceleration,
                                LinearAcceleration>;
TYPED_TEST_SUITE(Solutions, Problems);

TYPED_TEST(Solutions, Dopri5IsWithinTheToleranceTimesTheCondition) {
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    EXPECT_LE((end_error<Dopri5, TypeParam>(with_tolerance(tolerance))), TestFixture::condition() * tolerance)
        << tolerance;
  }
}

TYPED_TEST(Solutions, TaylorIsWithinTheToleranceTimesTheCondition) {
  for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
    EXPECT_LE((end_error<Taylor, TypeParam>(with_tolerance(tolerance))), TestFixture::condition() * tolerance)
        << tolerance;
  }
}

TYPED_TEST(Solutions, Rk4WithShortStepsIsRight) {
  const double step = (TypeParam::end_time() - TypeParam::start_time()) / 20000;
  // the orbit, measured: 6e-7; all others below 1e-9
  EXPECT_LE((end_error<Rk4, TypeParam>(with_step(step))), (std::is_same_v<TypeParam, Kepler> ? 2e-6 : 1e-8));
}

// Where the solution is a polynomial within the reach of the method, one step is exact: F18 and F21 of the course.
TEST(PolynomialMotion, IsExactInOneStepOfASufficientOrder) {
  // a few units in the last place of 61 and of 177: the sums of the polynomials are rounded thrice
  EXPECT_LE((end_error<Midpoint, ConstantAcceleration>(with_step(10.0))), 3e-14);
  EXPECT_LE((end_error<Rk4, ConstantAcceleration>(with_step(10.0))), 3e-14);
  EXPECT_LE((end_error<Rk4, LinearAcceleration>(with_step(10.0))), 1.2e-13);
  EXPECT_LE((end_error<Taylor, LinearAcceleration>(with_tolerance(1e-12))), 6e-14);
}

// Euler's method on a = (0, 0, t): z is short by the factor (1 - 1/N)(1 - 2/N), v_z by 1 - 1/N (erratum A13 of the
// course).
TEST(PolynomialMotion, EulerIsShortByTheKnownFactors) {
  const int n = 5;
  const auto end =
      solve<Euler>(LinearAcceleration(), 0.0, LinearAcceleration::start(), 10.0, with_step(10.0 / n)).end();
  EXPECT_NEAR(end[2], 50.0 * (1.0 - 1.0 / n), 1e-13);
  EXPECT_NEAR(end[5], 1.0 + 1000.0 / 6.0 * (1.0 - 1.0 / n) * (1.0 - 2.0 / n), 1e-13);
}

TEST(PolynomialMotion, TaylorTakesOneStep) {
  const auto trajectory = solve(ConstantAcceleration(), 0.0, ConstantAcceleration::start(), 10.0);
  EXPECT_EQ(trajectory.segments.size(), 1u);
  EXPECT_EQ(trajectory.segments.front().degree(), 2);
}

}  // namespace
}  // namespace trajet
