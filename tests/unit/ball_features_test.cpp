// What touches where a point or a ball is in contact with a shape: faces, edges, corners, and what is round.

#include <gtest/gtest.h>

#include <numbers>

#include "trajet/collide/detect/ball_features.hpp"
#include "trajet/geom/cavity.hpp"

namespace trajet {
namespace {

Feature touched(const Shape& shape, const Vector3& point, const Vector3& normal) {
  return features_of_ball(0.1, shape, point, normal.normalized()).of_obstacle;
}

TEST(BallFeatures, OfTheBallItself) {
  const Shape plane = make_plane({0, 0, 0}, {0, 0, 1});
  EXPECT_EQ(features_of_ball(0.0, plane, {1, 2, 0}, {0, 0, 1}).of_body, Feature::vertex);
  EXPECT_EQ(features_of_ball(0.1, plane, {1, 2, 0}, {0, 0, 1}).of_body, Feature::surface);
  EXPECT_EQ(touched(plane, {1, 2, 0}, {0, 0, 1}), Feature::face);
}

TEST(BallFeatures, OfFlatPlates) {
  const Shape disk = make_disk({0, 0, 0}, {0, 0, 1}, 2.0);
  EXPECT_EQ(touched(disk, {1, 0, 0}, {0, 0, -1}), Feature::face);
  EXPECT_EQ(touched(disk, {2, 0, 0}, {1, 0, 1}), Feature::edge);
  const Shape rectangle = make_rectangle({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 4.0, 2.0);
  EXPECT_EQ(touched(rectangle, {1, 0.5, 0}, {0, 0, 1}), Feature::face);
  EXPECT_EQ(touched(rectangle, {2, 0.5, 0}, {1, 0, 1}), Feature::edge);
  EXPECT_EQ(touched(rectangle, {1, -1, 0}, {0, -1, 1}), Feature::edge);
  EXPECT_EQ(touched(rectangle, {-2, 1, 0}, {-1, 1, 1}), Feature::vertex);
  const Shape triangle = make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(touched(triangle, {0.2, 0.2, 0}, {0, 0, 1}), Feature::face);
  EXPECT_EQ(touched(triangle, {0.5, 0, 0}, {0, -1, 1}), Feature::edge);
  EXPECT_EQ(touched(triangle, {0, 1, 0}, {0, 1, 1}), Feature::vertex);
}

TEST(BallFeatures, OfSolids) {
  const Matrix3 turned = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const Vector3 center(3, -1, 2);
  const Shape box = make_box(center, {2, 4, 6}, turned);
  const auto at = [&](const Vector3& p) { return Vector3(center + turned * p); };
  const auto along = [&](const Vector3& n) { return Vector3(turned * n); };
  EXPECT_EQ(touched(box, at({1, 0.5, 0}), along({1, 0, 0})), Feature::face);
  EXPECT_EQ(touched(box, at({1, 2, 0.3}), along({1, 1, 0})), Feature::edge);
  EXPECT_EQ(touched(box, at({1, -2, 3}), along({1, -1, 1})), Feature::vertex);
  const Shape cylinder = make_cylinder(center, turned, 1.0, 2.0);
  EXPECT_EQ(touched(cylinder, at({0.5, 0, 1}), along({0, 0, 1})), Feature::face);
  EXPECT_EQ(touched(cylinder, at({1, 0, 1}), along({1, 0, 1})), Feature::edge);
  EXPECT_EQ(touched(cylinder, at({1, 0, 0.2}), along({1, 0, 0})), Feature::surface);
  const Shape cone = make_cone(center, turned, 1.0, 2.0);
  EXPECT_EQ(touched(cone, at({0, 0, 1.5}), along({0, 0, 1})), Feature::vertex);
  EXPECT_EQ(touched(cone, at({1, 0, -0.5}), along({1, 0, -1})), Feature::edge);
  EXPECT_EQ(touched(cone, at({0.5, 0, 0.5}), along({2, 0, 1})), Feature::surface);
  EXPECT_EQ(touched(make_capsule(center, turned, 1.0, 2.0), at({0, 0, 2}), along({0, 0, 1})), Feature::surface);
  EXPECT_EQ(touched(make_sphere(center, 1.0), center + Vector3(0, 0, 1), {0, 0, 1}), Feature::surface);
  EXPECT_EQ(touched(make_ellipsoid(center, turned, {1, 2, 3}), at({1, 0, 0}), along({1, 0, 0})), Feature::surface);
}

TEST(BallFeatures, OfHollows) {
  const Shape room = make_box_cavity({0, 0, 0}, {2, 2, 2}, Matrix3::Identity());
  EXPECT_EQ(touched(room, {1, 0.2, 0}, {-1, 0, 0}), Feature::face);
  EXPECT_EQ(touched(make_sphere_cavity({0, 0, 0}, 2.0), {2, 0, 0}, {-1, 0, 0}), Feature::surface);
}

}  // namespace
}  // namespace trajet
