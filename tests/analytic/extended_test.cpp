// Motions that amplify rounding, solved in extended precision.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "problems/free_top.hpp"
#include "problems/kepler.hpp"
#include "scene_run.hpp"

namespace trajet::test {
namespace {

struct SceneState {
  const char* name;
  const char* value;
  const char* rate;
};

/// The largest error at the end of a system of `[[state]]` from time 0.
template <std::size_t N, class State>
double error_at_end(const SceneState (&states)[N], const State& end, double end_time, const Way& way) {
  std::string text = "[time]\nend = " + number(end_time) + "\n[method]\n" + way.lines;
  for (const SceneState& state : states)
    text += std::string("[[state]]\nname = \"") + state.name + "\"\nvalue = \"" + state.value + "\"\nrate = \"" +
            state.rate + "\"\n";
  const RunResult result = run_text(text);
  double error = 0.0;
  for (std::size_t i = 0; i < N; ++i)
    error = std::max(error, std::abs(state_of(result, states[i].name) - end[static_cast<Eigen::Index>(i)]));
  return error;
}

constexpr double kTolerance = 1e-17;

TEST(TaylorExtended, FreeTopKeepsItsDigits) {
  using problems::FreeTop;
  const SceneState states[] = {{"q0", "1", "-(q1*w1 + q2*w2 + q3*w3)/2"},
                               {"q1", "0", "(q0*w1 + q2*w3 - q3*w2)/2"},
                               {"q2", "0", "(q0*w2 + q3*w1 - q1*w3)/2"},
                               {"q3", "0", "(q0*w3 + q1*w2 - q2*w1)/2"},
                               {"w1", "0.01", "-w2*w3"},
                               {"w2", "3", "w3*w1"},
                               {"w3", "0.02", "-w1*w2/3"}};
  const auto error = [&](const char* method) {
    return error_at_end(states, FreeTop::reference_end(), FreeTop::end_time(), controlled(method, kTolerance));
  };
  // The top makes the rounding of a step 1e5 times as large: 1e-11 of the 1e-16 of a double, 1e-14 of the 5e-20 here.
  // Measured: 1.2e-14.
  EXPECT_LT(error("taylor-extended"), 5e-14);
  if (std::numeric_limits<long double>::digits > std::numeric_limits<double>::digits) {
    EXPECT_GT(error("taylor"), 1e-13);
  }
}

TEST(TaylorExtended, LorenzsConstantsAreExtendedToo) {
  // Reference: Taylor series of order 36 in 60 digits, steps of 0.02 and 0.015 agree to 19 digits at t = 30.
  const SceneState states[] = {{"x", "1", "10*(y - x)"}, {"y", "1", "x*(28 - z) - y"}, {"z", "1", "x*y - 8/3*z"}};
  const Eigen::Vector3d end(7.394985523949071346, 2.051642562928770061, 31.76107506496638549);
  const auto error = [&](const char* method) { return error_at_end(states, end, 30.0, controlled(method, 1e-18)); };
  if (std::numeric_limits<long double>::digits > std::numeric_limits<double>::digits) {
    // rounding grows by e^(0.9 t) = 5e11: with an 8/3 in double, 5e-8 are left
    EXPECT_LT(error("taylor-extended"), 1e-9);
    EXPECT_GT(error("taylor"), 1e-8);
  }
}

TEST(TaylorExtended, OrbitKeepsItsDigits) {
  using problems::Kepler;
  const SceneState states[] = {
      {"u", "0", "-x/(x^2 + y^2)^1.5"}, {"v", "2", "-y/(x^2 + y^2)^1.5"}, {"x", "0.4", "u"}, {"y", "0", "v"}};
  const auto error = [&](const char* method) {
    return error_at_end(states, Kepler::reference_end(), Kepler::end_time(), controlled(method, kTolerance));
  };
  EXPECT_LT(error("taylor-extended"), 1e-14);  // measured: 2e-15
  if (std::numeric_limits<long double>::digits > std::numeric_limits<double>::digits) {
    EXPECT_GT(error("taylor"), 1e-14);  // measured: 2e-14 to 3e-13, with how its sums are rounded
  }
}

}  // namespace
}  // namespace trajet::test
