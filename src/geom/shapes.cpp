#include "trajet/geom/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace trajet {

namespace {

void require_finite(const Vector3& v, const char* name) {
  if (!v.allFinite()) throw std::domain_error(std::string(name) + " must be finite");
}

void require_positive(double x, const char* name) {
  if (!(x > 0.0) || !std::isfinite(x)) throw std::domain_error(std::string(name) + " must be positive and finite");
}

void require_rotation(const Matrix3& R_WB) {
  constexpr double kOrthogonality = 1e-9;
  if (!(R_WB.transpose() * R_WB).isIdentity(kOrthogonality) || !(R_WB.determinant() > 0.0))
    throw std::domain_error("orientation must be a rotation");
}

SolidOfRevolution turned(const Vector3& center, const Matrix3& R_WB, std::vector<Eigen::Vector2d> profile,
                         double growth) {
  require_finite(center, "center");
  require_rotation(R_WB);
  return {center, R_WB, std::move(profile), growth};
}

Vector3 direction(const Vector3& v, const char* name) {
  require_finite(v, name);
  if (v.isZero(0.0)) throw std::domain_error(std::string(name) + " must not be zero");
  return v.stableNormalized();
}

}  // namespace

Plane make_plane(const Vector3& point, const Vector3& normal) {
  require_finite(point, "point");
  return {point, direction(normal, "normal")};
}

Disk make_disk(const Vector3& center, const Vector3& normal, double radius) {
  require_finite(center, "center");
  require_positive(radius, "radius");
  return {center, direction(normal, "normal"), radius};
}

Rectangle make_rectangle(const Vector3& center, const Vector3& normal, const Vector3& up, double width, double height) {
  require_finite(center, "center");
  require_positive(width, "width");
  require_positive(height, "height");
  const Vector3 n = direction(normal, "normal");
  const Vector3 u = direction(up, "up");
  const Vector3 across = u.cross(n);
  // Below, the direction of the height would be lost in rounding.
  constexpr double kLeastSine = 1e-12;
  if (across.norm() < kLeastSine) throw std::domain_error("up must not be parallel to the normal");
  return {center, n, n.cross(across.normalized()), width, height};
}

Triangle make_triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  require_finite(a, "corner");
  require_finite(b, "corner");
  require_finite(c, "corner");
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const Vector3 cross = ab.cross(ac);
  // |ab x ac| = 2 area; below, the normal would be lost in rounding.
  constexpr double kLeastSine = 1e-12;
  const double longest = std::max({ab.norm(), ac.norm(), (c - b).norm()});
  if (!(cross.norm() > kLeastSine * longest * longest)) {
    throw std::domain_error("the corners of a triangle must not lie on a line");
  }
  return {{a, b, c}, cross.stableNormalized()};
}

Vector3 edge_outward(const Triangle& triangle, int i) {
  const Vector3 edge = triangle.corners[(i + 1) % 3] - triangle.corners[i];
  return edge.cross(triangle.normal).stableNormalized();
}

Sphere make_sphere(const Vector3& center, double radius) {
  require_finite(center, "center");
  require_positive(radius, "radius");
  return {center, radius};
}

Box make_box(const Vector3& center, const Vector3& size, const Matrix3& R_WB) {
  require_finite(center, "center");
  for (const double edge : size) require_positive(edge, "size");
  require_rotation(R_WB);
  return {center, 0.5 * size, R_WB};
}

SolidOfRevolution make_cylinder(const Vector3& center, const Matrix3& R_WB, double radius, double height) {
  require_positive(radius, "radius");
  require_positive(height, "height");
  const double h = 0.5 * height;
  return turned(center, R_WB, {{0.0, -h}, {radius, -h}, {radius, h}, {0.0, h}}, 0.0);
}

SolidOfRevolution make_capsule(const Vector3& center, const Matrix3& R_WB, double radius, double height) {
  require_positive(radius, "radius");
  require_positive(height, "height");
  return turned(center, R_WB, {{0.0, -0.5 * height}, {0.0, 0.5 * height}}, radius);
}

SolidOfRevolution make_cone(const Vector3& center, const Matrix3& R_WB, double radius, double height) {
  require_positive(radius, "radius");
  require_positive(height, "height");
  return turned(center, R_WB, {{0.0, -0.25 * height}, {radius, -0.25 * height}, {0.0, 0.75 * height}}, 0.0);
}

EllipsoidBody make_ellipsoid(const Vector3& center, const Matrix3& R_WB, const Vector3& radii) {
  require_finite(center, "center");
  for (const double radius : radii) require_positive(radius, "radii");
  require_rotation(R_WB);
  return {center, radii, R_WB};
}

BoundingBall bounding_ball(const Disk& disk) { return {disk.center, disk.radius}; }
BoundingBall bounding_ball(const Rectangle& rectangle) {
  return {rectangle.center, 0.5 * std::hypot(rectangle.width, rectangle.height)};
}
BoundingBall bounding_ball(const Triangle& triangle) {
  const Vector3 center = (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3.0;
  double radius = 0.0;
  for (const Vector3& corner : triangle.corners) radius = std::max(radius, (corner - center).norm());
  return {center, radius};
}
BoundingBall bounding_ball(const Sphere& sphere) { return {sphere.center, sphere.radius}; }
BoundingBall bounding_ball(const Box& box) { return {box.center, box.half_size.norm()}; }
BoundingBall bounding_ball(const SolidOfRevolution& solid) {
  double reach = 0.0;
  for (const Eigen::Vector2d& corner : solid.profile) reach = std::max(reach, corner.norm());
  return {solid.center, reach + solid.growth};
}
BoundingBall bounding_ball(const EllipsoidBody& ellipsoid) { return {ellipsoid.center, ellipsoid.radii.maxCoeff()}; }

}  // namespace trajet
