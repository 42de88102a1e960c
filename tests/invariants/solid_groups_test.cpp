// Solids that touch at several points at once, and groups in which they lie on obstacles.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "body_scene.hpp"

namespace trajet::test {
namespace {

constexpr double kGravity = 9.81;

std::string square(const Vector3& center, double side, double restitution) {
  return "[[obstacle]]\nname = \"square\"\nshape = \"rectangle\"\ncenter = " + vector(center) +
         "\nnormal = [0, 0, 1]\nup = [0, 1, 0]\nsize = [" + number(side) + ", " + number(side) +
         "]\non_hit = \"bounce\"\nrestitution = " + number(restitution) + "\n";
}

std::string box(const std::string& name, const Vector3& size, const Vector3& position, const std::string& more) {
  return "[[body]]\nname = \"" + name + "\"\nshape = \"box\"\nsize = " + vector(size) +
         "\nmass = 2\nposition = " + vector(position) + "\n" + more;
}

const std::string kFalls = "acceleration = [0, 0, " + number(-kGravity) + "]\n";

double energy(const BodyState& body, double mass, const Vector3& inertia) {
  const Vector3 w_B = body.rotation_matrix.transpose() * body.angular_velocity;
  return mass * (0.5 * body.velocity.squaredNorm() + kGravity * body.position.z()) +
         0.5 * w_B.dot(inertia.cwiseProduct(w_B));
}

/// What stays under the centre of mass returns it as it came, wherever the middle of what touches is.
TEST(SolidGroups, ACubeDroppedFlatOnASmallerSquareReturnsWithoutSpin) {
  const double height = 1.0, fall = std::sqrt(2.0 * height / kGravity);
  for (const Vector3& center : {Vector3(0, 0, 0), Vector3(0.1, 0, 0), Vector3(0.12, -0.07, 0)}) {
    SCOPED_TRACE(vector(center));
    const RunResult result =
        run_text("[time]\nend = " + number(6.0 * fall) + "\n" +
                 box("cube", Vector3::Constant(1.0), {0, 0, height + 0.5}, kFalls) + square(center, 0.4, 1.0));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    EXPECT_EQ(result.impacts.size(), 3u);
    for (const Impact& impact : result.impacts) {
      EXPECT_NEAR(impact.impulse.norm(), 2.0 * 2.0 * std::sqrt(2.0 * kGravity * height), 1e-12);
      // where the impulse acts: under the centre of mass, else it would turn
      EXPECT_NEAR(Vector3(impact.point.x(), impact.point.y(), 0).norm(), 0.0, 1e-12);
      EXPECT_FALSE(impact.group);
    }
    const BodyState& cube = final_of(result, "cube");
    EXPECT_NEAR((cube.position - Vector3(0, 0, height + 0.5)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(cube.velocity.norm(), 0.0, 1e-12);
    EXPECT_NEAR(cube.angular_velocity.norm(), 0.0, 1e-12);
  }
}

/// Of a cube that hangs over, an edge of the square is hit alone: closed form of an impact at a distance d.
TEST(SolidGroups, ACubeThatHangsOverIsTurnedByTheEdge) {
  const double d = 0.25, height = 1.0, mass = 2.0, inertia = mass / 6.0;
  const double speed = std::sqrt(2.0 * kGravity * height), fall = speed / kGravity;
  const RunResult result =
      run_text("[time]\nend = " + number(fall + 0.02) + "\n" +
               box("cube", Vector3::Constant(1.0), {0, 0, height + 0.5}, kFalls) + square({-d - 0.2, 0, 0}, 0.4, 1.0));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_EQ(result.impacts.size(), 1u);
  const double impulse = 2.0 * speed / (1.0 / mass + d * d / inertia);
  EXPECT_NEAR(result.impacts[0].impulse.z(), impulse, 1e-12);
  EXPECT_NEAR(result.impacts[0].point.x(), -d, 1e-12);
  EXPECT_NEAR((result.impacts[0].angular_velocity_after - Vector3(0, impulse * d / inertia, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(energy(final_of(result, "cube"), mass, Vector3::Constant(inertia)), mass * kGravity * (height + 0.5),
              1e-12);
}

/// A box that lies on a floor without friction is hit from above: behind the impact energy has not grown, and
/// nothing goes through the floor.
TEST(SolidGroups, ABoxThatLiesIsHitFromAbove) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  const Vector3 size(1.0, 0.8, 0.4), squares = size.cwiseProduct(size);
  const Vector3 inertia =
      Vector3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y()) / 6.0;
  for (int sample = 0; sample < 20; ++sample) {
    SCOPED_TRACE(sample);
    const Vector3 over(0.45 * part(random), 0.35 * part(random), 0.75);
    const double e = sample % 2 == 0 ? 1.0 : 0.5;
    const std::string method = sample % 4 < 2 ? "" : "[method]\nsimultaneous = \"group\"\n";
    const RunResult result = run_text(
        "[time]\nend = 0.08\n" + method + box("box", size, {0, 0, 0.2}, kFalls + "restitution = " + number(e) + "\n") +
        BallOf{.name = "ball", .radius = 0.1, .mass = 0.5, .position = over, .velocity = {0, 0, -3}, .more = kFalls}
            .text() +
        plane("floor", Vector3::Zero(), Vector3::UnitZ(), e));
    ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
    const BodyState &hit = final_of(result, "box"), &ball = final_of(result, "ball");
    const double before = 0.5 * (0.5 * 9.0 + kGravity * over.z()) + 2.0 * kGravity * 0.2;
    const double after = energy(hit, 2.0, inertia) + energy(ball, 0.5, Vector3::Constant(0.4 * 0.5 * 0.01));
    EXPECT_LE(after, before * (1.0 + 1e-12));
    EXPECT_GE(after, e == 1.0 ? before * (1.0 - 1e-12) : 0.0);
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 p_B(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.4 : -0.4, corner & 4 ? 0.2 : -0.2);
      EXPECT_GE((hit.position + hit.rotation_matrix * p_B).z(), -1e-12);
    }
    EXPECT_NEAR(hit.velocity.head<2>().norm(), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace trajet::test
