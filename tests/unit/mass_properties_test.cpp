#include "trajet/geom/mass_properties.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "trajet/rigid/principal_axes.hpp"

namespace trajet {
namespace {

using std::numbers::pi;

// Sums of some hundred terms of the size of the result.
constexpr double kRounding = 256 * std::numeric_limits<double>::epsilon();

std::vector<Vector3> box_corners(const Vector3& size, const Vector3& center, const Matrix3& R) {
  std::vector<Vector3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(center + R * (0.5 * size.cwiseProduct(Vector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1))));
  return corners;
}

TEST(MassProperties, OfABoxFromItsFormulaAndFromItsSurface) {
  const Vector3 size(1, 2, 3);
  const VolumeProperties box = box_properties(size);
  EXPECT_EQ(box.volume, 6.0);
  EXPECT_EQ(box.inertia.diagonal(), Vector3(6.5, 5.0, 2.5));

  const Matrix3 R = rotation_matrix(from_rotation_vector<double>(Vector3(0.3, -1, 2)));
  const VolumeProperties mesh = mesh_properties(convex_hull(box_corners(size, Vector3(10, -4, 7), R)));
  EXPECT_NEAR(mesh.volume, 6.0, 6.0 * kRounding);
  EXPECT_LE((mesh.center - Vector3(10, -4, 7)).norm(), 10 * kRounding);
  EXPECT_LE((mesh.inertia - R * box.inertia * R.transpose()).norm(), 100 * kRounding);
  EXPECT_LE((principal_axes(mesh.inertia).moments - Vector3(2.5, 5, 6.5)).norm(), 100 * kRounding);
}

TEST(MassProperties, OfATetrahedron) {
  const std::vector<Vector3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const VolumeProperties solid = mesh_properties(convex_hull(corners));
  EXPECT_NEAR(solid.volume, 1.0 / 6, kRounding);
  EXPECT_LE((solid.center - Vector3(0.25, 0.25, 0.25)).norm(), kRounding);
  // int x^2 = 1/60, int xy = 1/120 about the corner
  Matrix3 about_corner = Matrix3::Constant(-1.0 / 120);
  about_corner.diagonal().setConstant(2.0 / 60);
  EXPECT_LE((shifted_inertia(solid.inertia, solid.volume, solid.center) - about_corner).norm(), kRounding);
}

TEST(MassProperties, OfACylinderAndACapsuleAgainstThinSlices) {
  // Gauss-Legendre quadrature of polynomials in z over the slices, exact to rounding.
  const double r = 0.3, h = 0.8;
  const double nodes[] = {-std::sqrt(0.6), 0.0, std::sqrt(0.6)}, weights[] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  double volume = 0.0, across = 0.0, along = 0.0;
  const auto add_slice = [&](double z, double radius_squared, double weight) {
    const double area = weight * pi * radius_squared;
    volume += area;
    along += area * radius_squared / 2;
    across += area * (radius_squared / 4 + z * z);
  };
  for (int i = 0; i < 3; ++i) add_slice(h / 2 * nodes[i], r * r, h / 2 * weights[i]);
  const VolumeProperties cylinder = cylinder_properties(r, h);
  EXPECT_NEAR(cylinder.volume, volume, kRounding);
  EXPECT_LE((cylinder.inertia.diagonal() - Vector3(across, across, along)).norm(), kRounding);
  for (int i = 0; i < 3; ++i) {
    const double zeta = r / 2 * (1 + nodes[i]);
    for (const double side : {-1.0, 1.0}) add_slice(side * (h / 2 + zeta), r * r - zeta * zeta, r / 2 * weights[i]);
  }
  const VolumeProperties capsule = capsule_properties(r, h);
  EXPECT_NEAR(capsule.volume, volume, kRounding);
  EXPECT_LE((capsule.inertia.diagonal() - Vector3(across, across, along)).norm(), kRounding);
}

TEST(MassProperties, OfASoccerBall) {
  const std::vector<Vector3> corners = truncated_icosahedron(1.0);
  ASSERT_EQ(corners.size(), 60u);
  const TriangleMesh hull = convex_hull(corners);
  EXPECT_EQ(hull.vertices.size(), 60u);
  EXPECT_EQ(hull.triangles.size(), 116u);  // Euler: F = 2 V - 4
  const VolumeProperties ball = mesh_properties(hull);
  // V = (125 + 43 sqrt 5) / 4 a^3 for the edge a, whose circumscribed radius is sqrt(58 + 18 sqrt 5) / 4 a
  const double a = 4.0 / std::sqrt(58.0 + 18.0 * std::sqrt(5.0));
  EXPECT_NEAR(ball.volume, (125.0 + 43.0 * std::sqrt(5.0)) / 4.0 * a * a * a, kRounding * ball.volume);
  // icosahedral symmetry: every axis is a principal one
  EXPECT_LE((ball.inertia - ball.inertia(0, 0) * Matrix3::Identity()).norm(), kRounding);
  EXPECT_LT(ball.inertia(0, 0), sphere_properties(1.0).inertia(0, 0));
  EXPECT_LE(ball.center.norm(), kRounding);
}

TEST(ConvexHull, LeavesOutWhatIsWithin) {
  std::vector<Vector3> points = box_corners(Vector3(2, 2, 2), Vector3(0, 0, 0), Matrix3::Identity());
  points.push_back({0, 0, 0});
  points.push_back({1, 0, 0});    // on a face
  points.push_back({1, 1, 0.5});  // on an edge
  points.push_back(points[3]);    // twice
  points.insert(points.begin(), {0.2, 0.1, 0.3});
  const TriangleMesh hull = convex_hull(points);
  EXPECT_EQ(hull.triangles.size(), 2 * hull.vertices.size() - 4);
  EXPECT_NEAR(mesh_properties(hull).volume, 8.0, 8.0 * kRounding);
}

TEST(ConvexHull, OfPointsWithoutVolumeIsAnError) {
  const std::vector<Vector3> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.2, 0}};
  EXPECT_THROW(convex_hull(flat), std::domain_error);
  EXPECT_THROW(convex_hull(std::vector<Vector3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}), std::domain_error);
  EXPECT_THROW(convex_hull(std::vector<Vector3>(5, Vector3(1, 2, 3))), std::domain_error);
  EXPECT_THROW(convex_hull({}), std::domain_error);
  EXPECT_THROW(convex_hull(std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, INFINITY}}), std::domain_error);
}

TEST(ClosedMesh, FindsHolesAndTurnsInsideOut) {
  TriangleMesh mesh = convex_hull(box_corners(Vector3(1, 1, 1), Vector3(0, 0, 0), Matrix3::Identity()));
  TriangleMesh inside_out = mesh;
  for (auto& triangle : inside_out.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_NEAR(mesh_properties(closed_mesh(inside_out)).volume, 1.0, kRounding);
  // one triangle the wrong way round
  TriangleMesh wrong = mesh;
  std::swap(wrong.triangles[0][0], wrong.triangles[0][1]);
  EXPECT_THROW(closed_mesh(wrong), std::domain_error);
  mesh.triangles.pop_back();
  EXPECT_THROW(closed_mesh(mesh), std::domain_error);
}

TEST(Inertia, OfABodyObeysTheTriangleInequality) {
  EXPECT_TRUE(is_possible_inertia(Vector3(1, 2, 3).asDiagonal()));  // a flat plate
  EXPECT_FALSE(is_possible_inertia(Vector3(1, 2, 3.1).asDiagonal()));
  EXPECT_FALSE(is_possible_inertia(Vector3(1, 0, 1).asDiagonal()));
  EXPECT_FALSE(is_possible_inertia(Vector3(1, -2, 1).asDiagonal()));
}

}  // namespace
}  // namespace trajet
