// Resting and sliding through whole runs, and how rests end.

#include <gtest/gtest.h>

#include <cmath>

#include "bouncing_ground.hpp"

namespace trajet {
namespace {

using test::kBouncingGround;
using test::Way;

TEST(Rest, OnAnInclineItSlidesAsGravityPulls) {
  // alpha = 30 degrees: a = g sin(alpha) along the slope
  for (const Way& way : test::long_controlled_and_short_steps()) {
    const RunResult result = test::run_text("[time]\nend = 6\n[method]\n" + way.lines + R"(
[[body]]
name = "ball"
shape = "sphere"
radius = 0.1
position = "1.1*[sin(alpha), 0, cos(alpha)]"
acceleration = [0, 0, -9.8]
[parameters]
alpha = "30 deg"
[[obstacle]]
name = "slope"
shape = "plane"
point = [0, 0, 0]
normal = "[sin(alpha), 0, cos(alpha)]"
on_hit = "bounce"
restitution = 0.5
)");
    ASSERT_EQ(result.status, RunStatus::finished) << way.name << result.failure;
    const auto rests = test::impacts_of(result, ImpactKind::rest);
    ASSERT_EQ(rests.size(), 1u) << way.name;
    const BodyState& ball = test::final_of(result, "ball");
    const Vector3 along(std::cos(M_PI / 6.0), 0.0, -std::sin(M_PI / 6.0));
    // Frictionless bounces leave the motion along the slope alone: s = g sin(alpha) t^2 / 2 from the start, v = g
    // sin(alpha) t.
    EXPECT_NEAR(ball.position.dot(along), 9.8 * 0.5 * 18.0, 1e-11) << way.name;
    EXPECT_NEAR(ball.velocity.dot(along), 9.8 * 0.5 * 6.0, 1e-11) << way.name;
    EXPECT_NEAR(ball.position.dot(Vector3(std::sin(M_PI / 6.0), 0, std::cos(M_PI / 6.0))), 0.1, 1e-9) << way.name;
    EXPECT_NEAR(ball.acceleration.norm(), 4.9, 1e-12) << way.name;
  }
}

TEST(Rest, OnABoxItSlidesOffTheEdgeAndFalls) {
  for (const Way& way : test::long_controlled_and_short_steps()) {
    const RunResult result = test::run_text("[time]\nend = 20\n[method]\n" + way.lines + R"(
[[body]]
name = "ball"
position = [0, 0.1, 2]
velocity = [0.5, 0, 0]
acceleration = [0, 0, -9.8]
[[obstacle]]
name = "table"
shape = "box"
center = [0, 0, 0.5]
size = [6, 2, 1]
on_hit = "bounce"
restitution = 0.5
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
on_hit = "stop"
)");
    SCOPED_TRACE(way.name);
    ASSERT_EQ(result.status, RunStatus::stopped) << result.failure;
    const auto rests = test::impacts_of(result, ImpactKind::rest);
    const auto leaves = test::impacts_of(result, ImpactKind::leave);
    ASSERT_EQ(rests.size(), 1u);
    ASSERT_EQ(leaves.size(), 1u);
    const double fall = std::sqrt(2.0 / 9.8);
    // fall + 2 e fall / (1 - e). The flights end 1e-10 m high: a height of 1 m that is rounded by 1e-16 m changes their
    // speed of 5e-5 m/s by up to 1e-11 m/s, and so the duration of all that follow.
    EXPECT_NEAR(rests[0]->time, 3.0 * fall, 1e-11);
    EXPECT_NEAR(leaves[0]->time, 6.0, 1e-12);  // 3 m at 0.5 m/s
    EXPECT_NEAR(leaves[0]->position.z(), 1.0, 1e-9);
    EXPECT_EQ(leaves[0]->with, "table");
    // It rests within the last flight's height of the table's top.
    EXPECT_EQ(result.impacts.back().with, "ground");
    EXPECT_NEAR(result.end_time, 6.0 + fall, 1e-9);
    EXPECT_NEAR(test::final_of(result, "ball").position.x(), 3.0 + 0.5 * fall, 1e-9);
  }
}

/// A table that looks up at z = 0, with an edge at x = 1.
std::vector<std::string> tables() {
  return {"shape = \"rectangle\"\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nup = [0, 1, 0]\nsize = [2, 4]\n",
          "shape = \"rectangle\"\ncenter = [0, 0, 0]\nnormal = [0, 0, -1]\nup = [0, 1, 0]\nsize = [2, 4]\n",
          "shape = \"disk\"\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 1\n",
          "shape = \"triangle\"\npoints = [[1, -3, 0], [1, 3, 0], [-9, 0, 0]]\n",
          "shape = \"box\"\ncenter = [0, 0, -0.5]\nsize = [2, 4, 1]\n"};
}

std::string on_table(const std::string& table, const std::string& body) {
  return "[time]\nend = 20\n[[body]]\nname = \"ball\"\nacceleration = [0, 0, -9.8]\n" + body +
         "[[obstacle]]\nname = \"table\"\non_hit = \"bounce\"\nrestitution = 0\n" + table +
         "[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, -4.9]\nnormal = [0, 0, 1]\n";
}

TEST(Rest, APointFallsPastTheEdge) {
  const double slide = 0.1;  // s to the edge
  const double fall = 1.0;
  for (const std::string& table : tables())
    for (const double speed : {1e-6, 0.3, 7.0}) {
      SCOPED_TRACE(table + test::number(speed));
      const RunResult result =
          test::run_text(on_table(table, "position = [" + test::number(1.0 - slide * speed) +
                                             ", 0, 1e-9]\nvelocity = [" + test::number(speed) + ", 0, 0]\n"));
      ASSERT_EQ(result.status, RunStatus::stopped) << result.failure;
      EXPECT_EQ(test::impacts_of(result, ImpactKind::leave).size(), 1u);
      EXPECT_EQ(result.impacts.back().with, "ground");
      EXPECT_NEAR(result.end_time, slide + fall, 1e-9);  // the edge is known to 1e-16 m, at 1e-6 m/s
    }
}

TEST(Rest, ABallTooSlowForTheEdgeSlidesRoundIt) {
  // Past the edge it flies off where v^2 > g r, else it slides round the edge, and falls later; edges of meshes say that
  // they are not followed.
  for (const std::string& table : tables())
    for (const double speed : {0.5, 2.0}) {
      SCOPED_TRACE(table + test::number(speed));
      const RunResult result = test::run_text(
          on_table(table, "shape = \"sphere\"\nradius = 0.1\nposition = [" + test::number(1.0 - 0.25 * speed) +
                              ", 0, 0.1]\nvelocity = [" + test::number(speed) + ", 0, 0]\n"));
      if (speed * speed > 9.8 * 0.1) {
        EXPECT_EQ(result.status, RunStatus::stopped) << result.failure;
        EXPECT_NEAR(result.end_time, 1.25, 1e-9);
      } else if (result.status == RunStatus::failed) {
        EXPECT_NE(result.failure.find("edge"), std::string::npos) << result.failure;
        EXPECT_NEAR(result.end_time, 0.25, 1e-7);
      } else {
        EXPECT_EQ(result.status, RunStatus::stopped);
        EXPECT_GT(result.end_time, 1.25);
      }
    }
}

TEST(Rest, ABallFastEnoughFliesFreeOffTheEdge) {
  // Down a plate of tilt tan(alpha) = 1/n. Past the edge the gap opens as (v^2/r - g cos(alpha)) t^2 / 2, from nothing.
  for (const Way& way : test::long_controlled_and_short_steps())
    for (const double n : {2.0, 3.0, 7.0})
      for (const double radius : {0.05, 0.2}) {
        SCOPED_TRACE(way.name + " " + test::number(n) + " " + test::number(radius));
        const double norm = std::hypot(1.0, n);
        const Vector3 normal(1.0 / norm, 0.0, n / norm), down(n / norm, 0.0, -1.0 / norm);
        const RunResult result = test::run_text("[time]\nend = 3\n[method]\n" + way.lines + R"(
[[body]]
name = "ball"
shape = "sphere"
velocity = [0, -1, 0]
acceleration = [0, 0, -9.8]
radius = )" + test::number(radius) + "\nposition = [" +
                                                test::number((radius + 0.1) * normal.x()) + ", 0, " +
                                                test::number((radius + 0.1) * normal.z()) + R"(]
[[obstacle]]
name = "plate"
shape = "rectangle"
center = [0, 0, 0]
up = [0, 1, 0]
size = [4, 40]
on_hit = "bounce"
restitution = 0
normal = [1, 0, )" + test::number(n) + "]\n");
        ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
        ASSERT_EQ(result.impacts.size(), 3u);
        EXPECT_EQ(result.impacts[0].kind, ImpactKind::hit);
        EXPECT_EQ(result.impacts[1].kind, ImpactKind::rest);
        EXPECT_EQ(result.impacts[2].kind, ImpactKind::leave);
        // along the plate it falls freely: 2 m = g sin(alpha) t^2 / 2
        const double leave = std::sqrt(4.0 / (9.8 / norm));
        EXPECT_NEAR(result.impacts[2].time, leave, 1e-12);
        const double flight = 3.0 - leave;
        const Vector3 end = 2.0 * down + radius * normal + 9.8 / norm * leave * flight * down - Vector3(0, 3, 0) +
                            0.5 * flight * flight * Vector3(0, 0, -9.8);
        EXPECT_NEAR((test::final_of(result, "ball").position - end).norm(), 0.0, 1e-10);
      }
}

TEST(Rest, AFloorOfTilesCarriesOnToItsEnd) {
  for (const std::string ball :
       {"position = [0, 0, 1e-3]\n", "shape = \"sphere\"\nradius = 0.1\nposition = [0, 0, 0.101]\n"})
    for (const bool is_thin : {true, false}) {
      std::string floor;
      for (int i = 0; i < 4; ++i) {
        const std::string x = std::to_string(i);
        floor += "[[obstacle]]\nname = \"tile" + x + "\"\non_hit = \"bounce\"\nrestitution = 0\ncenter = [" + x;
        // every other one upside down
        floor += is_thin ? ", 0, 0]\nshape = \"rectangle\"\nup = [0, 1, 0]\nsize = [1, 1]\nnormal = [0, 0, " +
                               std::string(i % 2 == 0 ? "1" : "-1") + "]\n"
                         : ", 0, -0.5]\nshape = \"box\"\nsize = [1, 1, 1]\n";
      }
      const RunResult result = test::run_text(
          "[time]\nend = 5\n[[body]]\nname = \"ball\"\nvelocity = [1, 0, 0]\nacceleration = [0, 0, -9.8]\n" + ball +
          floor);
      ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
      const auto leaves = test::impacts_of(result, ImpactKind::leave);
      ASSERT_EQ(leaves.size(), 4u);
      for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(leaves[static_cast<std::size_t>(i)]->with, "tile" + std::to_string(i));
        EXPECT_NEAR(leaves[static_cast<std::size_t>(i)]->time, 0.5 + i, 1e-14);
      }
      const BodyState& end = test::final_of(result, "ball");
      EXPECT_NEAR(end.position.x(), 5.0, 1e-13);
      EXPECT_NEAR(end.velocity.z(), -9.8 * 1.5, 1e-12);
    }
}

TEST(Rest, EndsWhereTheLawTurnsOverAtOnce) {
  for (const Way& way : test::long_controlled_and_short_steps()) {
    const RunResult result = test::run_text("[time]\nend = 4\n[method]\n" + way.lines + R"(
[[body]]
name = "ball"
position = [0, 0, 0]
acceleration = "[0, 0, where(t < 2, -9.8, 1)]"
)" + kBouncingGround + "restitution = 0\n");
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    const auto leaves = test::impacts_of(result, ImpactKind::leave);
    ASSERT_EQ(leaves.size(), 1u) << way.name;
    EXPECT_NEAR(leaves[0]->time, 2.0, 1e-13) << way.name;
    EXPECT_NEAR(test::final_of(result, "ball").position.z(), 2.0, 1e-12) << way.name;
  }
}

TEST(Rest, EndsWhereAnEventSetsTheBodyFree) {
  struct Case {
    const char* set;
    std::size_t hits;  // after the event
    double height;     // at the end
  };
  // at rest on the ground until t = 1; g = 9.8
  const Case cases[] = {{"ball.vz = \"4.9\"", 0, 4.9 * 0.8 - 4.9 * 0.64},
                        {"ball.z = \"4.9\"", 0, 4.9 - 4.9 * 0.64},
                        {"ball.vz = \"-9.8\"", 1, 4.9 * 0.8 - 4.9 * 0.64},
                        {"g = \"-2\"", 0, 0.64},
                        {"ball.vx = \"3\"", 0, 0.0}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.set);
    const RunResult result = test::run_text(R"(
[time]
end = 1.8
[[state]]
name = "g"
value = 9.8
rate = 0
[[body]]
name = "ball"
position = [0, 0, 0]
acceleration = "[0, 0, -g]"
[[event]]
name = "kick"
when = "t - 1"
set = { )" + std::string(c.set) + " }\n" + kBouncingGround +
                                            "restitution = 0.5\n");
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    EXPECT_EQ(test::impacts_of(result, ImpactKind::hit).size(), c.hits);
    EXPECT_EQ(test::impacts_of(result, ImpactKind::leave).size(), c.height > 0.0 && c.hits == 0 ? 1u : 0u);
    EXPECT_NEAR(test::final_of(result, "ball").position.z(), c.height, 1e-13);
  }
}

TEST(Rest, EndsWhenTheLawPullsAway) {
  // Gravity turns over at t = 3: the ball leaves the ground then.
  const RunResult result = test::run_text(R"(
[time]
end = 4
[[body]]
name = "ball"
position = [0, 0, 1]
acceleration = [0, 0, "t - 3"]
)" + kBouncingGround + "restitution = 0\n");
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  const auto leaves = test::impacts_of(result, ImpactKind::leave);
  ASSERT_EQ(leaves.size(), 1u);
  EXPECT_NEAR(leaves[0]->time, 3.0, 1e-14);
  // z = (t - 3)^3 / 6
  EXPECT_NEAR(test::final_of(result, "ball").position.z(), 1.0 / 6.0, 1e-13);
}

/// A plane of the scene that bounces, through the origin or another point.
std::string plane(const std::string& name, const std::string& normal, double restitution,
                  const std::string& point = "[0, 0, 0]") {
  return "[[obstacle]]\nname = \"" + name + "\"\nshape = \"plane\"\npoint = " + point + "\nnormal = " + normal +
         "\non_hit = \"bounce\"\nrestitution = " + test::number(restitution) + "\n";
}

TEST(Rest, InAGrooveOfTwoPlanesItStaysAtTheBottom) {
  // Planes that are not orthogonal, wider and narrower; the ball keeps its speed along the groove.
  for (const double restitution : {0.0, 0.5}) {
    for (const char* right : {"[-1, 0, 1]", "[-1, 0, 3]", "[-3, 0, 1]"}) {
      const RunResult result = test::run_text(R"(
[time]
end = 12
[[body]]
name = "ball"
position = [0, 0, 1]
velocity = [0.3, 0.1, 0]
acceleration = [0, 0, -9.8]
)" + plane("left", "[1, 0, 1.5]", restitution) +
                                              plane("right", right, restitution));
      SCOPED_TRACE(std::string(right) + " " + test::number(restitution));
      ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
      const BodyState& ball = test::final_of(result, "ball");
      // It comes to rest within the last flight's height of each plane, 1e-10 m.
      EXPECT_LT((ball.position - Vector3(0, 1.2, 0)).norm(), 1e-9);
      EXPECT_LT((ball.velocity - Vector3(0, 0.1, 0)).norm(), 1e-12);
      EXPECT_LT(ball.acceleration.norm(), 1e-12);
    }
  }
}

TEST(Rest, ARampThrowsARestingBallUp) {
  // On the floor at 1 m/s against a ramp of 45 degrees: v+ = v - (1 + e)(v . n) n
  const RunResult result = test::run_text(R"(
[time]
end = 2.05
[[body]]
name = "ball"
velocity = [1, 0, 0]
acceleration = [0, 0, -9.8]
)" + plane("floor", "[0, 0, 1]", 0.0) + plane("ramp", "[-1, 0, 1]", 0.9, "[2, 0, 0]"));
  // It rests from the start.
  ASSERT_EQ(result.impacts.size(), 3u);
  EXPECT_EQ(result.impacts[0].kind, ImpactKind::rest);
  EXPECT_EQ(result.impacts[1].with, "ramp");
  EXPECT_NEAR(result.impacts[1].time, 2.0, 1e-15);
  EXPECT_NEAR(result.impacts[1].velocity_after.x(), 0.05, 1e-15);
  EXPECT_NEAR(result.impacts[1].velocity_after.z(), 0.95, 1e-15);
  EXPECT_EQ(result.impacts[2].kind, ImpactKind::leave);
  EXPECT_EQ(result.impacts[2].with, "floor");
  EXPECT_NEAR(test::final_of(result, "ball").position.z(), 0.95 * 0.05 - 4.9 * 0.05 * 0.05, 1e-14);
}

TEST(Rest, APushUpARampLiftsItOffTheFloor) {
  // Held on the floor, pushed to a ramp that it reaches with no speed: the push is stronger than the weight's part
  // along the ramp, so the ball climbs, and the floor does not hold it back.
  const RunResult result = test::run_text(R"(
[time]
end = 4
[[body]]
name = "ball"
position = [1, 0, 0]
acceleration = ['where(t < 1, 0, 20)', 0, -9.8]
)" + plane("floor", "[0, 0, 1]", 0.0) + plane("ramp", "[-1, 0, 1]", 0.0, "[1, 0, 0]"));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  // along (1, 0, 1)/sqrt 2: a = (20 - 9.8)/sqrt 2; x - 1 = a/sqrt 2 (t - 1)^2/2
  const BodyState& ball = test::final_of(result, "ball");
  EXPECT_NEAR(ball.position.x(), 1.0 + 5.1 * 4.5, 1e-9);
  EXPECT_NEAR(ball.position.z(), 5.1 * 4.5, 1e-9);
}

TEST(Rest, SlidesIntoAWallAndBack) {
  const RunResult result = test::run_text(R"(
[time]
end = 5
[[body]]
name = "ball"
shape = "sphere"
radius = 0.25
position = [0.25, 0, 0.25]
velocity = [1, 0, 0]
acceleration = [0, 0, -9.8]
)" + plane("floor", "[0, 0, 1]", 0.0) + plane("wall", "[-1, 0, 0]", 0.5, "[2.25, 0, 0]"));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  EXPECT_TRUE(test::impacts_of(result, ImpactKind::leave).empty());
  const BodyState& ball = test::final_of(result, "ball");
  EXPECT_NEAR(ball.position.x(), 2.0 - 0.5 * (5.0 - 1.75), 1e-14);
  EXPECT_EQ(ball.velocity, Vector3(-0.5, 0, 0));
  EXPECT_NEAR(ball.position.z(), 0.25, 1e-14);
}

}  // namespace
}  // namespace trajet
