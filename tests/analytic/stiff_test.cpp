// The published stiff problems with their published ends, by every method that suits, as C++ laws and as scenes.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "problems/hires.hpp"
#include "problems/robertson.hpp"
#include "problems/van_der_pol.hpp"
#include "scene_run.hpp"
#include "trajet/ode/implicit_methods.hpp"

namespace trajet {
namespace {

using namespace problems;

/// The absolute tolerance over the relative one: a size below which the components do not matter.
template <class Problem>
constexpr double kScale = 1e-4;
template <>
constexpr double kScale<VanDerPol> = 1e-3;
template <>
constexpr double kScale<Robertson> = 1e-14;  // the second substance ends at 8e-14

/// The largest error of a component at the end over its tolerance.
template <class Problem>
double error_over_tolerance(const typename Problem::State& end, double rtol) {
  const typename Problem::State known = Problem::reference_end();
  const auto tolerance = rtol * (known.cwiseAbs().array() + kScale<Problem>);
  return ((end - known).cwiseAbs().array() / tolerance).maxCoeff();
}

template <class Method, class Problem>
double solved(double rtol) {
  SolveOptions options;
  options.rtol = rtol;
  options.atol = kScale<Problem> * rtol;
  const auto trajectory =
      solve<Method>(Problem(), Problem::start_time(), Problem::start(), Problem::end_time(), options);
  EXPECT_EQ(trajectory.status, IntegrationStatus::finished);
  return error_over_tolerance<Problem>(trajectory.end(), rtol);
}

template <class Problem>
class Stiff : public testing::Test {};
using Problems = testing::Types<Robertson, VanDerPol, Hires>;
TYPED_TEST_SUITE(Stiff, Problems);

// measured: 0.01 to 0.4 times the tolerance, at 1e-12 2.8 times
TYPED_TEST(Stiff, Rodas5pMeetsTheTolerance) {
  for (const double rtol : {1e-3, 1e-6, 1e-9}) EXPECT_LT((solved<Rodas5p, TypeParam>(rtol)), 1.0) << rtol;
  EXPECT_LT((solved<Rodas5p, TypeParam>(1e-12)), 10.0);
}

#ifdef TRAJET_WITH_SUNDIALS
// measured: 0.4 to 56
TYPED_TEST(Stiff, BdfIsWithinAHundredTolerances) {
  for (const double rtol : {1e-3, 1e-6, 1e-9, 1e-12}) EXPECT_LT((solved<Bdf, TypeParam>(rtol)), 100.0) << rtol;
}
#endif

// Of order 2, the error per step held at the tolerance, the sum of the errors falls with its power 2/3 only: measured
// up to 2.5, 12 and 55 times the tolerance for rosenbrock23, up to 18, 170 and 820 times for tr-bdf2.
TYPED_TEST(Stiff, MethodsOfOrderTwoFollowTheTolerance) {
  for (const double rtol : {1e-3, 1e-5, 1e-7}) {
    const double sum = std::pow(1e-3 / rtol, 1.0 / 3.0);
    EXPECT_LT((solved<Rosenbrock23, TypeParam>(rtol)), 5.0 * sum) << rtol;
    EXPECT_LT((solved<TrBdf2, TypeParam>(rtol)), 40.0 * sum) << rtol;
  }
}

// Without damping it suits where nothing stiff is left over: not Robertson's reactions, over so long a time.
TEST(StiffTrapezoid, FollowsTheTolerance) {
  for (const double rtol : {1e-3, 1e-5, 1e-7}) {
    const double sum = std::pow(1e-3 / rtol, 1.0 / 3.0);
    EXPECT_LT((solved<Trapezoid, VanDerPol>(rtol)), 60.0 * sum) << rtol;
    EXPECT_LT((solved<Trapezoid, Hires>(rtol)), 60.0 * sum) << rtol;
  }
}

TEST(StiffRobertson, AmountOfAllSubstancesStays) {
  SolveOptions options;
  options.rtol = 1e-6;
  options.atol = 1e-20;
  const auto trajectory = solve<Rodas5p>(Robertson(), 0.0, Robertson::start(), Robertson::end_time(), options);
  // a linear invariant: rounding alone, of 340 steps
  for (const auto& segment : trajectory.segments) ASSERT_NEAR(segment.state(segment.t1()).sum(), 1.0, 1e-13);
}

/// A scene of states alone.
std::string scene(const std::vector<std::string>& rates, const std::vector<double>& start, double end,
                  const std::string& method) {
  std::string text = "[time]\nend = " + test::number(end) + "\n[method]\n" + method;
  for (std::size_t i = 0; i < rates.size(); ++i)
    text += "[[state]]\nname = \"y" + std::to_string(i + 1) + "\"\nvalue = " + test::number(start[i]) + "\nrate = \"" +
            rates[i] + "\"\n";
  return text;
}

template <class Problem>
void expect_scene_to_end(const std::vector<std::string>& rates, const std::string& method, double rtol, double factor) {
  const typename Problem::State start = Problem::start();
  const std::string lines = "name = \"" + method + "\"\nrtol = " + test::number(rtol) +
                            "\natol = " + test::number(kScale<Problem> * rtol) + "\n";
  const RunResult result =
      test::run_text(scene(rates, {start.data(), start.data() + start.size()}, Problem::end_time(), lines));
  EXPECT_EQ(result.status, RunStatus::finished) << method;
  typename Problem::State end;
  for (int i = 0; i < Problem::kDimension; ++i) end[i] = test::state_of(result, "y" + std::to_string(i + 1));
  EXPECT_LT(error_over_tolerance<Problem>(end, rtol), factor) << method;
}

template <class Problem>
void expect_every_method_to_end(const std::vector<std::string>& rates) {
  expect_scene_to_end<Problem>(rates, "rodas5p", 1e-8, 2.0);
  expect_scene_to_end<Problem>(rates, "ode23s", 1e-4, 20.0);
  expect_scene_to_end<Problem>(rates, "ode23tb", 1e-4, 100.0);
#ifdef TRAJET_WITH_SUNDIALS
  expect_scene_to_end<Problem>(rates, "ode15s", 1e-8, 100.0);
#endif
}

TEST(StiffScenes, Robertson) {
  expect_every_method_to_end<Robertson>({"-0.04*y1 + 1e4*y2*y3", "0.04*y1 - 1e4*y2*y3 - 3e7*y2^2", "3e7*y2^2"});
}

TEST(StiffScenes, VanDerPol) { expect_every_method_to_end<VanDerPol>({"y2", "1000*(1 - y1^2)*y2 - y1"}); }

TEST(StiffScenes, Hires) {
  expect_every_method_to_end<Hires>(
      {"-1.71*y1 + 0.43*y2 + 8.32*y3 + 0.0007", "1.71*y1 - 8.75*y2", "-10.03*y3 + 0.43*y4 + 0.035*y5",
       "8.32*y2 + 1.71*y3 - 1.12*y4", "-1.745*y5 + 0.43*y6 + 0.43*y7",
       "-280*y6*y8 + 0.69*y4 + 1.71*y5 - 0.43*y6 + 0.69*y7", "280*y6*y8 - 1.81*y7", "-280*y6*y8 + 1.81*y7"});
}

/// A ball that falls on the ground and back, with a heat that follows its height within a microsecond.
constexpr const char* kBouncingBall = R"toml(
[time]
end = 1
[[state]]
name = "heat"
value = 1
rate = "-1e6*(heat - ball.z)"
[[body]]
name = "ball"
position = [0, 0, 1]
acceleration = [0, 0, -9.81]
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
restitution = 1
)toml";

TEST(StiffScenes, AStiffBodyBounces) {
  for (const std::string method : {"rodas5p", "rosenbrock23", "tr-bdf2", "trapezoid", "gauss6", "bdf"}) {
#ifndef TRAJET_WITH_SUNDIALS
    if (method == "bdf") continue;
#endif
    const std::string lines = "[method]\nrtol = 1e-6\natol = 1e-6\nstep = 0.01\nname = \"" + method + "\"\n";
    const RunResult result = test::run_text(lines + kBouncingBall);
    EXPECT_EQ(result.status, RunStatus::finished) << method;
    ASSERT_EQ(result.impacts.size(), 1u) << method;
    EXPECT_NEAR(result.impacts[0].time, std::sqrt(2.0 / 9.81), 1e-5) << method;
    EXPECT_NEAR(test::state_of(result, "heat"), test::final_of(result, "ball").position[2], 1e-4) << method;
  }
}

}  // namespace
}  // namespace trajet
