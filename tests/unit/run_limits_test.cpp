// Runs that end for want of time or memory: what was computed is kept, and the result says why.

#include <gtest/gtest.h>

#include <new>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::run_text;

std::string ball(const std::string& method_lines) {
  return "[time]\nend = 1e9\nsample = 0.1\n[method]\nmax_steps = 1000000000\n" + method_lines +
         "[[body]]\nname = \"ball\"\nposition = [0, 0, 1]\nacceleration = [0, 0, -9.8]\n"
         "[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
         "on_hit = \"bounce\"\n";
}

std::string fault_of(const std::string& text) {
  try {
    run_text(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RunLimits, ARunOfMoreThanMaxSecondsFails) {
  // so short that it is over before the first step is, on any machine
  const RunResult result = run_text(ball("max_seconds = 1e-9\n"));
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_EQ(result.failure, "more than max_seconds = 1e-09 s of elapsed time");
  EXPECT_LT(result.end_time, 1e9);
  EXPECT_EQ(result.final.time, result.end_time);
}

TEST(RunLimits, TimeEndsAmongTheSamplesOfALongStepToo) {
  struct Reader : RunObserver {
    void sample(const Sample& sample) override { last = sample.time, ++count; }
    long count = 0;
    double last = 0.0;
  } reader;
  const RunResult result = run_text(
      "[time]\nend = 1\nsample = 1e-9\n[method]\nmax_seconds = 1e-9\n[[body]]\nname = \"b\"\nvelocity = [1, 0, 0]\n",
      &reader);
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_LT(reader.count, 1'000'000);
  EXPECT_EQ(reader.last, result.end_time);
}

TEST(RunLimits, MoreSecondsThanNeededChangeNothing) {
  const std::string rest =
      "[time]\nend = 5\n[[body]]\nname = \"b\"\nacceleration = \"-r - 0.1*v\"\nposition = [1, 0, 0]\n";
  const RunResult free = run_text(rest), limited = run_text(rest + "[method]\nmax_seconds = \"10 h\"\n");
  EXPECT_EQ(limited.status, RunStatus::finished);
  EXPECT_EQ(test::final_of(limited, "b").position, test::final_of(free, "b").position);
}

TEST(RunLimits, MaxSecondsIsAPositiveTime) {
  EXPECT_NE(fault_of(ball("max_seconds = 0\n")).find("test.toml:6:15: error: "), std::string::npos)
      << fault_of(ball("max_seconds = 0\n"));
  EXPECT_NE(fault_of(ball("max_seconds = \"3 m\"\n")).find("time [s] expected, got length [m]"), std::string::npos);
}

/// Memory ends where the run has come to a time.
class Exhausted : public RunObserver {
 public:
  explicit Exhausted(double time) : time_(time) {}
  void sample(const Sample& sample) override {
    EXPECT_GE(sample.time, last);
    last = sample.time;
  }
  void motion(const MotionPiece& piece) override {
    if (while_moving && piece.to > time_) throw std::bad_alloc();
  }
  bool interrupted(double time) override {
    if (!while_moving && time > time_) throw std::bad_alloc();
    return false;
  }
  bool while_moving = false;
  double last = 0.0;

 private:
  double time_;
};

TEST(RunLimits, WhereMemoryEndsWhatWasComputedIsKept) {
  for (const bool while_moving : {false, true}) {
    SCOPED_TRACE(while_moving);
    Exhausted observer(7.0);
    observer.while_moving = while_moving;
    const RunResult result = run_text(ball(""), &observer);
    EXPECT_EQ(result.status, RunStatus::failed);
    EXPECT_NE(result.failure.find("memory has run out"), std::string::npos) << result.failure;
    EXPECT_GT(result.end_time, 7.0);
    EXPECT_LT(result.end_time, 8.5);
    EXPECT_GE(result.impacts.size(), 7u);
    EXPECT_EQ(result.final.time, result.end_time);
    EXPECT_EQ(observer.last, result.end_time);
  }
}

}  // namespace
}  // namespace trajet
