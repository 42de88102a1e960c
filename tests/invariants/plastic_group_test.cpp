// The perfectly inelastic impact on several surfaces at once: the projection on a cone, whatever the order.

#include "trajet/collide/respond/plastic_group.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "scene_run.hpp"

namespace trajet::test {
namespace {

Vector3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

Vector3 after(const std::vector<Vector3>& normals, const std::vector<double>& impulses, Vector3 velocity) {
  for (std::size_t i = 0; i < normals.size(); ++i) velocity += impulses[i] * normals[i];
  return velocity;
}

/// The conditions by which the projection is the only one: they are its proof.
TEST(PlasticGroup, IsTheNearestVelocityThatAllSurfacesLetPass) {
  std::mt19937 random(1);
  for (int sample = 0; sample < 100'000; ++sample) {
    std::vector<Vector3> normals(1 + random() % 6);
    for (Vector3& normal : normals) normal = random_vector(random).normalized();
    if (sample % 3 == 0) normals.push_back(normals.front());  // two faces of one plane
    const Vector3 velocity = random_vector(random);
    const std::vector<double> impulses = plastic_impulses(normals, velocity);
    const Vector3 left = after(normals, impulses, velocity);
    // Nearly parallel surfaces answer with large impulses, whose square bounds the condition of their equations.
    const double largest = 1.0 + *std::max_element(impulses.begin(), impulses.end());
    const double rounding = 1e-13 * largest * largest * velocity.norm();
    for (std::size_t i = 0; i < normals.size(); ++i) {
      ASSERT_GE(impulses[i], 0.0) << sample;
      ASSERT_GE(left.dot(normals[i]), -rounding) << sample;
      ASSERT_NEAR(impulses[i] * left.dot(normals[i]), 0.0, rounding) << sample;
    }
    ASSERT_LE(left.norm(), velocity.norm() * (1.0 + rounding)) << sample;
    std::vector<Vector3> other(normals.rbegin(), normals.rend());
    ASSERT_NEAR((after(other, plastic_impulses(other, velocity), velocity) - left).norm(), 0.0, 100.0 * rounding)
        << sample;
  }
}

/// Into the corner of two and of three planes, in any order in the file: what is left goes along all that it met.
TEST(PlasticGroup, OfARunDoesNotDependOnTheOrderOfTheFile) {
  std::mt19937 random(2);
  for (int sample = 0; sample < 300; ++sample) {
    std::vector<Vector3> normals;
    const Vector3 velocity = random_vector(random);
    while (normals.size() < 2 + static_cast<std::size_t>(sample % 2)) {
      const Vector3 normal = random_vector(random).normalized();
      if (normal.dot(velocity) < -0.1) normals.push_back(normal);
    }
    const Vector3 start = -velocity;  // at t = 1 in the corner at the origin
    const auto run_in = [&](std::vector<std::size_t> order) {
      std::string scene = "[time]\nend = 2\n[[body]]\nname = \"p\"\nposition = [";
      for (int i = 0; i < 3; ++i) scene += number(start[i]) + (i < 2 ? ", " : "]\nvelocity = [");
      for (int i = 0; i < 3; ++i) scene += number(velocity[i]) + (i < 2 ? ", " : "]\n");
      for (const std::size_t k : order)
        scene += "[[obstacle]]\nname = \"w" + std::to_string(k) +
                 "\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [" + number(normals[k].x()) + ", " +
                 number(normals[k].y()) + ", " + number(normals[k].z()) + "]\non_hit = \"bounce\"\nrestitution = 0\n";
      return run_text(scene);
    };
    std::vector<std::size_t> order(normals.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const Vector3 expected = after(normals, plastic_impulses(normals, velocity), velocity);
    do {
      const RunResult result = run_in(order);
      ASSERT_EQ(result.status, RunStatus::finished) << sample << ": " << result.failure;
      EXPECT_NEAR((final_of(result, "p").velocity - expected).norm(), 0.0, 1e-9) << sample;
      Vector3 impulses = Vector3::Zero();
      for (const Impact& impact : result.impacts) impulses += impact.impulse;
      EXPECT_NEAR((velocity + impulses - expected).norm(), 0.0, 1e-9) << sample;
    } while (std::ranges::next_permutation(order).found);
  }
}

}  // namespace
}  // namespace trajet::test
