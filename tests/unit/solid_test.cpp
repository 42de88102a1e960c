#include "trajet/geom/solid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "trajet/io/scene_file.hpp"
#include "trajet/math/quaternion.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {
namespace {

const Matrix3 kTurned = rotation_matrix(from_axis_angle<double>(Vector3(1, 2, -1), 0.7));

Hull tetrahedron() { return make_hull(std::vector<Vector3>{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {1, 1, 1}}); }

/// All solids that are bounded and have flat faces or are drawn with some.
std::vector<Solid> drawn_solids() {
  return {Cuboid{{1, 2, 3}},
          Cylinder{1.0, 2.0},
          Capsule{0.5, 2.0},
          SoccerBall{2.0},
          tetrahedron(),
          RoundPlate{1.5},
          RectangularPlate{1, 0.5},
          TriangularPlate{{Vector3(-1, -1, 0), Vector3(1, -1, 0), Vector3(0, 2, 0)}}};
}

TEST(Solid, ReachesAsFarAsItsFarthestPoint) {
  EXPECT_EQ(bounding_radius(Point{}), 0.0);
  EXPECT_EQ(bounding_radius(Ball{0.3}), 0.3);
  EXPECT_EQ(bounding_radius(Cuboid{{2, 4, 4}}), 6.0);
  EXPECT_EQ(bounding_radius(Cylinder{3, 4}), 5.0);
  EXPECT_EQ(bounding_radius(Capsule{3, 4}), 7.0);
  EXPECT_EQ(bounding_radius(RectangularPlate{3, 4}), 5.0);
  EXPECT_EQ(bounding_radius(HalfSpace{}), std::numeric_limits<double>::infinity());
  // corners of the tetrahedron relative to its centre (1, 1, 1)
  EXPECT_DOUBLE_EQ(bounding_radius(tetrahedron()), std::sqrt(11.0));
  for (const Solid& solid : drawn_solids())
    for (const Vector3& vertex : picture_mesh(solid).vertices)
      EXPECT_LE(vertex.norm(), bounding_radius(solid) * (1.0 + 1e-15));
}

TEST(Solid, BoundsAreTheLeastBoxWhereTheSolidStands) {
  const Vector3 p_WB(10, -20, 30);
  const Aabb ball = bounds(Ball{2.0}, p_WB, kTurned);
  EXPECT_LE((ball.lower - Vector3(8, -22, 28)).norm() + (ball.upper - Vector3(12, -18, 32)).norm(), 1e-12);
  for (const Solid& solid : drawn_solids()) {
    const Aabb box = bounds(solid, p_WB, kTurned);
    Aabb of_picture;
    for (const Vector3& vertex : picture_mesh(solid).vertices) of_picture = united(of_picture, p_WB + kTurned * vertex);
    EXPECT_TRUE((box.lower.array() <= of_picture.lower.array()).all());
    EXPECT_TRUE((box.upper.array() >= of_picture.upper.array()).all());
    // pictures of what is round lie within it, by 1 - cos(pi/32); the ball around a soccer ball is wider than it
    const double slack = std::holds_alternative<SoccerBall>(solid) ? 0.2 : 0.02;
    EXPECT_LE((box.upper - of_picture.upper).maxCoeff(), slack * bounding_radius(solid)) << solid.index();
    EXPECT_LE((of_picture.lower - box.lower).maxCoeff(), slack * bounding_radius(solid)) << solid.index();
  }
  const Aabb ground = bounds(HalfSpace{}, p_WB, Matrix3::Identity());
  EXPECT_NEAR(ground.upper.z(), 30.0, 1e-12);
  EXPECT_GE(ground.upper.z(), 30.0);
  EXPECT_EQ(ground.lower.z(), -std::numeric_limits<double>::infinity());
  EXPECT_FALSE(is_bounded(ground));
}

TEST(Solid, HasAVolumeWhereItHasAnInside) {
  EXPECT_DOUBLE_EQ(volume_properties(Cuboid{{1, 2, 3}})->volume, 48.0);
  EXPECT_DOUBLE_EQ(volume_properties(tetrahedron())->volume, 64.0 / 6.0);
  EXPECT_NEAR(volume_properties(Capsule{1.0, 1.0})->volume, 10.0 / 3.0 * M_PI, 1e-14);
  EXPECT_FALSE(volume_properties(Point{}));
  EXPECT_FALSE(volume_properties(HalfSpace{}));
  EXPECT_FALSE(volume_properties(RoundPlate{1.0}));
}

TEST(Solid, AnObstacleIsASolidWhereItsShapeIs) {
  const World world = make_world(parse_scene(R"(
[time]
end = 1
[[body]]
name = "b"
[[obstacle]]
name = "triangle"
shape = "triangle"
points = [[1, 2, 3], [4, 2, 5], [1, 7, 2]]
[[obstacle]]
name = "rectangle"
shape = "rectangle"
center = [1, 2, 3]
normal = [1, 1, 0]
up = [0, 0, 1]
size = [4, 6]
[[obstacle]]
name = "box"
shape = "box"
center = [9, 9, 9]
size = [1, 2, 3]
orientation = {axis = [1, 1, 1], angle = 0.5}
[[obstacle]]
name = "disk"
shape = "disk"
center = [1, 2, 30]
normal = [1, 1, 1]
radius = 2
[[obstacle]]
name = "ground"
shape = "plane"
point = [0, 0, -5]
normal = [0, 0, 2]
)",
                                             "s"));
  const auto box_of = [&](std::size_t i) {
    const World::Obstacle& obstacle = world.obstacles[i];
    return bounds(obstacle.solid, obstacle.p_WB, rotation_matrix(obstacle.q_WB));
  };
  const auto expect_around = [](const Aabb& box, const std::vector<Vector3>& points) {
    Aabb expected;
    for (const Vector3& point : points) expected = united(expected, point);
    EXPECT_LE((box.lower - expected.lower).norm() + (box.upper - expected.upper).norm(), 1e-12);
  };
  expect_around(box_of(0), {{1, 2, 3}, {4, 2, 5}, {1, 7, 2}});
  const Vector3 across = 2.0 * Vector3(0, 0, 1).cross(Vector3(1, 1, 0).normalized());
  expect_around(box_of(1), {Vector3(1, 2, 0) + across, Vector3(1, 2, 6) - across});
  const auto& box = std::get<Box>(world.obstacles[2].shape);
  std::vector<Vector3> corners;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0})
        corners.push_back(box.center + box.R_WB * Vector3(x, y, z).cwiseProduct(box.half_size));
  expect_around(box_of(2), corners);
  const double reach = 2.0 * std::sqrt(2.0 / 3.0);
  expect_around(box_of(3), {Vector3(1 - reach, 2 - reach, 30 - reach), Vector3(1 + reach, 2 + reach, 30 + reach)});
  EXPECT_NEAR(box_of(4).upper.z(), -5.0, 1e-14);
}

}  // namespace
}  // namespace trajet
