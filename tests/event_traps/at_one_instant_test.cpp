// Contacts of one body with several obstacles at one instant: through whole runs.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::run_text;
using test::vector;
using test::Way;

std::vector<Way> ways() {
  return {{"taylor", "name = \"taylor\"\n"},
          {"dopri5", "name = \"dopri5\"\n"},
          {"dop853", "name = \"dop853\"\n"},
          test::fixed("rk4", 0.25),
          test::fixed("rk4", 0.07)};
}

std::string rectangle(const std::string& name, const Vector3& center, const Vector3& normal, const Vector3& up,
                      const std::string& on_hit) {
  return "[[obstacle]]\nname = \"" + name + "\"\nshape = \"rectangle\"\ncenter = " + vector(center) +
         "\nnormal = " + vector(normal) + "\nup = " + vector(up) + "\nsize = [2.0, 2.0]\non_hit = \"" + on_hit + "\"\n";
}

std::string ball(double radius, const Vector3& position, const Vector3& velocity, const std::string& acceleration) {
  return "[[body]]\nname = \"ball\"\nposition = " + vector(position) + "\nvelocity = " + vector(velocity) +
         "\nacceleration = " + acceleration + "\n" +
         (radius > 0.0 ? "shape = \"sphere\"\nradius = " + test::number(radius) + "\n" : "");
}

int count(const RunResult& result, const std::string& with) {
  int n = 0;
  for (const Impact& impact : result.impacts) n += impact.with == with && impact.kind == ImpactKind::hit;
  return n;
}

TEST(AtOneInstant, ACornerOfRectanglesTurnsAPointBack) {
  const std::string wall_x = rectangle("wall_x", {0, -1, 0}, {-1, 0, 0}, {0, 0, 1}, "bounce");
  for (const std::string on_hit : {"bounce", "stop", "pass"}) {
    const std::string wall_y = rectangle("wall_y", {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, on_hit);
    for (const Way& way : ways()) {
      for (const std::string& walls : {wall_x + wall_y, wall_y + wall_x}) {
        for (const double radius : {0.0, 0.125}) {
          SCOPED_TRACE(way.name + " " + on_hit + " " + test::number(radius));
          const RunResult result = run_text("[time]\nend = 3\n[method]\n" + way.lines +
                                            ball(radius, {-1, -1, 0}, {1, 1, 0}, "[0, 0, 0]") + walls);
          ASSERT_NE(result.status, RunStatus::failed) << result.failure;
          EXPECT_EQ(count(result, "wall_x"), 1);
          // the ball that has gone through the wall leaves its reach again
          EXPECT_EQ(count(result, "wall_y"), on_hit == "pass" && radius > 0.0 ? 2 : 1);
          // what bounces off both at once does so whatever their order; else rounding decides which is first
          EXPECT_EQ(result.warnings.empty(), on_hit == "bounce");
          // there and back at 1 m/s in each direction
          const double back = -2.0 - 2.0 * radius;
          const Vector3 end = on_hit == "bounce" ? Vector3(back, back, 0)
                              : on_hit == "stop" ? Vector3(-radius, -radius, 0)
                                                 : Vector3(back, 2, 0);
          EXPECT_NEAR((test::final_of(result, "ball").position - end).norm(), 0.0, 1e-13);
        }
      }
    }
  }
}

TEST(AtOneInstant, ADiskInTheGroundIsMetWithIt) {
  // The second contact is 2 e sqrt(2 h / g) behind the first, at x = 0.5 (1 + 2 e) sqrt(2 h / g) = 0.497 m.
  const std::string ground =
      "[[obstacle]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
      "on_hit = \"bounce\"\nrestitution = 0.6\n";
  const double second = (1.0 + 2.0 * 0.6) * std::sqrt(2.0 / 9.8);
  for (const std::string on_hit : {"bounce", "stop", "pass"}) {
    const std::string disk =
        "[[obstacle]]\nname = \"disk\"\nshape = \"disk\"\ncenter = [0.5, 0, 0]\nnormal = [0, 0, 1]\nradius = 0.1\n"
        "on_hit = \"" +
        on_hit + "\"\n" + (on_hit == "bounce" ? "restitution = 0.6\n" : "");
    for (const Way& way : ways()) {
      for (const std::string& obstacles : {ground + disk, disk + ground}) {
        for (const double radius : {0.0, 0.125}) {
          SCOPED_TRACE(way.name + " " + on_hit + " " + test::number(radius));
          const RunResult result =
              run_text("[time]\nend = 1.3\n[method]\n" + way.lines +
                       ball(radius, {0, 0, 1.0 + radius}, {0.5, 0, 0}, "[0, 0, -9.8]") + obstacles);
          ASSERT_NE(result.status, RunStatus::failed) << result.failure;
          EXPECT_FALSE(result.warnings.empty());
          // Two faces in one plane bounce it once, whichever it is.
          EXPECT_EQ(count(result, "ground") + count(result, "disk"), on_hit == "bounce" ? 2 : 3);
          EXPECT_EQ(result.status, on_hit == "stop" ? RunStatus::stopped : RunStatus::finished);
          EXPECT_NEAR(result.impacts.back().time, second, 1e-11);
          if (on_hit == "bounce") continue;
          EXPECT_EQ(result.impacts[1].with, "ground");
          EXPECT_EQ(result.impacts[2].with, "disk");
          EXPECT_EQ(result.impacts[2].velocity_after, result.impacts[2].velocity_before);
          EXPECT_LT(result.impacts[2].velocity_before.z(), 0.0);
        }
      }
    }
  }
}

TEST(AtOneInstant, NothingLeavesAClosedRoom) {
  // A room of six rectangles, turned at random: at its inside, its edges and its corners.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::uniform_int_distribution<int> aim(0, 3);
  for (int run = 0; run < 300; ++run) {
    const Eigen::Quaterniond turn =
        run % 3 == 0
            ? Eigen::Quaterniond::Identity()
            : Eigen::Quaterniond(uniform(random), uniform(random), uniform(random), uniform(random)).normalized();
    const Eigen::Matrix3d R = turn.toRotationMatrix();
    const Vector3 center = run % 2 == 0 ? Vector3(0, 0, 0) : Vector3(uniform(random), uniform(random), uniform(random));
    const double radius = run % 5 == 4 ? 0.125 : 0.0;
    std::string room;
    for (int face = 0; face < 6; ++face) {
      const Vector3 normal = (face < 3 ? 1.0 : -1.0) * R.col(face % 3);
      room += rectangle("wall" + std::to_string(face), center + normal, run % 4 < 2 ? normal : Vector3(-normal),
                        R.col((face + 1) % 3), "bounce");
    }
    // of a coordinate that is aimed at, the ball's surface comes to a wall at t = 1
    const Vector3 start(0.5 * uniform(random), 0.5 * uniform(random), 0.5 * uniform(random));
    Vector3 goal(0.8 * uniform(random), 0.8 * uniform(random), 0.8 * uniform(random));
    const int aimed = aim(random);
    for (int i = 0; i < aimed; ++i) goal[i] = (goal[i] < 0.0 ? -1.0 : 1.0) * (1.0 - radius);
    const Way way = ways()[static_cast<std::size_t>(run) % ways().size()];
    const RunResult result = run_text("[time]\nend = 9\n[method]\n" + way.lines +
                                      ball(radius, center + R * start, R * (goal - start), "[0, 0, 0]") + room);
    SCOPED_TRACE(std::to_string(run) + " " + way.name + " aimed at " + std::to_string(aimed));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    const BodyState& end = test::final_of(result, "ball");
    // folded back at each wall, the straight path would be here
    Vector3 expected = start + 9.0 * (goal - start);
    const double reach = 1.0 - radius;
    for (double& x : expected) {
      x = std::remainder(x - reach, 4.0 * reach);
      x = std::abs(x) - reach;
    }
    EXPECT_NEAR((R.transpose() * (end.position - center) + expected).norm(), 0.0, 1e-11);
  }
}

}  // namespace
}  // namespace trajet
