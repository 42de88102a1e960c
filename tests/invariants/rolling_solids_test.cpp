// Solids with round surfaces that stay on flat faces: cylinders, coins and eggs that roll.

#include <gtest/gtest.h>

#include <cmath>

#include "scene_run.hpp"

namespace trajet {
namespace {

using test::number;
using test::vector;

constexpr double kGravity = 9.81;

/// A body of 1 kg on a rough plane through the origin.
std::string on_plane(double end, const std::string& body, const Vector3& normal) {
  return "[time]\nend = " + number(end) + "\n[[body]]\nname = \"body\"\nmass = 1\nforce = [0, 0, " + number(-kGravity) +
         "]\n" + body +
         "[[obstacle]]\nname = \"plane\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = " + vector(normal) +
         "\non_hit = \"bounce\"\nrestitution = 0\nfriction = 5\n";
}

TEST(RollingSolids, ACylinderRollsDownWithTwoThirdsOfThePull) {
  const double angle = 0.3, radius = 0.1, end = 1.5;
  const Vector3 normal(-std::sin(angle), 0, std::cos(angle)), down(-std::cos(angle), 0, -std::sin(angle));
  const RunResult result = test::run_text(on_plane(
      end,
      "shape = \"cylinder\"\nradius = 0.1\nheight = 0.5\norientation = {axis = [1, 0, 0], angle = \"90 deg\"}\n"
      "position = " +
          vector(radius * normal) + "\n",
      normal));
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  ASSERT_EQ(result.contacts.size(), 1u);
  EXPECT_EQ(result.contacts[0].mode, ImpactKind::roll);
  const BodyState& body = test::final_of(result, "body");
  EXPECT_NEAR(body.velocity.dot(down), 2.0 / 3.0 * kGravity * std::sin(angle) * end, 1e-11);
  EXPECT_NEAR(body.angular_velocity.norm(), body.velocity.norm() / radius, 1e-10);
}

double energy_of(const BodyState& body, const Vector3& inertia) {
  const Vector3 w = body.rotation_matrix.transpose() * body.angular_velocity;
  return 0.5 * body.velocity.squaredNorm() + 0.5 * w.dot(inertia.cwiseProduct(w)) + kGravity * body.position.z();
}

struct States : RunObserver {
  std::vector<BodyState> all;
  void sample(const Sample& sample) override { all.push_back(sample.bodies[0]); }
};

// What rolls without slip and without rolling friction loses nothing; its lowest point stays on the plane.
TEST(RollingSolids, AnEggThatRocksAndRollsKeepsItsEnergy) {
  const Vector3 radii(0.2, 0.06, 0.04);
  States states;
  const RunResult result =
      test::run_text(on_plane(2.0,
                              "shape = \"ellipsoid\"\nradii = [0.2, 0.06, 0.04]\nposition = [0, 0, 0.04]\n"
                              "velocity = [0.012, -0.02, 0]\nangular_velocity = [0.5, 0.3, 0]\n",
                              Vector3::UnitZ()),
                     &states);
  ASSERT_EQ(result.status, RunStatus::finished) << result.failure;
  EXPECT_EQ(result.contacts.back().mode, ImpactKind::roll);
  const Vector3 squares = radii.cwiseProduct(radii);
  const Vector3 inertia =
      0.2 * Vector3(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y());
  const BodyState &first = states.all[states.all.size() / 4], &last = states.all.back();
  EXPECT_NEAR(energy_of(last, inertia), energy_of(first, inertia), 1e-9);
  for (const BodyState& each : states.all) {
    const Vector3 up = each.rotation_matrix.transpose() * Vector3::UnitZ();
    EXPECT_NEAR(each.position.z(), radii.cwiseProduct(up).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace trajet
