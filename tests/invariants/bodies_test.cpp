// Several bodies: who is independent stays so to the last bit, who is not keeps what is conserved.

#include <gtest/gtest.h>

#include <cmath>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::run_text;
using test::Way;

const std::string kFloor = R"(
[[obstacle]]
name = "floor"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
restitution = 0.8
)";

std::vector<Way> ways() {
  return {{"taylor", "name = \"taylor\"\n"}, test::controlled("dopri5", 1e-9), test::fixed("rk4", 0.05)};
}

TEST(Bodies, IndependentOnesMoveAsIfAlone) {
  const std::string bodies[] = {R"(
[[body]]
name = "drag"
position = [0, 0, 3]
velocity = [5, 0, 2]
acceleration = "[0, 0, -9.8] - 0.1*norm(v)*v"
)",
                                R"(
[[body]]
name = "spring"
shape = "sphere"
radius = 0.2
position = [0, 1, 2]
acceleration = '-4*(r - [0, 0, 1.5])'
)",
                                R"(
[[body]]
name = "free"
position = [-3, 1, 0.5]
velocity = [1, 0.5, 4]
acceleration = [0, 0, -9.8]
)"};
  for (const Way& way : ways()) {
    const std::string head = "[time]\nend = 3\n[method]\n" + way.lines;
    const RunResult together = run_text(head + bodies[0] + bodies[1] + bodies[2] + kFloor);
    ASSERT_EQ(together.status, RunStatus::finished) << together.failure;
    std::size_t impacts = 0;
    for (const std::string& body : bodies) {
      const RunResult alone = run_text(head + body + kFloor);
      const BodyState& state = alone.final.bodies[0];
      EXPECT_EQ(test::final_of(together, state.body).position, state.position) << way.name << state.body;
      EXPECT_EQ(test::final_of(together, state.body).velocity, state.velocity) << way.name << state.body;
      for (const Impact& impact : alone.impacts) {
        bool found = false;
        for (const Impact& other : together.impacts)
          found = found || (other.body == impact.body && other.time == impact.time &&
                            other.velocity_after == impact.velocity_after);
        EXPECT_TRUE(found) << way.name << state.body << " at " << impact.time;
      }
      impacts += alone.impacts.size();
    }
    EXPECT_EQ(together.impacts.size(), impacts);
    EXPECT_GE(impacts, 4u);
    for (std::size_t i = 1; i < together.impacts.size(); ++i)
      EXPECT_LE(together.impacts[i - 1].time, together.impacts[i].time);
  }
}

TEST(Bodies, AStopOfOneStopsAllAtThatTime) {
  const RunResult result = run_text(R"(
[time]
end = 10
[[body]]
name = "slow"
velocity = [1, 0, 0]
[[body]]
name = "fast"
velocity = [4, 0, 0]
[[obstacle]]
name = "wall"
shape = "plane"
point = [6, 0, 0]
normal = [-1, 0, 0]
)");
  EXPECT_EQ(result.end_time, 1.5);
  EXPECT_EQ(test::final_of(result, "slow").position.x(), 1.5);
  EXPECT_EQ(test::final_of(result, "fast").position.x(), 6.0);
}

constexpr double kSun = 3.0;
constexpr double kMoon = 0.5;

struct Conserved {
  double energy;
  Vector3 momentum;
  Vector3 angular_momentum;
};

Conserved conserved(const BodyState& sun, const BodyState& moon) {
  return {0.5 * kSun * sun.velocity.squaredNorm() + 0.5 * kMoon * moon.velocity.squaredNorm() -
              kSun * kMoon / (sun.position - moon.position).norm(),
          kSun * sun.velocity + kMoon * moon.velocity,
          kSun * sun.position.cross(sun.velocity) + kMoon * moon.position.cross(moon.velocity)};
}

/// The first and the last sample of a run.
class Ends : public RunObserver {
 public:
  void sample(const Sample& sample) override {
    if (first.bodies.empty()) first = sample;
    last = sample;
  }
  Sample first, last;
};

TEST(Bodies, MutualGravityKeepsEnergyAndMomentum) {
  // Two bodies on an eccentric orbit about each other, some 12 revolutions, while a third one bounces.
  Ends ends;
  const RunResult result = run_text(R"(
[time]
end = 50
[method]
rtol = 1e-13
atol = 1e-13
[[body]]
name = "sun"
velocity = [0, -0.2, 0]
force = "1.5*(moon.r - r)/norm(moon.r - r)^3"
mass = 3
[[body]]
name = "moon"
position = [1, 0, 0.1]
velocity = [0, 1.2, 0.1]
force = "1.5*(sun.r - r)/norm(sun.r - r)^3"
mass = 0.5
[[body]]
name = "ball"
position = [100, 0, 1]
acceleration = [0, 0, -9.8]
[[obstacle]]
name = "floor"
shape = "plane"
point = [0, 0, -50]
normal = [0, 0, 1]
on_hit = "bounce"
)",
                                    &ends);
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  EXPECT_EQ(result.impacts.size(), 8u);  // falls of 51 m take 3.226 s
  const Conserved before = conserved(ends.first.bodies[0], ends.first.bodies[1]);
  const Conserved after = conserved(ends.last.bodies[0], ends.last.bodies[1]);
  // rtol times a few hundred steps
  EXPECT_NEAR(after.energy, before.energy, 1e-11 * std::abs(before.energy));
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-12);
  EXPECT_LT((after.angular_momentum - before.angular_momentum).norm(), 1e-11);
  const BodyState& ball = ends.last.bodies[2];
  EXPECT_NEAR(9.8 * ball.position.z() + 0.5 * ball.velocity.squaredNorm(), 9.8, 1e-10);
}

TEST(Bodies, ABounceOfOneOfAPairActsOnThePair) {
  // Two masses on a spring fall; when the lower one bounces, momentum jumps by its impulse and the spring acts on.
  const RunResult result = run_text(R"(
[time]
end = 2
[[body]]
name = "upper"
position = [0, 0, 3]
force = '[0, 0, -9.8] - 50*(r - lower.r - [0, 0, 1])'
mass = 1
[[body]]
name = "lower"
position = [0, 0, 2]
force = '[0, 0, -9.8] - 50*(r - upper.r + [0, 0, 1])'
mass = 1
)" + kFloor + R"(
[[obstacle]]
name = "ceiling"
shape = "plane"
point = [0, 0, 50]
normal = [0, 0, -1]
)");
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_GE(result.impacts.size(), 2u);
  EXPECT_NEAR(result.impacts[0].time, std::sqrt(4.0 / 9.8), 1e-13);  // relaxed until then
  double impulse = 0.0;
  for (const Impact& impact : result.impacts) {
    EXPECT_EQ(impact.body, "lower");
    impulse += impact.impulse.z();
  }
  const double momentum = test::final_of(result, "upper").velocity.z() + test::final_of(result, "lower").velocity.z();
  // m v = impulses - 2 m g t
  EXPECT_NEAR(momentum, impulse - 2.0 * 9.8 * 2.0, 1e-10);
}

TEST(Bodies, TheSameRunGivesTheSameBits) {
  for (const Way& way : ways()) {
    const std::string scene = "[time]\nend = 5\n[method]\n" + way.lines + R"(
[[body]]
name = "a"
position = [0, 0, 3]
velocity = [5, 0, 2]
acceleration = "[0, 0, -9.8] - 0.1*norm(v)*v"
)" + kFloor;
    const RunResult one = run_text(scene);
    const RunResult two = run_text(scene);
    ASSERT_EQ(one.impacts.size(), two.impacts.size());
    for (std::size_t i = 0; i < one.impacts.size(); ++i) EXPECT_EQ(one.impacts[i].time, two.impacts[i].time);
    EXPECT_EQ(one.final.bodies[0].position, two.final.bodies[0].position);
  }
}

}  // namespace
}  // namespace trajet
