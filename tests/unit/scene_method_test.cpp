// The methods as scenes choose them: what suits which law, orders, steps, warnings.

#include <gtest/gtest.h>

#include <cmath>

#include "scene_run.hpp"
#include "trajet/ode/registry.hpp"

namespace trajet::test {
namespace {

std::string message_of(const std::string& text) {
  try {
    run_text(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string ball_scene(const std::string& method_lines, const std::string& law) {
  return "[time]\nend = 10\n[method]\n" + method_lines +
         "[[body]]\nname = \"ball\"\nposition = [0, 0, 1]\nvelocity = [2, 1, 0]\n" + law + "\n";
}

TEST(SceneMethod, ALawThatIsNotOfTimeAloneIsRefusedAtItsFormula) {
  for (const std::string method : {"difference-linear", "difference-quadratic", "quadrature"}) {
    const std::string lines = "name = \"" + method + "\"\nstep = 1\n";
    EXPECT_EQ(message_of(ball_scene(lines, "acceleration = \"-v*norm(v)\"")),
              "test.toml:10:17: error: method '" + method +
                  "' cannot integrate this: the acceleration of body 'ball' depends on the motion that it causes, not "
                  "on t alone");
    EXPECT_EQ(
        message_of(ball_scene(lines, "force = \"-r\"\nmass = 2")),
        "test.toml:10:10: error: method '" + method +
            "' cannot integrate this: the force of body 'ball' depends on the motion that it causes, not on t alone");
    EXPECT_EQ(
        message_of(ball_scene(lines, "[[state]]\nname = \"heat\"\nvalue = 1\nrate = \"-heat\"")),
        "test.toml:13:9: error: method '" + method +
            "' cannot integrate this: the rate of state 'heat' depends on the motion that it causes, not on t alone");
  }
}

TEST(SceneMethod, VerletRefusesForcesThatDependOnVelocities) {
  const std::string message = message_of(ball_scene("name = \"verlet\"\nstep = 1\n", "acceleration = \"-v\""));
  EXPECT_EQ(
      message.find("test.toml:10:17: error: method 'velocity-verlet' cannot integrate this: the acceleration of body "
                   "'ball' depends on its own half of the state"),
      0u)
      << message;
}

TEST(SceneMethod, AnOrderIsForMethodsThatTakeOne) {
  EXPECT_EQ(message_of(ball_scene("name = \"rk4\"\nstep = 1\norder = 3\n", "")),
            "test.toml:6:9: error: method 'rk4' has an order of its own: [method] order does not go with it");
  EXPECT_EQ(message_of(ball_scene("name = \"series\"\nstep = 1\norder = 40\n", "")),
            "test.toml:6:9: error: method 'series' takes an order of at most 25");
}

// Erratum A1, as scenes: 171 with five steps, 176 with steps of 1, 2, 3 and 4 s, the exact 503/3 by the other formula.
TEST(SceneMethod, TheCoursesSchemesGiveTheCoursesNumbers) {
  const std::string law = "acceleration = [0, 0, \"t\"]";
  const auto height = [&](const std::string& lines) {
    return final_of(run_text(ball_scene(lines, law)), "ball").position.z();
  };
  EXPECT_NEAR(height("name = \"difference-linear\"\nstep = 2\n"), 171.0, 1e-13);
  EXPECT_NEAR(height("name = \"difference-linear\"\nstep = 0.5\n"), 167.875, 1e-13);
  EXPECT_NEAR(height("name = \"difference-linear\"\nsteps = [1, 2, 3, 4]\n"), 176.0, 1e-13);
  EXPECT_NEAR(height("name = \"difference-quadratic\"\nsteps = [1, 2, 3, 4]\n"), 503.0 / 3.0, 1e-13);
  EXPECT_NEAR(height("name = \"quadrature\"\n"), 503.0 / 3.0, 1e-12);
  EXPECT_NEAR(height("name = \"series\"\nstep = 10\norder = 3\n"), 503.0 / 3.0, 1e-13);
  EXPECT_NEAR(height("name = \"series\"\nstep = 10\norder = 2\n"), 1.0, 1e-13);
}

constexpr const char* kDragScene = R"(
[time]
end = 10
[method]
name = "SEDRK4c"
step = 1
rtol = RTOL
[[body]]
name = "p"
velocity = [1, 1, 1]
acceleration = ["-vx^2/2", "-vy^2", "-vz^2/3"]
)";

RunResult run_doubling(const std::string& rtol) {
  std::string text = kDragScene;
  text.replace(text.find("RTOL"), 4, rtol);
  return run_text(text);
}

TEST(SceneMethod, StepDoublingReportsItsWorkAndWarns) {
  EXPECT_EQ(run_doubling("1e-3").statistics.law_evaluations, 136);
  EXPECT_EQ(run_doubling("1e-6").statistics.law_evaluations, 584);
  const RunResult fine = run_doubling("1e-9");
  EXPECT_EQ(fine.statistics.law_evaluations, 2840);
  EXPECT_TRUE(fine.warnings.empty());
  EXPECT_GT(fine.statistics.proposed_step, 0.0);
  const RunResult capped = run_doubling("1e-12");
  EXPECT_EQ(capped.status, RunStatus::finished);
  ASSERT_EQ(capped.warnings.size(), 1u);
  EXPECT_EQ(capped.warnings[0].find("rk4-doubling: 3 intervals, the first from t = 0 s"), 0u) << capped.warnings[0];
}

/// Hears how long the longest step is.
class LongestStep : public RunObserver {
 public:
  RunWishes wishes() const override { return {.motion = true}; }
  void motion(const MotionPiece& piece) override {
    longest = std::max(longest, std::abs(piece.segment.duration()));
    ++count;
  }

  double longest = 0.0;  // s
  int count = 0;
};

// The law's solution is a polynomial, which taylor takes in one step, and nothing makes the others shorten theirs.
TEST(SceneMethod, NoStepOfAnyMethodIsLongerThanMaxStep) {
  for (const MethodInfo& method : methods()) {
    for (const std::string time : {"end = 10\n", "start = 10\nend = 0\n"}) {
      const std::string lines = "name = \"" + std::string(method.name) + "\"\nrtol = 1e-6\natol = 1e-6\n" +
                                (method.needs_step() ? "step = 0.07\n" : "");
      const auto longest_with = [&](const std::string& more) {
        LongestStep steps;
        const RunResult result = run_text("[time]\n" + time + "[method]\n" + lines + more +
                                              "[[body]]\nname = \"ball\"\nacceleration = [0, 0, \"t/10\"]\n",
                                          &steps);
        EXPECT_EQ(result.status, RunStatus::finished) << method.name << ": " << result.failure;
        EXPECT_NEAR(std::abs(final_of(result, "ball").position.z()), time[0] == 'e' ? 100.0 / 6.0 : 100.0 / 3.0, 0.7)
            << method.name;
        return steps.longest;
      };
      EXPECT_LE(longest_with("max_step = 0.07\n"), 0.07 * (1.0 + 1e-9)) << method.name;
      if (!method.needs_step()) {
        EXPECT_GT(longest_with(""), 0.07) << method.name;
      }
    }
  }
}

// Unequal steps that do not fill the time of the run: what is left is divided too.
TEST(SceneMethod, MaxStepDividesWhatGivenStepsLeaveOver) {
  LongestStep steps;
  run_text(ball_scene("name = \"rk4\"\nsteps = [0.1, 0.3]\nmax_step = 0.3\n", ""), &steps);
  EXPECT_LE(steps.longest, 0.3 * (1.0 + 1e-9));
  EXPECT_EQ(steps.count, 34);
}

// A ball that comes to rest has another law from then on, which is still of time alone and of two halves.
TEST(SceneMethod, BodiesComeToRestUnderEveryMethod) {
  const std::string ground =
      "[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
      "on_hit = \"bounce\"\nrestitution = 0.5\n";
  for (const MethodInfo& method : methods()) {
    if (method.name == "euler") continue;  // straight lines gain height at every bounce
    const std::string lines =
        "name = \"" + std::string(method.name) + "\"\n" + (method.needs_step() ? "step = 0.01\n" : "");
    const RunResult result = run_text(ball_scene(lines, "acceleration = [0, 0, -9.8]\n" + ground));
    EXPECT_EQ(result.status, RunStatus::finished) << method.name << ": " << result.failure;
    EXPECT_EQ(impacts_of(result, ImpactKind::rest).size(), 1u) << method.name;
    EXPECT_NEAR(final_of(result, "ball").position.x(), 20.0, 1e-9) << method.name;
  }
}

}  // namespace
}  // namespace trajet::test
