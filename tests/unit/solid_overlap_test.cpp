// Whether two solids overlap, against solids whose overlap is known otherwise.

#include "trajet/geom/solid_overlap.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace trajet {
namespace {

Matrix3 random_rotation(std::mt19937& random) {
  std::normal_distribution<> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().matrix();
}

Vector3 random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<> uniform(-size, size);
  return {uniform(random), uniform(random), uniform(random)};
}

/// By the fifteen axes of which one separates two boxes that do not overlap: how far apart they are along the best, m.
double separation(const Vector3& half_a, const PlacedSolid& a, const Vector3& half_b, const PlacedSolid& b) {
  double most = -1e300;
  const auto try_axis = [&](const Vector3& axis) {
    if (axis.norm() < 1e-9) return;
    const Vector3 n = axis.normalized();
    const double reach =
        half_a.dot((a.R_WB.transpose() * n).cwiseAbs()) + half_b.dot((b.R_WB.transpose() * n).cwiseAbs());
    most = std::max(most, std::abs(n.dot(b.p_WB - a.p_WB)) - reach);
  };
  for (int i = 0; i < 3; ++i) {
    try_axis(a.R_WB.col(i));
    try_axis(b.R_WB.col(i));
    for (int j = 0; j < 3; ++j) try_axis(a.R_WB.col(i).cross(b.R_WB.col(j)));
  }
  return most;
}

TEST(SolidOverlap, BoxesAgreeWithTheAxesThatSeparateThem) {
  std::mt19937 random(1);
  int overlapping = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector3 half_a = random_vector(random, 1.0).cwiseAbs(), half_b = random_vector(random, 1.0).cwiseAbs();
    const Solid cuboid_a = Cuboid{half_a}, cuboid_b = Cuboid{half_b};
    const PlacedSolid a{cuboid_a, random_vector(random, 1.0), random_rotation(random)};
    const PlacedSolid b{cuboid_b, random_vector(random, 1.0), random_rotation(random)};
    const double apart = separation(half_a, a, half_b, b);
    if (std::abs(apart) < 1e-9) continue;
    ASSERT_EQ(overlap(a, b), apart < 0.0) << i << ": " << apart;
    overlapping += apart < 0.0;
  }
  EXPECT_GT(overlapping, 1000);
  EXPECT_LT(overlapping, 4000);
}

TEST(SolidOverlap, PointsAndBallsAgreeWithDistances) {
  std::mt19937 random(2);
  for (int i = 0; i < 5000; ++i) {
    const double radius = i % 2 == 0 ? 0.0 : 0.3;
    const Solid small = radius == 0.0 ? Solid(Point{}) : Solid(Ball{radius});
    const Matrix3 R = random_rotation(random);
    const Vector3 p_B = random_vector(random, 1.5), p = R * p_B + Vector3(1, 2, 3);
    const PlacedSolid ball{small, p, random_rotation(random)};
    const auto check = [&](const Solid& solid, double distance) {
      if (std::abs(distance - radius) < 1e-6) return;  // balls that nearly touch take more corners than there are
      ASSERT_EQ(overlap(ball, {solid, {1, 2, 3}, R}), distance < radius)
          << i << " " << solid.index() << " " << distance;
      ASSERT_EQ(overlap({solid, {1, 2, 3}, R}, ball), distance < radius)
          << i << " " << solid.index() << " " << distance;
    };
    const double rho = std::hypot(p_B.x(), p_B.y());
    const double above = std::max(0.0, std::abs(p_B.z()) - 0.8), beside = std::max(0.0, rho - 0.5);
    check(Ball{0.7}, std::max(0.0, p_B.norm() - 0.7));
    check(Cylinder{0.5, 0.8}, std::hypot(above, beside));
    check(Capsule{0.5, 0.8}, std::max(0.0, std::hypot(rho, above) - 0.5));
    check(Cuboid{{0.5, 0.8, 0.3}}, (p_B.cwiseAbs() - Vector3(0.5, 0.8, 0.3)).cwiseMax(0.0).norm());
  }
}

TEST(SolidOverlap, WhatTouchesDoesNotOverlap) {
  const Matrix3 R = Matrix3::Identity();
  const Solid ball = Ball{0.1}, cube = Cuboid{{0.5, 0.5, 0.5}}, point = Point{};
  EXPECT_FALSE(overlap({ball, {0, 0, 0}, R}, {ball, {0.2, 0, 0}, R}));
  EXPECT_FALSE(overlap({cube, {0, 0, 0}, R}, {cube, {1, 0.3, 0.2}, R}));
  EXPECT_FALSE(overlap({cube, {0, 0, 0}, R}, {point, {0.5, 0.1, 0.1}, R}));
  EXPECT_TRUE(overlap({cube, {0, 0, 0}, R}, {cube, {0, 0, 0}, R}));
  EXPECT_TRUE(overlap({cube, {0, 0, 0}, R}, {point, {0, 0, 0}, R}));
}

}  // namespace
}  // namespace trajet
