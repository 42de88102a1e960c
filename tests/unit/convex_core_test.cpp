// Convex solids as hulls of corners, and where two of them come closest.

#include "trajet/geom/convex_core.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "trajet/geom/closest_features.hpp"

namespace trajet {
namespace {

/// Faces point outward, every edge of a solid has two of them, and Euler's formula holds.
void expect_polyhedron(const ConvexCore& core, std::size_t faces, std::size_t edges, std::size_t vertices) {
  EXPECT_EQ(core.faces.size(), faces);
  EXPECT_EQ(core.edges.size(), edges);
  EXPECT_EQ(core.vertices.size(), vertices);
  for (const CoreFace& f : core.faces) {
    EXPECT_NEAR(f.normal.norm(), 1.0, 1e-15);
    for (const Vector3& p : core.vertices) EXPECT_LE(f.normal.dot(p), f.offset);
    for (const int i : f.loop) EXPECT_NEAR(f.normal.dot(core.vertices[static_cast<std::size_t>(i)]), f.offset, 1e-12);
  }
  for (const CoreEdge& e : core.edges) {
    EXPECT_EQ(e.inward.size(), 2U);
    for (const Vector3& n : e.inward) EXPECT_NEAR(n.dot(e.direction), 0.0, 1e-14);
  }
}

TEST(ConvexCore, OfEverySolidThatIsConvex) {
  const ConvexCore box = convex_core(Cuboid{{1, 2, 3}});
  expect_polyhedron(box, 6, 12, 8);
  EXPECT_NEAR(box.reach, std::sqrt(14.0), 1e-15);
  const ConvexCore ball = convex_core(SoccerBall{1.0});
  expect_polyhedron(ball, 32, 90, 60);
  std::size_t pentagons = 0;
  for (const CoreFace& f : ball.faces) pentagons += f.loop.size() == 5;
  EXPECT_EQ(pentagons, 12U);
  expect_polyhedron(convex_core(RectangularPlate{1, 2}), 2, 4, 4);
  expect_polyhedron(convex_core(TriangularPlate{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}), 2, 3, 3);
  const ConvexCore capsule = convex_core(Capsule{0.5, 2.0});
  EXPECT_EQ(capsule.vertices.size(), 2U);
  EXPECT_EQ(capsule.edges.size(), 1U);
  EXPECT_EQ(capsule.reach, 2.5);
  EXPECT_EQ(convex_core(Ball{0.5}).rounding, 0.5);
  EXPECT_EQ(convex_core(Point{}).reach, 0.0);
  EXPECT_TRUE(convex_core(HalfSpace{}).is_half_space);
  EXPECT_NEAR(support(convex_core(Cylinder{0.5, 2.0}), {3, 0, 4}).height, 3 * 0.5 + 4 * 2.0, 1e-15);
  EXPECT_NEAR(support(ellipsoid_core({1, 2, 3}), {1, 1, 1}).height, std::sqrt(14.0), 1e-15);
  EXPECT_THROW(convex_core(Mesh{}), std::domain_error);
}

TEST(ConvexCore, HullsHaveNoMoreFacesThanTheyShow) {
  std::vector<Vector3> points;
  for (int i = 0; i < 12; ++i) {  // a prism with twelve sides
    const double angle = i * 0.5235987755982988;
    for (const double z : {-1.0, 1.0}) points.push_back({std::cos(angle), std::sin(angle), z});
  }
  expect_polyhedron(hull_core(convex_hull(points)), 14, 36, 24);
}

TEST(ClosestFeatures, OfTwoBoxesAreAtTheLeastDistanceOfAll) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> size(0.1, 1.0);
  for (int k = 0; k < 500; ++k) {
    const ConvexCore a = convex_core(Cuboid{{size(random), size(random), size(random)}});
    const ConvexCore b = convex_core(Cuboid{{size(random), size(random), size(random)}});
    RelativePose pose;
    pose.p_AB = 2.0 * Vector3(normal(random), normal(random), normal(random));
    pose.R_AB = Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized();
    const ClosestFeatures c = closest_features(a, b, pose);
    if (c.distance == 0.0) continue;
    // the separation along the direction is the distance: it is the least of all, and both points are of the solids
    const double apart = c.direction.dot(pose.p_AB) - support(a, c.direction).height -
                         support(b, -(pose.R_AB.transpose() * c.direction)).height;
    EXPECT_NEAR(apart, c.distance, 1e-12 + 1e-13 * c.distance);
    EXPECT_NEAR((c.on_b - c.on_a).norm(), c.distance, 1e-14);
    for (const CoreFace& f : a.faces) EXPECT_LE(f.normal.dot(c.on_a), f.offset + 1e-14);
    for (const CoreFace& f : b.faces)
      EXPECT_LE(f.normal.dot(pose.R_AB.transpose() * (c.on_b - pose.p_AB)), f.offset + 1e-14);
  }
}

}  // namespace
}  // namespace trajet
