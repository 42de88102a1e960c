// What a scene says of its pairs: who meets whom, what becomes of it, and what is an error.

#include <gtest/gtest.h>

#include <sstream>

#include "body_scene.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet {
namespace {

using test::BallOf;
using test::final_of;
using test::plane;
using test::run_text;

class LastSample : public RunObserver {
 public:
  RunWishes wishes() const override { return {.samples = true}; }
  void sample(const Sample& sample) override { last = sample; }
  Sample last{};
};

TEST(MeetingRules, WhatCannotAnswerEndsTheRunWithTheContact) {
  BallOf a{"a", 0.1, 1.0, {0, 0, 0}, {1, 0, 0}}, b{"b", 0.1, 1.0, {1, 0, 0}};
  std::string text = "[time]\nend = 2\n" + a.text() + b.text();
  text.replace(text.rfind("mass = 1.0\n"), 11, "");
  const RunResult result = run_text(text);
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_NE(result.failure.find("give 'b' a `mass`"), std::string::npos) << result.failure;
  ASSERT_EQ(result.impacts.size(), 1u);
  EXPECT_NEAR(result.impacts[0].time, 0.8, 1e-14);
}

TEST(MeetingRules, AStartInEachOtherIsAnErrorThatNamesBoth) {
  const BallOf a{"a", 0.1, 1.0}, b{"b", 0.1, 1.0, {0.15, 0, 0}};
  try {
    run_text("[time]\nend = 2\n" + a.text() + b.text());
    FAIL() << "nothing was said";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("bodies 'a' and 'b' overlap at the start"), std::string::npos);
  }
}

TEST(MeetingRules, PairsMeetIfBothSidesAgree) {
  const auto impacts = [](const std::string& of_a, const std::string& of_b) {
    const BallOf a{"a", 0.1, 1.0, {0, 0, 0}, {1, 0, 0}, of_a}, b{"b", 0.1, 1.0, {1, 0, 0}, {0, 0, 0}, of_b};
    const BallOf aside{"c", 0.1, 1.0, {0, 5, 0}};  // some bodies do meet others
    const RunResult result =
        run_text("[time]\nend = 4\n" + a.text() + b.text() + aside.text() + plane("wall", {2, 0, 0}, {-1, 0, 0}));
    EXPECT_EQ(result.status, RunStatus::finished) << result.failure;
    std::ostringstream met;
    for (const Impact& impact : result.impacts) met << impact.body << '-' << impact.with << ' ';
    return met.str();
  };
  EXPECT_EQ(impacts("", ""), "a-b b-wall a-b ");
  EXPECT_EQ(impacts("collides_with = \"obstacles\"\n", ""), "a-wall ");
  EXPECT_EQ(impacts("", "collides_with = \"none\"\n"), "a-wall ");
  EXPECT_EQ(impacts("collides_with = [\"b\"]\n", ""), "a-b b-wall a-b ");
  EXPECT_EQ(impacts("", "collides_with = [\"a\"]\n"), "a-b ");
  EXPECT_EQ(impacts("collides_with = [\"wall\"]\n", ""), "a-wall ");
}

TEST(MeetingRules, APairMaySayWhatBecomesOfIt) {
  const BallOf a{"a", 0.1, 1.0, {0, 0, 0}, {1, 0, 0}}, b{"b", 0.2, 1.0, {1, 0, 0}};
  const std::string text = "[time]\nend = 4\n" + a.text() + b.text() + "[[pair]]\nof = [\"b\", \"a\"]\n";
  const RunResult passed = run_text(text + "on_hit = \"pass\"\n");
  ASSERT_EQ(passed.impacts.size(), 2u);
  EXPECT_NEAR(passed.impacts[0].time, 0.7, 1e-14);
  EXPECT_NEAR(passed.impacts[1].time, 1.3, 1e-14);
  EXPECT_EQ(final_of(passed, "b").position.x(), 1.0);

  const RunResult stopped = run_text(text + "on_hit = \"stop\"\n");
  EXPECT_EQ(stopped.status, RunStatus::stopped);
  EXPECT_NEAR(stopped.end_time, 0.7, 1e-14);
  LastSample samples;
  run_text(text + "on_hit = \"stop\"\n", &samples);
  EXPECT_EQ(samples.last.bodies.size(), 2u);  // the last row tells of all
  EXPECT_EQ(samples.last.time, stopped.end_time);

  const RunResult plastic = run_text(text + "restitution = 0\n");
  EXPECT_EQ(plastic.status, RunStatus::finished) << plastic.failure;
  ASSERT_EQ(plastic.impacts.size(), 1u);
  EXPECT_NEAR(final_of(plastic, "a").velocity.x(), 0.5, 1e-15);
  EXPECT_NEAR(final_of(plastic, "b").velocity.x(), 0.5, 1e-15);

  const RunResult by_speed = run_text(text + "restitution = \"1 - u/2\"\n");
  EXPECT_NEAR(final_of(by_speed, "b").velocity.x(), 0.75, 1e-15);
}

TEST(MeetingRules, RestitutionsOfTwoBodiesHaveTheirGeometricMean) {
  const BallOf a{"a", 0.1, 1.0, {0, 0, 0}, {1, 0, 0}, "restitution = 0.9\n"};
  const BallOf b{"b", 0.2, 1.0, {1, 0, 0}, {0, 0, 0}, "restitution = \"0.5 - 0.1*u\"\n"};
  const RunResult result = run_text("[time]\nend = 2\n" + a.text() + b.text());
  EXPECT_NEAR(final_of(result, "b").velocity.x(), 0.5 * (1.0 + 0.6), 1e-15);
}

}  // namespace
}  // namespace trajet
