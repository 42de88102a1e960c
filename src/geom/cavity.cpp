#include "trajet/geom/cavity.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "trajet/geom/shape_pictures.hpp"

namespace trajet {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Cavity cavity(CavityWalls walls) { return {std::make_shared<const CavityWalls>(std::move(walls))}; }

/// A wall across the frame's axis i, on its positive or negative side.
Plane wall(const Vector3& center, const Matrix3& R_WB, int i, double side, double distance) {
  const Vector3 outward = side * R_WB.col(i);
  return {center + distance * outward, -outward};
}

TriangleMesh picture(const SolidOfRevolution& solid) { return placed(local_picture(solid), solid.center, solid.R_WB); }

}  // namespace

Cavity make_sphere_cavity(const Vector3& center, double radius) {
  const Sphere sphere = make_sphere(center, radius);
  return cavity({.round = RoundWall{sphere.center, Matrix3::Identity(), 0.0, sphere.radius},
                 .picture = placed(ellipsoid_picture(Vector3::Constant(radius)), center, Matrix3::Identity())});
}

Cavity make_box_cavity(const Vector3& center, const Vector3& size, const Matrix3& R_WB) {
  const Box box = make_box(center, size, R_WB);
  CavityWalls walls;
  std::vector<Vector3> corners;
  for (int i = 0; i < 3; ++i)
    for (const double side : {-1.0, 1.0}) walls.planes.push_back(wall(center, R_WB, i, side, box.half_size[i]));
  for (int i = 0; i < 8; ++i)
    corners.push_back(box.half_size.cwiseProduct(Vector3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0)));
  walls.picture = placed(convex_hull(corners), center, R_WB);
  return cavity(std::move(walls));
}

Cavity make_cylinder_cavity(const Vector3& center, const Matrix3& R_WB, double radius, double height) {
  const SolidOfRevolution cylinder = make_cylinder(center, R_WB, radius, height);
  return cavity({.planes = {wall(center, R_WB, 2, -1.0, 0.5 * height), wall(center, R_WB, 2, 1.0, 0.5 * height)},
                 .round = RoundWall{center, R_WB, kInfinity, radius},
                 .picture = picture(cylinder)});
}

Cavity make_capsule_cavity(const Vector3& center, const Matrix3& R_WB, double radius, double height) {
  const SolidOfRevolution capsule = make_capsule(center, R_WB, radius, height);
  return cavity({.round = RoundWall{center, R_WB, 0.5 * height, radius}, .picture = picture(capsule)});
}

Cavity make_ellipsoid_cavity(const Vector3& center, const Matrix3& R_WB, const Vector3& radii) {
  const EllipsoidBody ellipsoid = make_ellipsoid(center, R_WB, radii);
  return cavity({.ellipsoid = ellipsoid, .picture = placed(ellipsoid_picture(radii), center, R_WB)});
}

std::vector<Cavity> walls_of(const Cavity& whole) {
  std::vector<Cavity> parts;
  const CavityWalls& walls = *whole.walls;
  const auto add = [&](CavityWalls part) {
    if (parts.empty()) part.picture = walls.picture;
    parts.push_back(cavity(std::move(part)));
  };
  for (const Plane& plane : walls.planes) add({.planes = {plane}});
  if (walls.round) add({.round = walls.round});
  if (walls.ellipsoid) add({.ellipsoid = walls.ellipsoid});
  return parts;
}

double largest_ball(const Cavity& cavity) {
  double radius = kInfinity;
  if (cavity.walls->round) radius = cavity.walls->round->radius;
  if (const auto& ellipsoid = cavity.walls->ellipsoid) {
    // the least radius of curvature, at the end of the longest axis
    const double least = ellipsoid->radii.minCoeff();
    radius = std::min(radius, least * least / ellipsoid->radii.maxCoeff());
  }
  return radius;
}

}  // namespace trajet
