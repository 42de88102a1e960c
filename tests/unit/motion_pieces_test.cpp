#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "scene_run.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {
namespace {

/// Holds the pieces of a run together: each begins where the last of its group ended, in the state in which that ended.
class Follower : public RunObserver {
 public:
  void begin(const World& world) override {
    for (std::size_t g = 0; g < world.groups.size(); ++g) {
      times[static_cast<int>(g)] = 0.0;
      states[static_cast<int>(g)] = world.groups[g].start;
    }
  }
  void motion(const MotionPiece& piece) override {
    const Segment<>& segment = piece.segment;
    EXPECT_EQ(piece.from, times[piece.group]);
    EXPECT_LE(segment.t0(), piece.from);
    EXPECT_LT(piece.from, piece.to);
    EXPECT_LE(piece.to, segment.t1());
    EXPECT_EQ(piece.ends_step, piece.to == segment.t1());
    // the laws here have solutions below 100 in size: rounding of a few steps
    const double jump = (segment.state(piece.from) - states[piece.group]).cwiseAbs().maxCoeff();
    if (jump > 1e-12) jumps.push_back(piece.from);
    EXPECT_EQ(piece.begins_anew, jump > 1e-12 || piece.from == 0.0);
    times[piece.group] = piece.to;
    states[piece.group] = segment.state(piece.to);
    if (piece.ends_step) ++steps;
  }

  std::map<int, double> times;
  std::map<int, Eigen::VectorXd> states;
  std::vector<double> jumps;  // s
  long steps = 0;
};

const char* const kBallAndClock = R"toml(
[time]
end = 3
[[body]]
name = "ball"
position = [0, 0, 1]
acceleration = [0, 0, -9.81]
[[state]]
name = "decay"
value = 1
rate = "-decay*sin(t)"
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
)toml";

TEST(MotionPieces, JoinAndJumpOnlyAtImpacts) {
  Follower follower;
  const RunResult result = test::run_text(kBallAndClock, &follower);
  ASSERT_EQ(result.status, RunStatus::finished);
  EXPECT_EQ(follower.times, (std::map<int, double>{{0, 3.0}, {1, 3.0}}));
  ASSERT_EQ(result.impacts.size(), 3u);
  ASSERT_EQ(follower.jumps.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(follower.jumps[i], result.impacts[i].time);
  // each bounce cuts a step of the ball short
  EXPECT_EQ(follower.steps, result.statistics.steps - 3);
  EXPECT_EQ(follower.states[1][0], test::state_of(result, "decay"));
}

TEST(MotionPieces, EndWhereTheRunIsStopped) {
  std::string text = kBallAndClock;
  text.replace(text.find("bounce"), 6, "stop");
  Follower follower;
  const RunResult result = test::run_text(text, &follower);
  ASSERT_EQ(result.status, RunStatus::stopped);
  EXPECT_EQ(follower.times, (std::map<int, double>{{0, result.end_time}, {1, result.end_time}}));
  EXPECT_TRUE(follower.jumps.empty());
}

TEST(ClosedForms, AreCompiledAndChecked) {
  const std::string text = kBallAndClock;
  const World world = make_world(
      parse_scene(text + "[exact]\nball.v = [0, 0, \"-9.81*t\"]\ndecay = \"exp(cos(t) - 1)\"\n", "test.toml"));
  ASSERT_EQ(world.exact.size(), 2u);
  EXPECT_EQ(world.exact[0].group, 0);
  EXPECT_EQ(world.exact[0].offset, 3);
  EXPECT_EQ(world.exact[0].value.outputs.size(), 3u);
  EXPECT_EQ(world.exact[1].group, 1);
  EXPECT_EQ(world.exact[1].offset, 0);
  const std::string wrong[] = {"ball.r = 1\n", "decay = \"exp(cost)\"\n", "decay = [1, 2, 3]\n",
                               "decay = \"ball.vz*t\"\n"};
  for (const std::string& line : wrong) try {
      make_world(parse_scene(text + "[exact]\n" + line, "test.toml"));
      ADD_FAILURE() << line;
    } catch (const InputError& error) {
      EXPECT_EQ(error.where().line, 19) << error.what();
    }
}

}  // namespace
}  // namespace trajet
