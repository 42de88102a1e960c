// How costs grow: counted, not timed.

#include <gtest/gtest.h>

#include "scene_run.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/motion_record.hpp"

namespace trajet::test {
namespace {

/// Counts what it is told.
class Counter : public RunObserver {
 public:
  void sample(const Sample& sample) override {
    ++samples;
    rows += static_cast<long>(sample.bodies.size());
  }
  void motion(const MotionPiece&) override { ++pieces; }

  long samples = 0;
  long rows = 0;
  long pieces = 0;
};

/// Balls that bounce on a plane, each from a height of its own.
std::string balls(int count) {
  std::string scene = "[time]\nend = 2\nsample = 1\n";
  for (int i = 0; i < count; ++i)
    scene += "[[body]]\nname = \"b" + std::to_string(i) + "\"\nshape = \"sphere\"\nradius = 0.1\nposition = [" +
             std::to_string(i) + ", 0, " + number(0.5 + 0.001 * i) + "]\nacceleration = [0, 0, -9.81]\n";
  return scene +
         "[[obstacle]]\nname = \"floor\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
         "on_hit = \"bounce\"\n";
}

TEST(Cost, OfBallsOnAPlaneGrowsLikeTheirNumber) {
  Counter few, many;
  const RunResult of_few = run_text(balls(20), &few), of_many = run_text(balls(200), &many);
  const auto per_impact = [](const RunResult& result) {
    return static_cast<double>(result.statistics.contact_searches) / static_cast<double>(result.impacts.size());
  };
  EXPECT_NEAR(per_impact(of_many), per_impact(of_few), 0.1 * per_impact(of_few));
  // all bodies at the start, after a second and at the end; before and after an impact the one that has it
  EXPECT_EQ(few.rows, 3 * 20 + 2 * static_cast<long>(of_few.impacts.size()));
  EXPECT_EQ(many.rows, 3 * 200 + 2 * static_cast<long>(of_many.impacts.size()));
}

/// A ball that bounces along a road of boxes, without drag: its Segments reach to the end of the run.
RunResult along_road(int tiles) {
  std::string scene = "[time]\nend = " + number(0.4 * tiles) + R"(
[[body]]
name = "ball"
shape = "sphere"
radius = 0.1
position = [0.25, 0, 1.1]
velocity = [2, 0, 0]
acceleration = [0, 0, -9.81]
)";
  for (int i = 0; i < tiles; ++i)
    scene += "[[obstacle]]\nname = \"t" + std::to_string(i) + "\"\nshape = \"box\"\ncenter = [" + std::to_string(i) +
             ", 0, -0.5]\nsize = [1, 4, 1]\non_hit = \"bounce\"\n";
  return run_text(scene);
}

TEST(Cost, OfABounceAlongARoadDoesNotGrowWithTheRoad) {
  const RunResult of_short = along_road(50), of_long = along_road(500);
  ASSERT_EQ(of_long.status, RunStatus::finished);
  // one bounce each 0.903 s; the road is as many times longer as it has bounces more
  EXPECT_GT(of_long.impacts.size(), 9 * of_short.impacts.size());
  const auto per_impact = [](const RunResult& result) {
    return static_cast<double>(result.statistics.contact_searches) / static_cast<double>(result.impacts.size());
  };
  EXPECT_LT(per_impact(of_long), 1.3 * per_impact(of_short));
  EXPECT_LT(per_impact(of_long), 60.0);  // measured: 23
}

TEST(Cost, WhatIsFarAwayIsNotSearched) {
  std::string scene = "[time]\nend = 1\n[[body]]\nname = \"p\"\nvelocity = [1, 0, 0]\n";
  for (int i = 0; i < 100; ++i)
    scene += "[[obstacle]]\nname = \"s" + std::to_string(i) + "\"\nshape = \"sphere\"\nradius = 1\ncenter = [" +
             std::to_string(3 * i) + ", 10, 0]\n";
  EXPECT_EQ(run_text(scene).statistics.contact_searches, 0);
}

TEST(Cost, NothingIsComputedForAnObserverThatWishesNothing) {
  class Silent : public Counter {
   public:
    RunWishes wishes() const override { return {}; }
  };
  Silent silent;
  const RunResult result = run_text(balls(5), &silent);
  EXPECT_GT(result.impacts.size(), 0u);
  EXPECT_EQ(silent.samples + silent.pieces, 0);
}

/// Takes what happens.
class Taker : public RunObserver {
 public:
  RunWishes wishes() const override { return {.takes_records = true}; }
  void impact(const Impact& impact) override { impacts.push_back(impact); }
  void event(const EventRecord& event) override { events.push_back(event); }

  std::vector<Impact> impacts;
  std::vector<EventRecord> events;
};

TEST(Cost, AResultHoldsNoImpactsAndEventsThatAnObserverTakes) {
  const std::string scene = balls(3) + "[[event]]\nname = \"apex\"\nwhen = \"b1.vz\"\n";
  Taker taker;
  Counter listener;  // hears of them and leaves them
  const RunResult taken = run_text(scene, &taker), kept = run_text(scene, &listener);
  EXPECT_TRUE(taken.impacts.empty());
  EXPECT_TRUE(taken.events.empty());
  ASSERT_GT(kept.impacts.size(), 3u);
  ASSERT_GT(kept.events.size(), 1u);
  ASSERT_EQ(taker.impacts.size(), kept.impacts.size());
  ASSERT_EQ(taker.events.size(), kept.events.size());
  for (std::size_t i = 0; i < kept.impacts.size(); ++i) {
    EXPECT_EQ(taker.impacts[i].time, kept.impacts[i].time);
    EXPECT_EQ(taker.impacts[i].body, kept.impacts[i].body);
    EXPECT_EQ(taker.impacts[i].velocity_after, kept.impacts[i].velocity_after);
  }
  for (std::size_t i = 0; i < kept.events.size(); ++i) EXPECT_EQ(taker.events[i].time, kept.events[i].time);
  EXPECT_EQ(taken.warnings, kept.warnings);
}

TEST(Cost, SamplesThatNobodyReadsAreNoWork) {
  class Mover : public Counter {
   public:
    RunWishes wishes() const override { return {.motion = true}; }
    bool interrupted(double) override { return ++questions > 100'000; }
    long questions = 0;
  };
  const auto run_with = [](const std::string& sample, Mover& mover) {
    return run_text("[time]\nend = 100\nsample = " + sample +
                        "\n[[body]]\nname = \"b\"\nposition = [1, 0, 0]\nacceleration = \"-r\"\n",
                    &mover);
  };
  Mover coarse, fine;
  const RunResult few = run_with("1", coarse), many = run_with("1e-9", fine);
  EXPECT_EQ(many.status, RunStatus::finished);
  EXPECT_EQ(fine.samples, 0);
  EXPECT_EQ(fine.questions, coarse.questions);
  EXPECT_EQ(fine.pieces, coarse.pieces);
  EXPECT_EQ(many.statistics.law_evaluations, few.statistics.law_evaluations);
}

TEST(Cost, ASteppedRunIsTheSameRun) {
  const World world = make_world(parse_scene(balls(3), "test.toml"));
  trajet::Run stepped(world);
  double last = 0.0;
  long steps = 0;
  do {
    EXPECT_GE(stepped.next_time(), last);
    last = stepped.next_time();
    ++steps;
  } while (stepped.step());
  const RunResult a = stepped.result(), b = run(world);
  EXPECT_GT(steps, static_cast<long>(b.impacts.size()));
  ASSERT_EQ(a.impacts.size(), b.impacts.size());
  for (std::size_t i = 0; i < a.impacts.size(); ++i) {
    EXPECT_EQ(a.impacts[i].time, b.impacts[i].time);
    EXPECT_EQ(a.impacts[i].velocity_after, b.impacts[i].velocity_after);
  }
  EXPECT_EQ(a.final.bodies[1].position, b.final.bodies[1].position);
}

}  // namespace
}  // namespace trajet::test
