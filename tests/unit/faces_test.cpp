#include "trajet/geom/faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace trajet {
namespace {

/// Twice the area of a face times its normal, by the corners alone.
Vector3 area(const Face& face) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < face.corners.size(); ++i)
    sum += face.corners[i].cross(face.corners[(i + 1) % face.corners.size()]);
  return sum;
}

/// Corners run around the normal, and a closed surface has faces outward all around: their areas add up to zero.
template <class Faces>
void expect_closed(const Faces& all) {
  Vector3 sum = Vector3::Zero();
  for (const Face& face : all) {
    EXPECT_NEAR(area(face).normalized().dot(face.normal), 1.0, 1e-12);
    EXPECT_GT(face.normal.dot(face.corners[0]), 0.0) << "outward, around the origin";
    sum += area(face);
  }
  EXPECT_LT(sum.norm(), 1e-12);
}

TEST(Faces, OfASoccerBallAreTwelvePentagonsAndTwentyHexagons) {
  const std::vector<Face> all = faces(convex_hull(truncated_icosahedron(0.11)));
  const auto of = [&](std::size_t corners) {
    return std::ranges::count_if(all, [&](const Face& face) { return face.corners.size() == corners; });
  };
  EXPECT_EQ(all.size(), 32U);
  EXPECT_EQ(of(5), 12);
  EXPECT_EQ(of(6), 20);
  expect_closed(all);
}

TEST(Faces, OfABoxAreSixRectanglesWhicheverWayItIsGiven) {
  const Box box = make_box({0, 0, 0}, {1, 2, 3}, Matrix3::Identity());
  expect_closed(faces(box));
  std::vector<Vector3> corners;
  for (const Face& face : faces(box)) corners.insert(corners.end(), face.corners.begin(), face.corners.end());
  const std::vector<Face> hull = faces(convex_hull(corners));
  ASSERT_EQ(hull.size(), 6U);
  for (const Face& face : hull) EXPECT_EQ(face.corners.size(), 4U);
  expect_closed(hull);
}

TEST(Faces, OfFlatShapesHaveTheirAreas) {
  // of the regular 48-gon in a circle of radius 2: 48/2 r^2 sin(2 pi/48)
  EXPECT_NEAR(0.5 * area(face(make_disk({1, 2, 3}, {0, 0, 1}, 2.0), 48)).z(),
              24.0 * 4.0 * std::sin(std::acos(-1.0) / 24), 1e-12);
  EXPECT_NEAR(0.5 * area(face(make_rectangle({1, 2, 3}, {-1, 0, 0}, {0, 0, 1}, 2.0, 5.0))).x(), -10.0, 1e-12);
  EXPECT_NEAR(0.5 * area(face(make_triangle({0, 0, 0}, {3, 0, 0}, {0, 2, 0}))).z(), 3.0, 1e-12);
}

TEST(Faces, AreNotJoinedAroundAHoleNorOverAnEdge) {
  // a square frame of eight triangles, flat: its rim is two loops
  TriangleMesh frame;
  for (const double r : {1.0, 2.0})
    for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
      frame.vertices.emplace_back(r * x, r * y, 0);
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    frame.triangles.push_back({i, i + 4, j + 4});
    frame.triangles.push_back({i, j + 4, j});
  }
  EXPECT_EQ(faces(frame).size(), 8U);
  // two triangles that meet at a right angle, and one without area
  const TriangleMesh bent{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 1}}};
  EXPECT_EQ(faces(bent).size(), 2U);
}

}  // namespace
}  // namespace trajet
