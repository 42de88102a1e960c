// Problems with published end values, written as scenes, by every error-controlled method that takes them.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene_run.hpp"

namespace trajet::test {
namespace {

struct SceneState {
  std::string name, value, rate;
};

/// A problem from t = 0. `digits`: what is left of the published ones' rounding and of the run's own; `amplification`:
/// by how much errors on the way have grown at the end, measured with the methods here and rounded up.
struct PublishedProblem {
  std::string name;
  std::string parameters;
  std::vector<SceneState> states;
  double end_time;
  std::vector<double> end;
  double digits = 2e-14;
  double amplification = 200.0;
};

constexpr double kDegree = std::numbers::pi / 180.0;

/// The sources stand in problems/: detest.hpp, lotka_volterra.hpp, two_body.hpp, arenstorf.hpp, euler_tops.hpp.
const std::vector<PublishedProblem>& problems() {
  const std::string pull_x = "-x/(x^2 + y^2)^1.5", pull_y = "-y/(x^2 + y^2)^1.5";
  const std::vector<SceneState> top = {
      {"w1", "a1", "(I2 - I3)/I1*w2*w3"}, {"w2", "a2", "(I3 - I1)/I2*w3*w1"}, {"w3", "a3", "(I1 - I2)/I3*w1*w2"}};
  static const std::vector<PublishedProblem> all = {
      {"A1", "", {{"y", "1", "-y"}}, 20, {2.061153353012535e-9}},
      {"A2", "", {{"y", "1", "-y^3/2"}}, 20, {2.182178902359887e-1}},
      {"A3", "", {{"y", "1", "y*cos(t)"}}, 20, {2.491650271850414}},
      {"B1",
       "",
       {{"y1", "1", "2*(y1 - y1*y2)"}, {"y2", "3", "-(y2 - y1*y2)"}},
       20,
       {6.761876008576667e-1, 1.860816099640036e-1},
       2e-14,
       500},
      {"B2",
       "",
       {{"y1", "2", "-y1 + y2"}, {"y2", "0", "y1 - 2*y2 + y3"}, {"y3", "1", "y2 - y3"}},
       20,
       {1.000000001030576, 1.0, 9.999999989694235e-1}},
      {"B5",
       "",
       {{"y1", "0", "y2*y3"}, {"y2", "1", "-y1*y3"}, {"y3", "1", "-0.51*y1*y2"}},
       20,
       {-9.396570798729192e-1, -3.421177754000779e-1, 7.414126596199957e-1}},
      {"D1",
       "",
       {{"x", "0.9", "u"}, {"y", "0", "v"}, {"u", "0", pull_x}, {"v", "sqrt(11/9)", pull_y}},
       20,
       {2.198835352008397e-1, 9.427076846341813e-1, -9.787659841058176e-1, 3.287977990962036e-1},
       3e-14,
       2000},
      {"D3",
       "",
       {{"x", "0.5", "u"}, {"y", "0", "v"}, {"u", "0", pull_x}, {"v", "sqrt(3)", pull_y}},
       20,
       {-5.780432953035361e-1, 8.633840009194193e-1, -9.595083730380727e-1, -6.504915126712089e-2},
       8e-14,
       500},
      {"E1",
       "",
       {{"y1", "0.6713967071418030", "y2"}, {"y2", "0.09540051444747446", "-(y2/(t + 1) + (1 - 0.25/(t + 1)^2)*y1)"}},
       20,
       {1.456723600728308e-1, -9.883500195574063e-2}},
      {"E3",
       "",
       {{"y1", "0", "y2"}, {"y2", "0", "y1^3/6 - y1 + 2*sin(2.78535*t)"}},
       20,
       {-1.004178858647128e-1, 2.411400132095954e-1},
       3e-14},
      {"Arenstorf",
       "m = 0.012277471",
       {{"x", "0.994", "u"},
        {"y", "0", "v"},
        {"u", "0", "x + 2*v - (1 - m)*(x + m)/((x + m)^2 + y^2)^1.5 - m*(x - 1 + m)/((x - 1 + m)^2 + y^2)^1.5"},
        {"v", "-2.00158510637908252240537862224",
         "y - 2*u - (1 - m)*y/((x + m)^2 + y^2)^1.5 - m*y/((x - 1 + m)^2 + y^2)^1.5"}},
       17.0652165601579625588917206249,
       {0.994, 0, 0, -2.00158510637908252240537862224},
       1e-9,
       1e5},
      {"Hipparchus",
       "I1 = 0.375\nI2 = 0.5\nI3 = 0.625\na1 = 5\na2 = 0\na3 = 4",
       top,
       6.861525571809244,
       {5, 0, 4},
       1e-13},
      {"brick",
       "I1 = 0.001894220\nI2 = 0.006211019\nI3 = 0.007194665\na1 = \"10 deg\"\na2 = \"20 deg\"\na3 = \"30 deg\"",
       top,
       30,
       {12.6183907757 * kDegree, -17.3974747619 * kDegree, 31.1195888868 * kDegree},
       1e-11},
  };
  return all;
}

std::string scene(const PublishedProblem& problem, const std::string& method_lines) {
  std::string text = "[parameters]\n" + problem.parameters + "\n[time]\nend = " + number(problem.end_time) +
                     "\n[method]\n" + method_lines;
  for (const SceneState& state : problem.states)
    text +=
        "[[state]]\nname = \"" + state.name + "\"\nvalue = \"" + state.value + "\"\nrate = \"" + state.rate + "\"\n";
  return text;
}

double error(const PublishedProblem& problem, const std::string& method_lines) {
  const RunResult result = run_text(scene(problem, method_lines));
  EXPECT_EQ(result.status, RunStatus::finished) << problem.name << "\n" << method_lines << result.failure;
  double largest = 0.0;
  for (std::size_t i = 0; i < problem.end.size(); ++i)
    largest = std::max(largest, std::abs(state_of(result, problem.states[i].name) - problem.end[i]));
  return largest;
}

TEST(PublishedScenes, TheSeriesMethodReachesTheirDigits) {
  for (const PublishedProblem& problem : problems())
    EXPECT_LT(error(problem, controlled("taylor", 1e-15).lines), problem.digits) << problem.name;
}

TEST(PublishedScenes, PairsReachTheirToleranceTimesTheAmplification) {
  for (const std::string method : {"bs32", "dopri5", "dop853", "taylor"}) {
    for (const double tolerance : {1e-5, 1e-8}) {
      for (const PublishedProblem& problem : problems())
        EXPECT_LT(error(problem, controlled(method, tolerance).lines),
                  problem.amplification * tolerance + problem.digits)
            << problem.name << " by " << method << " at " << tolerance;
    }
  }
}

// Step doubling keeps the relative error of each of its intervals, ten or a hundred of them here.
TEST(PublishedScenes, StepDoublingReachesItsAccuracyTimesTheAmplification) {
  for (const PublishedProblem& problem : problems()) {
    if (problem.name == "Arenstorf") continue;  // passes the moon in less than 1/128 of any convenient interval
    const std::string lines = "name = \"rk4-doubling\"\nrtol = 1e-8\nstep = " + number(problem.end_time / 100) + "\n";
    EXPECT_LT(error(problem, lines), problem.amplification * 1e-8) << problem.name;
  }
}

// 4000 steps: measured up to 5.1e-7 for D3, which is fast where it is near, and 3e-8 elsewhere.
TEST(PublishedScenes, MethodsOfOrderFourWithFixedSteps) {
  for (const std::string method : {"rk4", "rk4-3/8", "series"}) {
    for (const PublishedProblem& problem : problems()) {
      if (problem.name == "Arenstorf") continue;  // the moon again
      EXPECT_LT(error(problem, fixed(method, problem.end_time / 4000).lines), problem.name == "D3" ? 1e-6 : 1e-7)
          << problem.name << " by " << method;
    }
  }
}

// The orbits are motions of a body, too: with forces of position alone.
TEST(PublishedScenes, AnOrbitAsABody) {
  const std::string text = R"(
[time]
end = 20
[method]
name = "METHOD"
step = 0.001
rtol = 1e-13
atol = 1e-13
[[body]]
name = "planet"
position = [0.5, 0, 0]
velocity = [0, "3^0.5", 0]
acceleration = "-r/norm(r)^3"
)";
  const Vector3 position(-5.780432953035361e-1, 8.633840009194193e-1, 0.0);
  const auto error_of = [&](const std::string& method) {
    std::string scene = text;
    scene.replace(scene.find("METHOD"), 6, method);
    return (final_of(run_text(scene), "planet").position - position).norm();
  };
  EXPECT_LT(error_of("taylor"), 1e-11);
  EXPECT_LT(error_of("dop853"), 1e-10);
  EXPECT_LT(error_of("rk4"), 1e-8);
  EXPECT_LT(error_of("velocity-verlet"), 1e-3);
}

}  // namespace
}  // namespace trajet::test
