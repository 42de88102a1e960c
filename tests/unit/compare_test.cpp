#include "trajet/study/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene_run.hpp"

namespace trajet {
namespace {

ComparePlan plan(std::vector<std::string> methods, std::vector<long> steps, std::vector<double> rtols,
                 std::string reference = "") {
  ComparePlan plan;
  plan.methods = std::move(methods);
  plan.step_counts = std::move(steps);
  plan.rtols.assign(rtols.begin(), rtols.end());
  plan.reference = std::move(reference);
  return plan;
}

Comparison compare_text(const std::string& text, const ComparePlan& plan, CompareObserver* observer = nullptr) {
  return compare(parse_scene(text, "test.toml"), plan, observer);
}

/// F44-F49: what the course compares, and the numbers that its own code gives for the largest error over the nodes.
TEST(Compare, GivesTheErrorsOfTheCoursesExample) {
  const Scene scene = read_scene(TRAJET_SOURCE_DIR "/examples/notes/drag_3d.toml");
  for (const char* reference : {"exact", "dopri5", "rk4"}) {
    const Comparison comparison = compare(scene, plan({"euler", "rk4"}, {10, 40}, {}, reference));
    ASSERT_EQ(comparison.rows.size(), 4u);
    const double published[] = {1.39789527279837, 0.0702641221366347, 0.0542477931734899, 7.53983131197348e-5};
    // The numbers have 15 digits. A computed reference adds its own error: dopri5's is some 1e-12 at rtol 1e-13, that
    // of rk4 with 640 steps 1e-9 (7.5e-5 / 16^4).
    const double tolerance = reference[0] == 'e' ? 5e-15 : reference[0] == 'd' ? 1e-11 : 3e-9;
    for (std::size_t i = 0; i < 4; ++i) {
      const ComparisonRow& row = comparison.rows[i];
      EXPECT_EQ(row.method, i < 2 ? "euler" : "rk4");
      EXPECT_EQ(row.step, i % 2 == 0 ? 1.0 : 0.25);
      EXPECT_EQ(row.statistics.steps, i % 2 == 0 ? 10 : 40);
      EXPECT_NEAR(*row.at_nodes.state, published[i], tolerance) << reference;
      EXPECT_EQ(row.compared_until, 10.0);
    }
    EXPECT_EQ(comparison.reference_name, reference);
  }
}

// Under the constant acceleration 1, Euler's velocity is exact, and its position at node n is short by n dt^2/2. From
// there it goes straight: a time s behind the node it is short by s^2/2 more.
TEST(Compare, TellsEndSamplesAndNodesApart) {
  const std::string scene =
      "[time]\nend = 2\nsample = 1.5\n[[body]]\nname = \"b\"\nacceleration = [1, 0, 0]\n"
      "[exact]\nb.r = [\"t^2/2\", 0, 0]\nb.v = [\"t\", 0, 0]\n";
  const Comparison comparison = compare_text(scene, plan({"euler"}, {2}, {}));
  const ComparisonRow& row = comparison.rows.at(0);
  EXPECT_NEAR(*row.at_end.state, 1.0, 1e-15);
  EXPECT_NEAR(*row.at_nodes.position, 1.0, 1e-15);
  EXPECT_NEAR(*row.at_samples.position, 0.5 + 0.5 * 0.5 / 2, 1e-15);
  EXPECT_NEAR(*row.at_samples.state, 0.5 + 0.5 * 0.5 / 2, 1e-15);
  EXPECT_EQ(comparison.components, (std::vector<std::string>{"b.r", "b.v"}));
}

TEST(Compare, MeasuresOnlyWhatTheClosedFormGives) {
  const std::string scene =
      "[time]\nend = 2\n[[body]]\nname = \"b\"\nacceleration = [1, 0, 0]\n"
      "[[state]]\nname = \"s\"\nvalue = 1\nrate = \"-s\"\n";
  const auto row = [&](const std::string& exact) {
    return compare_text(scene + "[exact]\n" + exact, plan({"euler"}, {2}, {})).rows.at(0);
  };
  EXPECT_NEAR(*row("b.v = [\"t\", 0, 0]\n").at_end.state, 0.0, 1e-15);
  EXPECT_FALSE(row("b.v = [\"t\", 0, 0]\n").at_end.position);
  EXPECT_NEAR(*row("s = \"exp(-t)\"\n").at_end.state, std::exp(-2.0), 1e-15);  // (1 - dt)^2 = 0
  const Comparison all = compare_text(scene, plan({"euler"}, {2}, {}));
  EXPECT_EQ(all.components, (std::vector<std::string>{"b.r", "b.v", "s"}));
  EXPECT_NEAR(*all.rows.at(0).at_end.state, 1.0, 1e-12);
}

const char* const kBouncingBall =
    "[time]\nend = 1\n[[body]]\nname = \"b\"\nposition = [0, 0, 1]\nacceleration = [0, 0, -9.81]\n"
    "[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\non_hit = \"bounce\"\n";

TEST(Compare, ClosedFormsHoldUpToTheFirstBounceMethodsBeyond) {
  const std::string exact = "[exact]\nb.r = [0, 0, \"1 - 9.81*t^2/2\"]\n";
  const ComparisonRow closed = compare_text(kBouncingBall + exact, plan({"rk4"}, {7}, {})).rows.at(0);
  EXPECT_NEAR(closed.compared_until, 0.451523640985731, 1e-14);
  EXPECT_EQ(closed.elapsed, 1.0);
  EXPECT_EQ(closed.impacts, 1u);
  EXPECT_LT(*closed.at_samples.position, 1e-14);  // rounding: the motion is a parabola
  const Comparison beyond = compare_text(kBouncingBall, plan({"rk4"}, {7}, {}));
  EXPECT_EQ(beyond.rows.at(0).compared_until, 1.0);
  EXPECT_LT(*beyond.rows.at(0).at_end.state, 1e-13);
}

TEST(Compare, EndsWithTheEarlierOfTwoStops) {
  std::string scene = kBouncingBall;
  scene.replace(scene.find("bounce"), 6, "stop");
  const ComparisonRow euler = compare_text(scene, plan({"euler"}, {50}, {}, "taylor")).rows.at(0);
  EXPECT_GT(euler.elapsed, 0.4515236410);  // Euler falls late
  EXPECT_NEAR(euler.compared_until, 0.451523640985731, 1e-14);
  EXPECT_GT(*euler.at_end.position, 0.03);
}

TEST(Compare, RunsBackwardInTime) {
  const Comparison comparison = compare_text(
      "[time]\nstart = 1\nend = -1\n[[state]]\nname = \"s\"\nvalue = 1\nrate = \"s\"\n[exact]\ns = \"exp(t - 1)\"\n",
      plan({"rk4", "taylor"}, {64}, {1e-9}));
  EXPECT_EQ(comparison.rows.at(0).compared_until, -2.0);  // s since the start
  // an error of h^4/120 of the solution for each second, to first order in h: s exp(-s) h^4/120 after s seconds, the
  // largest after one
  const double h = 2.0 / 64;
  const double expected = std::pow(h, 4) / 120 * std::exp(-1.0);
  EXPECT_NEAR(*comparison.rows.at(0).at_samples.state, expected, h * expected);
  EXPECT_LT(*comparison.rows.at(1).at_samples.state, 1e-9);
}

TEST(Compare, ARowSaysWhyAMethodFailsAndTheOthersGoOn) {
  // y' = y^2 from 1 is infinite at t = 1; steps of 1 and more go past it without noticing
  const std::string scene =
      "[time]\nend = 2\n[[state]]\nname = \"y\"\nvalue = 1\nrate = \"y^2\"\n[exact]\ny = \"1/(1 - t)\"\n";
  EXPECT_THROW(compare_text(scene, plan({"euler"}, {2}, {})), ReferenceError);  // at the sample t = 1
  const std::string until = "[time]\nend = 0.99\n" + scene.substr(scene.find("[[state]]"));
  ComparePlan tried = plan({"taylor", "euler"}, {5}, {1e-6});
  Scene limited = parse_scene(until, "test.toml");
  limited.method.max_steps = 5;
  const Comparison comparison = compare(limited, tried);
  ASSERT_EQ(comparison.rows.size(), 2u);
  EXPECT_EQ(comparison.rows[0].status, RunStatus::failed);
  EXPECT_NE(comparison.rows[0].failure.find("max_steps"), std::string::npos) << comparison.rows[0].failure;
  EXPECT_FALSE(comparison.rows[0].at_end.state);
  EXPECT_TRUE(comparison.rows[1].succeeded());
}

TEST(Compare, TheReferenceIsAMethodThatIsNotCompared) {
  const std::string scene = "[time]\nend = 1\n[[state]]\nname = \"y\"\nvalue = 1\nrate = \"-y\"\n";
  EXPECT_EQ(compare_text(scene, plan({"rk4"}, {4}, {})).reference_name, "taylor");
  const std::string other = compare_text(scene, plan({"rk4", "taylor"}, {4}, {1e-6})).reference_name;
  EXPECT_NE(other, "taylor");
  EXPECT_EQ(find_method(other)->control, StepControl::adaptive);
  EXPECT_FALSE(compare_text(scene, plan({}, {4}, {1e-6})).reference_name.empty());
}

TEST(Compare, WhatTheSceneSaysOfStepsAndTolerancesIsTheDefault) {
  const std::string scene =
      "[time]\nend = 1\n[method]\nname = \"rk4\"\nstep = 0.125\nrtol = 1e-5\n"
      "[[state]]\nname = \"y\"\nvalue = 1\nrate = \"-y\"\n";
  const Comparison comparison = compare_text(scene, plan({"rk4", "dopri5"}, {}, {}));
  ASSERT_EQ(comparison.rows.size(), 2u);
  EXPECT_EQ(comparison.rows[0].step, 0.125);
  EXPECT_EQ(comparison.rows[1].rtol, 1e-5);
  EXPECT_EQ(comparison.rows[1].atol, 1e-5);
}

TEST(Compare, RefusesWhatIsWrong) {
  const std::string scene = "[time]\nend = 1\n[[state]]\nname = \"y\"\nvalue = 1\nrate = \"-y\"\n";
  const auto message = [&](const std::string& text, const ComparePlan& plan) -> std::string {
    try {
      compare_text(text, plan);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(scene, plan({"rk44"}, {}, {})).find("did you mean 'rk4'"), std::string::npos);
  EXPECT_NE(message(scene, plan({"rk4"}, {}, {}, "exact")).find("[exact]"), std::string::npos);
  EXPECT_NE(message(scene, plan({"rk4"}, {}, {}, "taylr")).find("did you mean 'taylor'"), std::string::npos);
  EXPECT_NE(message(scene + "[exact]\ny = \"1/t\"\n", plan({"rk4"}, {}, {})).find("test.toml:8:1"), std::string::npos);
  EXPECT_NE(message(scene + "[exact]\ny = \"1/k\"\n", plan({"rk4"}, {}, {})).find("test.toml:8:8"), std::string::npos);
  EXPECT_EQ(message(scene, plan({"rk4"}, {4}, {})), "");
  const Comparison elsewhere = compare_text(scene + "[exact]\ny = \"2*exp(-t)\"\n", plan({"rk4"}, {4}, {}));
  ASSERT_EQ(elsewhere.warnings.size(), 1u);
  EXPECT_NE(elsewhere.warnings[0].find("'y'"), std::string::npos);
}

TEST(Compare, IsInterruptedWithTheRowsSoFar) {
  struct Impatient : RunObserver {
    bool interrupted(double) override { return true; }
  };
  struct Observer : CompareObserver {
    RunObserver* begin_row(const ComparisonRow& row, std::size_t, std::size_t count) override {
      EXPECT_EQ(count, 3u);
      return row.method == "rk4" ? &impatient : nullptr;
    }
    Impatient impatient;
  } observer;
  const std::string scene = "[time]\nend = 1\n[[state]]\nname = \"y\"\nvalue = 1\nrate = \"-y\"\n";
  const Comparison comparison = compare_text(scene, plan({"euler", "rk4", "midpoint"}, {4}, {}), &observer);
  EXPECT_TRUE(comparison.interrupted);
  ASSERT_EQ(comparison.rows.size(), 1u);
  EXPECT_EQ(comparison.rows[0].method, "euler");
}

}  // namespace
}  // namespace trajet
