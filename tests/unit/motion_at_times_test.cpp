#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene_run.hpp"
#include "trajet/trajet.hpp"

namespace trajet {
namespace {

Motion motion_of(const std::string& text) { return compute_motion(parse_scene(text, "test.toml")); }

constexpr double kGravity = 10.0;

/// Dropped from 5 m, it lands after 1 s with 10 m/s and, with half of that, again after 2 s.
const std::string kBouncing = R"(
[[body]]
name = "ball"
position = [0, 0, 5]
velocity = [1, 0, 0]
acceleration = [0, 0, -10]
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "bounce"
restitution = 0.5
)";

double height(double t) {
  if (t < 1.0) return 5.0 - kGravity * t * t / 2.0;
  const double since = t - 1.0;
  return 5.0 * since - kGravity * since * since / 2.0;
}

/// The height of a ball that bounces by closed form; a few roundings of terms of 5 m.
constexpr double kTolerance = 1e-14;

TEST(MotionAtTimes, OfABounceIsTheClosedForm) {
  const Motion motion = motion_of("[time]\nend = 1.9\n" + kBouncing);
  ASSERT_TRUE(motion.ok());
  ASSERT_EQ(motion.impacts().size(), 1u);
  for (double t = 0.0; t <= 1.9; t += 0.01) {
    EXPECT_NEAR(motion.position("ball", t).z(), height(t), kTolerance) << t;
    EXPECT_NEAR(motion.position("ball", t).x(), t, kTolerance) << t;
    EXPECT_NEAR(motion.velocity("ball", t).z(), t < 1.0 ? -kGravity * t : 5.0 - kGravity * (t - 1.0), kTolerance) << t;
    EXPECT_NEAR(motion.state("ball", t).acceleration.z(), -kGravity, kTolerance) << t;
  }
}

TEST(MotionAtTimes, AtAJumpIsThatBehindIt) {
  const Motion motion = motion_of("[time]\nend = 1.9\n" + kBouncing);
  const Impact& impact = motion.impacts().at(0);
  EXPECT_EQ(motion.velocity("ball", impact.time), impact.velocity_after);
  EXPECT_NEAR(motion.velocity("ball", std::nextafter(impact.time, 0.0)).z(), impact.velocity_before.z(), kTolerance);
  EXPECT_NEAR(impact.velocity_before.z(), -10.0, kTolerance);
}

TEST(MotionAtTimes, AtTheEndIsTheFinalState) {
  // stopped by the ground, by an event that sets the state at the end, and at the end of a flight
  const std::string event =
      "[[state]]\nname = \"n\"\nvalue = 0\nrate = 1\n[[event]]\nname = \"e\"\nwhen = \"n - 1\"\nset = {n = 7}\n"
      "[[event]]\nname = \"s\"\nwhen = \"n - 6.5\"\naction = \"stop\"\n";
  for (const std::string& text :
       {"[time]\nend = 1.9\n" + kBouncing, "[time]\nend = 1\n" + kBouncing, "[time]\nend = 3\n" + event}) {
    const Motion motion = motion_of(text);
    const double end = motion.end_time();
    for (const BodyState& body : motion.final().bodies) {
      EXPECT_EQ(motion.position(body.body, end), body.position);
      EXPECT_EQ(motion.velocity(body.body, end), body.velocity);
      EXPECT_EQ(motion.state(end).bodies.at(0).acceleration, body.acceleration);
    }
    for (const NamedValue& state : motion.final().states) EXPECT_EQ(motion.value(state.name, end), state.value);
  }
}

TEST(MotionAtTimes, IsTheSameAtManyTimesInAnyOrderAndByHandle) {
  const Motion motion = motion_of(
      "[time]\nend = 40\n" + kBouncing +
      "[[body]]\nname = \"box\"\nshape = \"box\"\nsize = [1, 2, 3]\nmass = 1\nangular_velocity = [0.1, 2, 0.1]\n"
      "collides_with = \"none\"\n[[state]]\nname = \"s\"\nvalue = 1\nrate = \"-s\"\n");
  ASSERT_TRUE(motion.ok());
  std::vector<double> times(5000);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> between(motion.start_time(), motion.end_time());
  std::generate(times.begin(), times.end(), [&] { return between(random); });
  for (const Impact& impact : motion.impacts()) times.push_back(impact.time);
  const Eigen::Matrix3Xd positions = motion.position("ball", times), velocities = motion.velocity("box", times),
                         turning = motion.angular_velocity("box", times);
  const Eigen::Matrix4Xd orientations = motion.orientation("box", times);
  const Eigen::VectorXd values = motion.value("s", times);
  const BodyMotion ball = motion.body("ball");
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    EXPECT_EQ(positions.col(column), ball.position(times[i]));
    EXPECT_EQ(velocities.col(column), motion.velocity("box", times[i]));
    EXPECT_EQ(turning.col(column), motion.angular_velocity("box", times[i]));
    EXPECT_EQ(orientations(0, column), motion.orientation("box", times[i]).w());
    EXPECT_EQ(values[column], motion.value("s", times[i]));
    EXPECT_NEAR(values[column], std::exp(-times[i]), 1e-11);
    EXPECT_GE(positions(2, column), -1e-12);
  }
}

TEST(MotionAtTimes, IsWhatSamplesAre) {
  /// Keeps the samples between impacts.
  struct Samples : RunObserver {
    RunWishes wishes() const override { return {.samples = true}; }
    void sample(const Sample& sample) override {
      if (sample.phase == SamplePhase::none) all.push_back(sample);
    }
    /// One that falls on the time of an impact may be of before it.
    void impact(const Impact& impact) override {
      while (!all.empty() && all.back().time == impact.time) all.pop_back();
    }
    std::vector<Sample> all{};
  };
  for (const OrientationInfo& way : orientation_ways()) {
    Samples samples;
    const Scene scene = parse_scene(
        "[time]\nend = 5\n[method]\norientation = \"" + std::string(way.name) + "\"\n" + kBouncing +
            "[[body]]\nname = \"box\"\nshape = \"box\"\nsize = [1, 2, 3]\nmass = 1\nangular_velocity = [0.1, 2, 0.1]\n"
            "collides_with = \"none\"\npoints = {tip = [1, 0, 0]}\n",
        "test.toml");
    const Motion motion = compute_motion(scene, &samples);
    ASSERT_GT(samples.all.size(), 190u);
    // both read the same polynomials, in another order of additions: some roundings of terms of up to 10
    constexpr double kRounding = 1e-13;
    for (const Sample& sample : samples.all)
      for (const BodyState& body : sample.bodies) {
        EXPECT_LT((motion.position(body.body, sample.time) - body.position).norm(), kRounding);
        EXPECT_LT((motion.velocity(body.body, sample.time) - body.velocity).norm(), kRounding);
        EXPECT_LT((motion.angular_velocity(body.body, sample.time) - body.angular_velocity).norm(), kRounding);
        const Quaternion q = motion.orientation(body.body, sample.time);
        EXPECT_LT((q.vec() - body.orientation.vec()).norm() + std::abs(q.w() - body.orientation.w()), kRounding);
        const BodyState state = motion.state(body.body, sample.time);
        EXPECT_LT((state.rotation_matrix - body.rotation_matrix).norm(), kRounding);
        ASSERT_EQ(state.points.size(), body.points.size());
        for (std::size_t i = 0; i < state.points.size(); ++i)
          EXPECT_LT((state.points[i].velocity - body.points[i].velocity).norm(), kRounding);
      }
  }
}

TEST(MotionAtTimes, OfAccumulatingBouncesIsOnTheRightPiece) {
  // the bounces accumulate at 1 s + 2 s: pieces of all lengths down to rounding
  const Motion motion = motion_of("[time]\nend = 4\n" + kBouncing);
  ASSERT_GT(motion.impacts().size(), 10u);
  for (std::size_t i = 0; i + 1 < motion.impacts().size(); ++i) {
    const Impact& impact = motion.impacts()[i];
    EXPECT_NEAR(motion.position("ball", impact.time).z(), 0.0, kTolerance);
    // behind the last hit come the infinitely many that nobody follows: the ball rests from there
    if (motion.impacts()[i + 1].kind == ImpactKind::hit) {
      EXPECT_EQ(motion.velocity("ball", impact.time), impact.velocity_after) << impact.time;
    }
  }
}

TEST(MotionAtTimes, RunsBackward) {
  const Motion motion = motion_of(
      "[time]\nstart = 2\nend = -1\n[[state]]\nname = \"s\"\nvalue = 1\nrate = \"-s\"\n[[state]]\nname = \"n\"\n"
      "value = 0\nrate = 0\n[[event]]\nname = \"e\"\nwhen = \"s - 2\"\nset = {n = \"n + 1\"}\n");
  ASSERT_TRUE(motion.ok());
  for (double t = 2.0; t >= -1.0; t -= 0.1) EXPECT_NEAR(motion.value("s", t), std::exp(2.0 - t), 1e-10) << t;
  // behind a jump is what the run goes on with: the earlier side
  ASSERT_EQ(motion.events().size(), 1u);
  const double jump = motion.events()[0].time;
  EXPECT_EQ(motion.value("n", std::nextafter(jump, 3.0)), 0.0);
  EXPECT_EQ(motion.value("n", jump), 1.0);
  EXPECT_THROW(static_cast<void>(motion.value("s", 2.1)), std::out_of_range);
}

TEST(MotionAtTimes, KnowsTheClockOfTheScene) {
  const double start = 1.7e9;
  const Motion motion = motion_of("[time]\nstart = 1700000000\nend = 1700000001.9\n" + kBouncing);
  // the clock has a microsecond's quarter
  EXPECT_NEAR(motion.position("ball", start + 0.5).z(), height(0.5), 1e-14);
  EXPECT_NEAR(motion.position("ball", start + 1.5).z(), height(1.5), 1e-14);
  EXPECT_EQ(motion.position("ball", motion.end_time()), motion.final().bodies.at(0).position);
}

TEST(MotionAtTimes, OutsideOrOfAnUnknownNameIsAnError) {
  const Motion motion = motion_of("[time]\nend = 0.5\n" + kBouncing);
  EXPECT_THROW(static_cast<void>(motion.position("ball", -1e-9)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(motion.position("ball", 0.6)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(motion.position("ball", std::nan(""))), std::out_of_range);
  EXPECT_THROW(static_cast<void>(motion.value("ball", 0.1)), std::invalid_argument);
  try {
    static_cast<void>(motion.position("bal", 0.1));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "the motion has no body 'bal'; did you mean 'ball'?");
  }
}

TEST(MotionAtTimes, OfARunThatEndsWhereItStartsIsItsStart) {
  const Motion motion = motion_of(
      "[time]\nend = 1\n[[body]]\nname = \"a\"\nvelocity = [0, 0, -1]\n[[obstacle]]\n"
      "name = \"g\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n");
  EXPECT_EQ(motion.status(), RunStatus::stopped);
  EXPECT_EQ(motion.end_time(), 0.0);
  EXPECT_EQ(motion.position("a", 0.0), Vector3(0, 0, 0));
}

TEST(MotionAtTimes, HandlesAndCopiesKeepItAlive) {
  const auto make = [] { return motion_of("[time]\nend = 0.5\n" + kBouncing).body("ball"); };
  const BodyMotion ball = make();
  EXPECT_EQ(ball.name(), "ball");
  EXPECT_NEAR(ball.position(0.5).z(), 3.75, kTolerance);
  int count = 0;
  for (const Impact& impact : motion_of("[time]\nend = 1.9\n" + kBouncing).impacts()) {
    EXPECT_NEAR(impact.time, 1.0, kTolerance);
    ++count;
  }
  EXPECT_EQ(count, 1);
}

TEST(MotionAtTimes, IsToldInAFewLines) {
  EXPECT_EQ(to_string(motion_of("title = \"A ball\"\n[time]\nend = 1.9\n" + kBouncing)),
            "A ball\nfinished at t = 1.9 s by taylor\n1 impact, 0 events, 0 lasting contacts\n");
}

}  // namespace
}  // namespace trajet
