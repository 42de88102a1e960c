#include "trajet/geom/rounded_solid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "trajet/geom/compound.hpp"

namespace trajet {
namespace {

using std::numbers::pi;

std::vector<Vector3> corners_of(const Vector3& half) {
  std::vector<Vector3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(half.cwiseProduct(Vector3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0)));
  return corners;
}

/// A rectangle with the half edges a and b, grown by s: its area and int x^2, piece by piece.
struct Section {
  double area, xx;
  Section(double a, double b, double s)
      : area(4 * a * b + 4 * s * (a + b) + pi * s * s),
        xx(4 * b * std::pow(a + s, 3) / 3 + 4 * s * std::pow(a, 3) / 3 +
           (pi * s * s * a * a + 8 * a * std::pow(s, 3) / 3 + pi * std::pow(s, 4) / 4)) {}
};

TEST(RoundedSolid, ABoxAgainstItsSections) {
  const Vector3 half(0.5, 0.8, 1.1);
  const double r = 0.2;
  const VolumeProperties rounded = make_rounded_hull(corners_of(half), r).core->properties;
  const double a = half.x() - r, b = half.y() - r, c = half.z() - r;
  EXPECT_NEAR(
      rounded.volume,
      8 * a * b * c + 8 * r * (a * b + b * c + c * a) + 2 * pi * r * r * (a + b + c) + 4.0 / 3.0 * pi * r * r * r,
      4e-13);  // measured: the quadratures round to 1.2e-13
  // sections across z: full up to c, then grown by r cos(phi) at c + r sin(phi); Simpson's rule in phi
  const Section full(a, b, r), full_y(b, a, r);
  double xx = 2 * c * full.xx, yy = 2 * c * full_y.xx, zz = 2 * full.area * c * c * c / 3;
  constexpr int kSteps = 2000;
  for (int i = 0; i <= kSteps; ++i) {
    const double phi = pi / 2 * i / kSteps, weight = (i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2) / 3.0;
    const double dz = 2 * weight * pi / 2 / kSteps * r * std::cos(phi), s = r * std::cos(phi),
                 z = c + r * std::sin(phi);
    xx += dz * Section(a, b, s).xx;
    yy += dz * Section(b, a, s).xx;
    zz += dz * Section(a, b, s).area * z * z;
  }
  EXPECT_LE((rounded.inertia.diagonal() - Vector3(yy + zz, zz + xx, xx + yy)).norm(), 1e-12);
  EXPECT_LE((rounded.inertia - Matrix3(rounded.inertia.diagonal().asDiagonal())).norm(), 1e-14);
}

TEST(RoundedSolid, ACylinderBySteinersFormula) {
  const double R = 0.7, h = 0.9, r = 0.15;  // h: half the height
  const VolumeProperties rounded = make_rounded_cylinder(R, 2 * h, r).core->properties;
  const double a = R - r, c = h - r;
  EXPECT_NEAR(rounded.volume,
              2 * pi * a * a * c + (2 * pi * a * a + 4 * pi * a * c) * r + (2 * pi * c + pi * pi * a) * r * r +
                  4.0 / 3.0 * pi * r * r * r,
              4e-13);  // measured: the quadratures round to 1.2e-13
  // almost a ball
  const VolumeProperties ball = make_rounded_cylinder(0.5 + 1e-9, 2 * (0.5 + 1e-9), 0.5).core->properties;
  EXPECT_LE((ball.inertia - sphere_properties(0.5).inertia).norm(), 1e-8);
}

TEST(RoundedSolid, AConeAgainstAHullOfItsShape) {
  // 720 sides: an error of some (pi / 720)^2
  std::vector<Vector3> base;
  for (int i = 0; i < 720; ++i) base.emplace_back(0.6 * std::cos(pi * i / 360), 0.6 * std::sin(pi * i / 360), -0.25);
  const VolumeProperties cone = cone_properties(0.6, 1.0);
  base.emplace_back(0, 0, 0.75);
  const VolumeProperties hull = mesh_properties(convex_hull(base));
  EXPECT_NEAR(cone.volume, hull.volume, 2e-5 * cone.volume);
  EXPECT_LE(hull.center.norm(), 1e-9);
  EXPECT_LE((cone.inertia - hull.inertia).norm(), 5e-5 * cone.inertia.norm());
  const VolumeProperties sharp = grown_profile_properties(cone_core_profile(0.6, 1.0, 0.0), 0.0);
  EXPECT_LE((sharp.inertia - cone.inertia).norm(), 1e-15);
  EXPECT_LE(sharp.center.norm(), 1e-15);
}

TEST(RoundedSolid, ATetrahedronGrownIsTheSumOfItsParts) {
  // Steiner: volume, surface, integral of the mean curvature of a regular tetrahedron of edge 1
  const std::vector<Vector3> corners{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  TriangleMesh mesh = convex_hull(corners);
  for (Vector3& vertex : mesh.vertices) vertex /= std::sqrt(8.0);
  const double r = 0.3, bend = 0.5 * 6.0 * (pi - std::acos(1.0 / 3.0));
  const VolumeProperties grown = grown_hull_properties(mesh, r);
  EXPECT_NEAR(grown.volume,
              1.0 / (6.0 * std::sqrt(2.0)) + std::sqrt(3.0) * r + bend * r * r + 4.0 / 3.0 * pi * r * r * r, 1e-12);
  EXPECT_LE((grown.inertia - grown.inertia(0, 0) * Matrix3::Identity()).norm(), 1e-12);
  // a far larger growth is a ball
  EXPECT_NEAR(grown_hull_properties(mesh, 1e4).inertia(0, 0) / sphere_properties(1e4).inertia(0, 0), 1.0, 1e-3);
}

TEST(RoundedSolid, NothingIsLeftOfWhatIsRoundedTooFar) {
  EXPECT_THROW(make_rounded_hull(corners_of({0.5, 0.5, 0.5}), 0.6), std::domain_error);
  EXPECT_THROW(make_rounded_cylinder(1, 1, 0.5), std::domain_error);
  EXPECT_THROW(make_rounded_cone(1, 1, 0.5), std::domain_error);
}

TEST(Compound, TwoHalvesOfABoxAreTheBox) {
  const Matrix3 R = Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  const Compound compound = make_compound({{Cuboid{{0.5, 1, 1.5}}, Vector3(3, 4, 5) + R * Vector3(0.5, 0, 0), R},
                                           {Cuboid{{0.5, 1, 1.5}}, Vector3(3, 4, 5) - R * Vector3(0.5, 0, 0), R}});
  const VolumeProperties box = box_properties({2, 2, 3});
  EXPECT_NEAR(compound.parts->volume, box.volume, 1e-13);
  EXPECT_LE((volume_properties(compound)->inertia - R * box.inertia * R.transpose()).norm(), 1e-12);
  EXPECT_LE((compound.parts->origin + Vector3(3, 4, 5)).norm(), 1e-14);
  EXPECT_FALSE(compound.parts->mass);
}

}  // namespace
}  // namespace trajet
