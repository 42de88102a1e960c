// Bouncing through whole runs.

#include <gtest/gtest.h>

#include <cmath>

#include "bouncing_ground.hpp"

namespace trajet {
namespace {

using test::kBouncingGround;
using test::Way;

/// A ball thrown upward from `height` with `speed`: contacts and the end of bouncing, in closed form.
struct Bouncing {
  double gravity, height, speed, restitution;
  double first() const { return (speed + std::sqrt(speed * speed + 2.0 * gravity * height)) / gravity; }
  double first_flight() const {
    return 2.0 * restitution * std::sqrt(speed * speed + 2.0 * gravity * height) / gravity;
  }
  double contact(int i) const {
    return first() + first_flight() * (1.0 - std::pow(restitution, i)) / (1.0 - restitution);
  }
  double end() const { return first() + first_flight() / (1.0 - restitution); }

  RunResult run(const Way& way, double until, double radius = 0.0) const {
    const std::string shape = radius > 0.0 ? "shape = \"sphere\"\nradius = " + test::number(radius) + "\n" : "";
    return test::run_text("[time]\nend = " + test::number(until) + "\n[method]\n" + way.lines +
                          "[[body]]\nname = \"ball\"\n" + shape + "position = [0, 0, " + test::number(height + radius) +
                          "]\nvelocity = [1, 0, " + test::number(speed) + "]\nacceleration = [0, 0, " +
                          test::number(-gravity) + "]\n" + kBouncingGround +
                          "restitution = " + test::number(restitution) + "\n");
  }
};

// Bouncing is followed until contact lasts; when it would be over is known before that, and may be behind the end.
TEST(Bounce, ARestBehindTheEndIsNotReported) {
  const Bouncing ball{9.81, 1.0, 0.0, 0.5};
  for (const Way& way : test::long_controlled_and_short_steps()) {
    const RunResult whole = ball.run(way, 3.0);
    const auto rests = test::impacts_of(whole, ImpactKind::rest);
    ASSERT_EQ(rests.size(), 1u) << way.name;
    const double last_bounce = test::impacts_of(whole, ImpactKind::hit).back()->time;
    ASSERT_LT(last_bounce, rests[0]->time) << way.name;
    const RunResult cut = ball.run(way, 0.5 * (last_bounce + rests[0]->time));
    EXPECT_EQ(cut.status, RunStatus::finished) << way.name;
    EXPECT_TRUE(test::impacts_of(cut, ImpactKind::rest).empty()) << way.name;
    EXPECT_LE(cut.impacts.back().time, cut.end_time) << way.name;
  }
}

// Where a faster impact leaves less, each speed is known from the one before.
TEST(Bounce, ARestitutionMayDependOnTheSpeedOfApproach) {
  for (const std::string method : {"taylor", "taylor-extended", "dop853"}) {
    for (const std::string slanted : {"normal = [0, 0, 1]", "normal = [0, 0.6, 0.8]"}) {
      const std::string fall =
          slanted.find("0.6") != std::string::npos ? "[0, \"-0.6*9.8\", \"-0.8*9.8\"]" : "[0, 0, -9.8]";
      const RunResult result = test::run_text(
          "[time]\nend = 6\n[method]\nname = \"" + method + "\"\n[[body]]\nname = \"ball\"\nposition = " +
          (fall[4] == '0' ? "[0, 0, 10]" : "[0, 6, 8]") + "\nacceleration = " + fall +
          "\n[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, 0]\non_hit = \"bounce\"\n" + slanted +
          "\nrestitution = \"0.9 - 0.02*u\"\n");
      SCOPED_TRACE(method + fall + result.failure);
      const auto hits = test::impacts_of(result, ImpactKind::hit);
      ASSERT_GE(hits.size(), 4u);
      double speed = std::sqrt(2.0 * 9.8 * 10.0), time = speed / 9.8;
      for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(hits[i]->time, time, 1e-9) << i;
        EXPECT_NEAR(hits[i]->velocity_before.norm(), speed, 1e-9) << i;
        speed *= 0.9 - 0.02 * speed;
        EXPECT_NEAR(hits[i]->velocity_after.norm(), speed, 1e-9) << i;
        time += 2.0 * speed / 9.8;
      }
    }
  }
}

TEST(Bounce, ARestitutionOutsideOfItsRangeEndsTheRun) {
  const std::string scene =
      "[time]\nend = 6\n[[body]]\nname = \"ball\"\nposition = [0, 0, 5]\nacceleration = [0, 0, -10]\n" +
      std::string(kBouncingGround);
  const RunResult result = test::run_text(scene + "restitution = \"0.9 - 0.1*u\"\n");
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_EQ(result.failure.find("restitution of obstacle 'ground' is -0.09999999999999"), 0u) << result.failure;
  EXPECT_NE(result.failure.find("at a speed of approach of 10"), std::string::npos) << result.failure;
  EXPECT_NE(result.failure.find("not within 0 and 1 (test.toml:"), std::string::npos) << result.failure;
  EXPECT_NEAR(result.end_time, 1.0, 1e-12);
  // as a unit of the constant says
  EXPECT_EQ(test::run_text("[parameters]\nk = \"0.05 s/m\"\n" + scene + "restitution = \"0.9 - k*u\"\n").status,
            RunStatus::finished);
}

TEST(Bounce, ARestIsReportedWhereTheBodyIsThen) {
  // It slides at 1 m/s all the time.
  const Bouncing ball{9.81, 1.0, 0.0, 0.5};
  for (const Way& way : test::long_controlled_and_short_steps()) {
    const RunResult result = ball.run(way, 3.0, 0.25);
    const auto rests = test::impacts_of(result, ImpactKind::rest);
    ASSERT_EQ(rests.size(), 1u) << way.name;
    EXPECT_GT(rests[0]->time, test::impacts_of(result, ImpactKind::hit).back()->time) << way.name;
    EXPECT_NEAR(rests[0]->position.x(), rests[0]->time, 1e-13) << way.name;
    EXPECT_NEAR(rests[0]->point.x(), rests[0]->time, 1e-13) << way.name;
    EXPECT_EQ(rests[0]->velocity_before, Vector3(1, 0, 0)) << way.name;
    EXPECT_EQ(rests[0]->velocity_after, Vector3(1, 0, 0)) << way.name;
  }
}

TEST(Bounce, ARestThatEndsBeforeItsTimeIsNotReported) {
  // An edge between the last bounce and the time at which bouncing would be over.
  const Bouncing ball{9.81, 1.0, 0.0, 0.5};
  for (const Way& way : test::long_controlled_and_short_steps()) {
    const RunResult whole = ball.run(way, 3.0);
    const double last = test::impacts_of(whole, ImpactKind::hit).back()->time;
    const double edge = 0.1 * last + 0.9 * test::impacts_of(whole, ImpactKind::rest).back()->time;
    const RunResult result = test::run_text("[time]\nend = 3\n[method]\n" + way.lines + R"(
[[body]]
name = "ball"
position = [0, 0, 1]
velocity = [1, 0, 0]
acceleration = [0, 0, -9.81]
[[obstacle]]
name = "table"
shape = "rectangle"
normal = [0, 0, 1]
up = [0, 1, 0]
size = [10, 2]
on_hit = "bounce"
restitution = 0.5
center = [)" + test::number(edge - 5.0) + ", 0, 0]\n");
    ASSERT_EQ(result.status, RunStatus::finished) << way.name << result.failure;
    EXPECT_TRUE(test::impacts_of(result, ImpactKind::rest).empty()) << way.name;
    ASSERT_EQ(result.impacts.back().kind, ImpactKind::leave) << way.name;
    EXPECT_NEAR(result.impacts.back().time, edge, 1e-12) << way.name;
    EXPECT_LT(test::final_of(result, "ball").position.z(), -1.0) << way.name;
  }
}

TEST(Bounce, PublishedContactsAndEnds) {
  struct Published {
    Bouncing ball;
    std::vector<double> contacts;
    double end;
    double digits;  // half a unit of the last printed digit
  };
  const Published all[] = {{{9.81, 1.0, 0.0, 0.7}, {0.451523640985731}, 2.55863396558581, 1e-14},
                           {{9.81, 1.0, 0.0, 0.9}, {0.451523640985731}, 8.57894917872889, 1e-14},
                           // MATLAB's ballode
                           {{9.8, 0.0, 20.0, 0.9}, {4.08163265, 7.75510204, 11.06122449}, 40.81632653, 5e-9}};
  for (const Published& published : all) {
    for (const Way& way : test::long_controlled_and_short_steps()) {
      for (const double radius : {0.0, 0.25}) {
        const RunResult result = published.ball.run(way, 1.5 * published.end, radius);
        SCOPED_TRACE(way.name + " " + test::number(radius));
        ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
        ASSERT_GE(result.impacts.size(), published.contacts.size());
        for (std::size_t i = 0; i < published.contacts.size(); ++i) {
          EXPECT_EQ(result.impacts[i].kind, ImpactKind::hit);
          // a run rounds by some 1e-16 in each step
          EXPECT_NEAR(result.impacts[i].time, published.contacts[i], published.digits + 1e-13);
        }
        const auto rests = test::impacts_of(result, ImpactKind::rest);
        ASSERT_EQ(rests.size(), 1u);
        // The end adds all flights; each is wrong by the rounding of its speed, carried on by e: 1e-13 in sum.
        EXPECT_NEAR(rests[0]->time, published.end, published.digits + 1e-12);
        EXPECT_EQ(result.impacts.back().kind, ImpactKind::rest);
        // It slides on without friction.
        const BodyState& ball = test::final_of(result, "ball");
        EXPECT_NEAR(ball.position.x(), result.end_time, 1e-11);
        EXPECT_NEAR(ball.position.z(), radius, 1e-9);
        EXPECT_EQ(ball.velocity.z(), 0.0);
      }
    }
  }
}

TEST(Bounce, EveryContactOfTheSeries) {
  const Bouncing ball{9.81, 1.0, 0.0, 0.7};
  const RunResult result = ball.run(test::long_controlled_and_short_steps()[0], 3.0);
  const auto hits = test::impacts_of(result, ImpactKind::hit);
  EXPECT_GT(hits.size(), 25u);  // 0.49^25 m is 2e-8 m
  for (std::size_t i = 0; i < hits.size(); ++i)
    EXPECT_NEAR(hits[i]->time, ball.contact(static_cast<int>(i)), 1e-14 * static_cast<double>(i + 1));
}

TEST(Bounce, AMethodThatBeginsWithLowOrderInventsNoHit) {
  // After each bounce a multistep method begins at order 1: to its tolerance, its first Segments may dip into the
  // ground.
  const auto run = [](const Way& way) {
    return test::run_text("[time]\nend = 12\n[method]\n" + way.lines + R"(
[[body]]
name = "ball"
shape = "sphere"
radius = 0.1
position = [0, 0, 1]
velocity = [1, 0, 0]
acceleration = "[0, 0, -9.8] - 0.01*v"
)" + kBouncingGround + "restitution = 0.8\n");
  };
  const RunResult reference = run(test::controlled("taylor", 1e-12));
  // a method that sees smaller flights follows more of them
  const std::size_t most = 3 * test::impacts_of(reference, ImpactKind::hit).size() / 2;
  for (const std::string method : {"adams", "bdf"})
    for (const double tolerance : {1e-4, 1e-6, 1e-9}) {
      const Way way = test::controlled(method, tolerance);
      const RunResult result = run(way);
      ASSERT_EQ(result.status, RunStatus::finished) << way.name << result.failure;
      const auto hits = test::impacts_of(result, ImpactKind::hit);
      EXPECT_GT(hits.size(), 10u) << way.name;
      EXPECT_LE(hits.size(), most) << way.name;
      for (const Impact* hit : hits) EXPECT_LT(hit->velocity_before.dot(hit->normal), 0.0) << way.name;
      // the errors of the steps of four flights
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(hits[i]->time, reference.impacts[i].time, 100.0 * tolerance) << way.name;
      EXPECT_EQ(test::impacts_of(result, ImpactKind::rest).size(), 1u) << way.name;
      EXPECT_NEAR(test::final_of(result, "ball").position.z(), 0.1, 100.0 * tolerance) << way.name;
    }
}

TEST(Bounce, NoRestitutionComesToRestAtOnce) {
  const RunResult result = Bouncing{9.81, 1.0, 0.0, 0.0}.run(test::long_controlled_and_short_steps()[0], 2.0);
  ASSERT_EQ(result.impacts.size(), 2u);
  EXPECT_EQ(result.impacts[0].kind, ImpactKind::hit);
  EXPECT_EQ(result.impacts[1].kind, ImpactKind::rest);
  EXPECT_EQ(result.impacts[0].time, result.impacts[1].time);
  EXPECT_EQ(test::final_of(result, "ball").velocity, Vector3(1, 0, 0));
}

TEST(Bounce, AnElasticBallKeepsItsEnergy) {
  for (const Way& way : test::long_controlled_and_short_steps()) {
    const RunResult result = Bouncing{9.81, 1.0, 0.0, 1.0}.run(way, 300.0);
    ASSERT_EQ(result.status, RunStatus::finished) << way.name << result.failure;
    // a flight lasts 2 * 0.4515 s
    EXPECT_EQ(result.impacts.size(), 332u) << way.name;
    const BodyState& ball = test::final_of(result, "ball");
    const double energy = 9.81 * ball.position.z() + 0.5 * ball.velocity.z() * ball.velocity.z();
    // Rounding adds a few 1e-15 J/kg in each of some thousand steps.
    EXPECT_NEAR(energy, 9.81, 1e-11) << way.name;
    for (const Impact& impact : result.impacts) {
      EXPECT_EQ(impact.kind, ImpactKind::hit);
      EXPECT_NEAR(impact.velocity_after.z(), std::sqrt(2.0 * 9.81), 1e-12);
    }
  }
}

TEST(Bounce, ImpulseIsTheChangeOfMomentum) {
  const RunResult result = test::run_text(R"(
[time]
end = 1.5
[[body]]
name = "ball"
position = [0, 0, 4.9]
velocity = [2, 0, 0]
force = [0, 0, "-9.8*mass"]
mass = "3 + t"
[[state]]
name = "mass"
value = 3
rate = 1
)" + kBouncingGround + "restitution = 0.5\n");
  ASSERT_EQ(result.impacts.size(), 1u);
  const Impact& hit = result.impacts[0];
  EXPECT_NEAR(hit.time, 1.0, 1e-15);
  EXPECT_NEAR(hit.velocity_before.z(), -9.8, 1e-14);
  EXPECT_NEAR(hit.velocity_after.z(), 4.9, 1e-14);
  EXPECT_NEAR(hit.impulse.z(), 4.0 * 14.7, 1e-12);
  EXPECT_EQ(hit.impulse.x(), 0.0);
}

}  // namespace
}  // namespace trajet
