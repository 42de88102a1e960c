// Problems with published end values as C++ laws, by the explicit Runge-Kutta pairs and the series method. As scenes
// they are in published_scenes_test.cpp.

#include <gtest/gtest.h>

#include <functional>

#include "problems/arenstorf.hpp"
#include "problems/detest.hpp"
#include "problems/euler_tops.hpp"
#include "problems/two_body.hpp"
#include "trajet/ode/solve.hpp"

namespace trajet {
namespace {

using namespace problems;

/// A law of any problem as one type, so that each Runge-Kutta method is compiled once.
using AnyLaw = std::function<void(double, const Eigen::VectorXd&, Eigen::VectorXd&)>;

template <class Problem>
class Published : public testing::Test {
 protected:
  static SolveOptions options(double tolerance) {
    SolveOptions options;
    options.rtol = options.atol = tolerance;
    return options;
  }

  template <class Method>
  static double error(double tolerance) {
    const AnyLaw law = [](double t, const Eigen::VectorXd& q, Eigen::VectorXd& dq) { Problem()(t, q, dq); };
    const Eigen::VectorXd start = Problem::start();
    const auto trajectory = solve<Method>(law, Problem::start_time(), start, Problem::end_time(), options(tolerance));
    EXPECT_EQ(trajectory.status, IntegrationStatus::finished);
    return (trajectory.end() - Problem::reference_end()).cwiseAbs().maxCoeff();
  }
};

using Problems = testing::Types<DetestA1, DetestA2, DetestA3, DetestB2, DetestB5, DetestD1, DetestD3, DetestE1,
                                DetestE3, Arenstorf, HipparchusTop, TumblingBrick>;
TYPED_TEST_SUITE(Published, Problems);

/// By how much errors on the way have grown or added up at the end: measured up to 36000, 352 and 113, rounded up.
template <class Problem>
double amplification() {
  if constexpr (std::is_same_v<Problem, Arenstorf>) return 1e5;
  if constexpr (std::is_same_v<Problem, DetestD1> || std::is_same_v<Problem, DetestD3>) return 500.0;
  return 200.0;
}

TYPED_TEST(Published, EveryPairReachesItsToleranceTimesTheAmplification) {
  for (const double tolerance : {1e-6, 1e-9}) {
    const double bound = tolerance * amplification<TypeParam>();
    EXPECT_LT(this->template error<Bs32>(tolerance), bound) << tolerance;
    EXPECT_LT(this->template error<Dopri5>(tolerance), bound) << tolerance;
    EXPECT_LT(this->template error<Dop853>(tolerance), bound) << tolerance;
  }
}

template <class Problem>
double error_of_series() {
  SolveOptions options;
  options.rtol = options.atol = 1e-15;
  const auto trajectory = solve(Problem(), Problem::start_time(), Problem::start(), Problem::end_time(), options);
  EXPECT_EQ(trajectory.status, IntegrationStatus::finished);
  return (trajectory.end() - Problem::reference_end()).cwiseAbs().maxCoeff();
}

// Rounding alone is left; the orbit multiplies it by 1e5.
TEST(PublishedEnds, TheSeriesMethodReachesTheirDigits) {
  EXPECT_LT(error_of_series<DetestE3>(), 3e-14);
  EXPECT_LT(error_of_series<Arenstorf>(), 3e-10);
  EXPECT_LT(error_of_series<HipparchusTop>(), 1e-13);
}

TEST(EulerTop, KeepsEnergyAndAngularMomentum) {
  SolveOptions options;
  options.rtol = options.atol = 1e-13;
  const auto trajectory = solve(HipparchusTop(), 0.0, HipparchusTop::start(), 100.0, options);
  const Eigen::Vector2d start = HipparchusTop::invariants(HipparchusTop::start());
  for (const auto& segment : trajectory.segments)
    ASSERT_LT((HipparchusTop::invariants(segment.state(segment.t1())) - start).cwiseAbs().maxCoeff(), 1e-11);
}

}  // namespace
}  // namespace trajet
