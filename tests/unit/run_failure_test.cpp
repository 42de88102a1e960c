// Runs that cannot go on: what was computed is kept, and the result says where and why.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::run_text;
using test::Way;

std::vector<Way> ways() {
  return {{"taylor", "name = \"taylor\"\n"}, {"dopri5", "name = \"dopri5\"\n"}, test::fixed("rk4", 0.05)};
}

class Log : public RunObserver {
 public:
  void sample(const Sample& sample) override { samples.push_back(sample); }
  void motion(const MotionPiece& piece) override { moved_until = piece.to; }
  bool interrupted(double time) override { return time > stop_at; }
  std::vector<Sample> samples;
  double moved_until = 0.0;
  double stop_at = std::numeric_limits<double>::infinity();
};

const std::string kBall = R"(
[[body]]
name = "ball"
position = [0, 0, 1]
acceleration = [0, 0, -9.8]
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
)";

TEST(RunFailure, TooManyStepsKeepsWhatWasComputed) {
  for (const Way& way : ways()) {
    Log log;
    const RunResult result =
        run_text("[time]\nend = 1000\nsample = 0.1\n[method]\nmax_steps = 200\n" + way.lines + kBall, &log);
    SCOPED_TRACE(way.name);
    EXPECT_EQ(result.status, RunStatus::failed);
    EXPECT_NE(result.failure.find("max_steps = 200"), std::string::npos) << result.failure;
    EXPECT_GT(result.end_time, 5.0);
    EXPECT_LT(result.end_time, 1000.0);
    EXPECT_GE(result.impacts.size(), 5u);
    EXPECT_EQ(result.final.time, result.end_time);
    EXPECT_EQ(log.samples.back().time, result.end_time);
    EXPECT_GE(log.samples.size(), static_cast<std::size_t>(result.end_time / 0.1));
    EXPECT_TRUE(std::isfinite(test::final_of(result, "ball").position.z()));
  }
}

TEST(RunFailure, ASolutionThatBlowsUpFailsWhereItDoes) {
  // dv/dt = v^2 from 1: infinite at t = 1
  for (const char* method : {"taylor", "dopri5"}) {
    Log log;
    const RunResult result =
        run_text(std::string("[time]\nend = 2\nsample = 0.01\n[method]\nmax_steps = 20000\nname = \"") + method +
                     "\"\n[[state]]\nname = \"v\"\nvalue = 1\nrate = \"v^2\"\n",
                 &log);
    SCOPED_TRACE(method);
    EXPECT_EQ(result.status, RunStatus::failed);
    EXPECT_FALSE(result.failure.empty());
    EXPECT_NEAR(result.end_time, 1.0, 1e-6);
    for (const Sample& sample : log.samples) {
      if (sample.time >= 0.95) continue;
      EXPECT_NEAR(sample.states[0].value, 1.0 / (1.0 - sample.time), 1e-8);
    }
  }
}

TEST(RunFailure, AFixedStepThatOverflowsFails) {
  const RunResult result = run_text(R"(
[time]
end = 100
[method]
name = "rk4"
step = 0.25
[[state]]
name = "v"
value = 1
rate = "v^2"
)");
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_GT(result.end_time, 0.9);
  EXPECT_LT(result.end_time, 10.0);
  EXPECT_TRUE(std::isfinite(test::state_of(result, "v")));
}

TEST(RunFailure, ALawThatIsNotFiniteAtTheStart) {
  for (const Way& way : ways()) {
    const RunResult result =
        run_text("[time]\nend = 1\n[method]\n" + way.lines + "[[state]]\nname = \"x\"\nvalue = 0\nrate = \"1/x\"\n");
    EXPECT_EQ(result.status, RunStatus::failed) << way.name;
    EXPECT_EQ(result.end_time, 0.0) << way.name;
    EXPECT_EQ(test::state_of(result, "x"), 0.0) << way.name;
  }
}

std::string failure_of(const std::string& text) {
  const RunResult result = run_text(text);
  EXPECT_EQ(result.status, RunStatus::failed) << text;
  return result.failure;
}

TEST(RunFailure, SaysWhichFormulaIsNotFiniteAndOfWhat) {
  for (const Way& way : ways()) {
    SCOPED_TRACE(way.name);
    const std::string head = "[time]\nend = 2\n[method]\n" + way.lines;
    const std::string at_rest = failure_of(head +
                                           "[[body]]\nname = \"cart\"\nposition = [1, 2, 3]\nacceleration = "
                                           "\"unit(v) - [0, 0, k]\"\n[parameters]\nk = 9.5\n");
    EXPECT_NE(at_rest.find("the law is not finite: acceleration of body 'cart' (test.toml:"), std::string::npos)
        << at_rest;
    EXPECT_NE(at_rest.find(":17: unit(v) - [0, 0, k]) is [not-a-number, not-a-number, not-a-number] at t = 0 s, "
                           "where v = [0, 0, 0], k = 9.5"),
              std::string::npos)
        << at_rest;
    // a hole on the way: z falls below 1/2 at t = 0.7
    const std::string on_the_way =
        failure_of(head +
                   "[[body]]\nname = \"stone\"\nposition = [0, 0, 1.2]\nvelocity = [0, 0, -1]\n"
                   "[[state]]\nname = \"depth\"\nvalue = 1\nrate = \"sqrt(stone.z - 0.5)\"\n");
    EXPECT_NE(on_the_way.find("rate of state 'depth' (test.toml:"), std::string::npos) << on_the_way;
    EXPECT_NE(on_the_way.find("sqrt(stone.z - 0.5)) is not-a-number at t = 0.7"), std::string::npos) << on_the_way;
    EXPECT_NE(on_the_way.find("where stone.z = 0.49"), std::string::npos) << on_the_way;
  }
}

TEST(RunFailure, ForceAndMassAreNamedTogether) {
  const std::string failure = failure_of(
      "[time]\nend = 2\n[[state]]\nname = \"fuel\"\nvalue = 1\nrate = -1\n[[body]]\nname = \"rocket\"\n"
      "force = [0, 0, 1]\nmass = \"fuel\"\n");
  EXPECT_NE(failure.find("force of body 'rocket' (test.toml:9:10: [0, 0, 1]) is [0, 0, 1] at t = "), std::string::npos)
      << failure;
  EXPECT_NE(failure.find("mass of body 'rocket' (test.toml:10:9: fuel) is "), std::string::npos) << failure;
}

TEST(RunFailure, ToldApartAreInfinityInFiniteTimeAndAPole) {
  for (const char* method : {"taylor", "taylor-extended", "dopri5", "dop853"}) {
    SCOPED_TRACE(method);
    const std::string head = std::string("[time]\nend = 2\n[method]\nname = \"") + method + "\"\n";
    const std::string blow_up = failure_of(head + "[[state]]\nname = \"v\"\nvalue = 1\nrate = \"v^2\"\n");
    EXPECT_NE(blow_up.find("state 'v' runs to infinity in finite time, near t = "), std::string::npos) << blow_up;
    EXPECT_NE(blow_up.find("rate of state 'v' (test.toml:8:9: v^2) is "), std::string::npos) << blow_up;
    const std::string pole = failure_of(head + "[[state]]\nname = \"v\"\nvalue = 1\nrate = \"1/sqrt(1 - t)\"\n");
    EXPECT_EQ(pole.find("in finite time"), std::string::npos) << pole;
    EXPECT_NE(pole.find("1/sqrt(1 - t)"), std::string::npos) << pole;
  }
}

TEST(RunFailure, StepsThatComeToNothingNameTheFormula) {
  // less than a rounding: no step behind the first ones is short enough
  const std::string demanding = failure_of(
      "[time]\nstart = 1\nend = 3\n[method]\nname = \"dopri5\"\nrtol = 1e-18\natol = 0\n[[body]]\nname = \"b\"\n"
      "position = [1, 2, 3]\nvelocity = [1, 2, 3]\nacceleration = \"-2*r\"\n");
  EXPECT_NE(demanding.find("the step became too small: the rate of the "), std::string::npos) << demanding;
  EXPECT_NE(demanding.find(" of body 'b' changes most: acceleration of body 'b' (test.toml:12:17: -2*r) is [-"),
            std::string::npos)
      << demanding;
}

TEST(RunFailure, ABlowUpJustAtTheEndIsTold) {
  // dv/dt = v^2 from 1: infinite at t = 1, in a scene of the state and in one of a body
  for (const char* method : {"taylor", "taylor-extended", "dopri5", "dop853"}) {
    SCOPED_TRACE(method);
    const std::string head = std::string("[time]\nend = 1\n[method]\nname = \"") + method + "\"\n";
    EXPECT_NE(failure_of(head + "[[state]]\nname = \"v\"\nvalue = 1\nrate = \"v^2\"\n").find("runs to infinity"),
              std::string::npos);
    EXPECT_NE(failure_of(head + "[[body]]\nname = \"b\"\nvelocity = [1, 0, 0]\nacceleration = \"[vx^2, 0, 0]\"\n")
                  .find("runs to infinity"),
              std::string::npos);
    // a steep end is none
    for (const char* rate : {"1e6*t^20", "20*v", "-1e7*(v - 1)", "1/(1.001 - t)"})
      EXPECT_EQ(run_text(head + "max_steps = 100000000\n[[state]]\nname = \"v\"\nvalue = 1\nrate = \"" + rate + "\"\n")
                    .status,
                RunStatus::finished)
          << rate;
  }
  // nor is a pulse that has just begun, from rest
  const RunResult pulse =
      run_text("[time]\nend = 1\n[[state]]\nname = \"v\"\nvalue = 0\nrate = \"where(t > 0.9999999, 1e9, 0)\"\n");
  EXPECT_EQ(pulse.status, RunStatus::finished) << pulse.failure;
  EXPECT_NEAR(test::state_of(pulse, "v"), 100.0, 1e-5);
}

TEST(RunFailure, AnInterruptionKeepsWhatWasComputed) {
  for (const Way& way : ways()) {
    Log log;
    log.stop_at = 7.0;
    const RunResult result = run_text("[time]\nend = 1000\nsample = 0.1\n[method]\n" + way.lines + kBall, &log);
    SCOPED_TRACE(way.name);
    EXPECT_EQ(result.status, RunStatus::interrupted);
    EXPECT_GT(result.end_time, 7.0);
    EXPECT_LT(result.end_time, 8.0);
    EXPECT_EQ(log.samples.back().time, result.end_time);
    EXPECT_EQ(result.final.time, result.end_time);
    EXPECT_EQ(result.impacts.size(), 7u + (result.end_time > 0.45175 + 7 * 0.9035 ? 1u : 0u));
  }
}

TEST(RunFailure, AnInterruptionIsSeenBetweenTheSamplesOfALongStep) {
  for (const Way& way : ways()) {
    Log log;
    log.stop_at = 0.23;  // of a fall until 0.45, by taylor in one step
    const RunResult result = run_text("[time]\nend = 1\nsample = 1e-6\n[method]\n" + way.lines + kBall, &log);
    SCOPED_TRACE(way.name);
    EXPECT_EQ(result.status, RunStatus::interrupted);
    EXPECT_GT(result.end_time, 0.23);
    EXPECT_LT(result.end_time, 0.235);
    EXPECT_EQ(log.samples.back().time, result.end_time);
    EXPECT_EQ(log.moved_until, result.end_time);
    EXPECT_EQ(result.final.time, result.end_time);
    EXPECT_NEAR(test::final_of(result, "ball").position.z(), 1.0 - 4.9 * result.end_time * result.end_time, 1e-12);
    EXPECT_TRUE(result.impacts.empty());
  }
}

TEST(RunFailure, BackwardWithObstaclesIsTheScenesError) {
  try {
    run_text("[time]\nend = -1\n" + kBall);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().line, 2);
  }
}

TEST(RunFailure, NoTimeAtAllIsARunOfOneSample) {
  Log log;
  const RunResult result = run_text("[time]\nstart = 1\nend = 1\n" + kBall, &log);
  EXPECT_EQ(result.status, RunStatus::finished);
  EXPECT_EQ(log.samples.size(), 1u);
  EXPECT_EQ(result.end_time, 1.0);
}

TEST(RunFailure, EndlessBouncesOfSetsRunIntoTheLimit) {
  // Each turn keeps half of the speed: infinitely many before t = 3 sqrt(2/g).
  const RunResult result = run_text(R"(
[time]
end = 10
[method]
max_steps = 500
[[body]]
name = "ball"
position = [0, 0, 1]
acceleration = [0, 0, -9.8]
[[event]]
name = "bounce"
when = "ball.z"
direction = "falling"
set = { ball.vz = "-0.5*ball.vz" }
)");
  // Close to the limit point rounding ends the bounces one way or the other; the run ends and says what it did.
  EXPECT_GE(result.events.size(), 15u);
  EXPECT_NEAR(result.events[14].time, 3.0 * std::sqrt(2.0 / 9.8), 1e-3);
}

TEST(RunFailure, SamplesAreInOrderAndAtTheirTimes) {
  for (const Way& way : ways()) {
    Log log;
    const RunResult result = run_text("[time]\nend = 2\nsample = 0.25\n[method]\n" + way.lines + kBall, &log);
    SCOPED_TRACE(way.name);
    std::size_t regular = 0;
    for (std::size_t i = 0; i < log.samples.size(); ++i) {
      if (i > 0) {
        EXPECT_GE(log.samples[i].time, log.samples[i - 1].time);
      }
      if (std::fmod(log.samples[i].time, 0.25) == 0.0) ++regular;
    }
    EXPECT_EQ(regular, 9u);
    // before and after each of the two impacts
    EXPECT_EQ(result.impacts.size(), 2u);
    EXPECT_EQ(log.samples.size(), 9u + 4u);
    for (const Impact& impact : result.impacts) {
      std::vector<double> speeds;
      for (const Sample& sample : log.samples)
        if (sample.time == impact.time) speeds.push_back(sample.bodies[0].velocity.z());
      ASSERT_EQ(speeds.size(), 2u);
      EXPECT_EQ(speeds[0], impact.velocity_before.z());
      EXPECT_EQ(speeds[1], impact.velocity_after.z());
    }
  }
}

}  // namespace
}  // namespace trajet
