#include "trajet/geom/distance.hpp"

#include <algorithm>

namespace trajet {

Vector3 closest_point(const Plane& plane, const Vector3& p) { return p - signed_distance(plane, p) * plane.normal; }

Vector3 closest_point(const Disk& disk, const Vector3& p) {
  const Vector3 foot = p - height(disk, p) * disk.normal;
  const Vector3 radial = foot - disk.center;
  const double rho = radial.norm();
  return rho <= disk.radius ? foot : disk.center + radial * (disk.radius / rho);
}

Vector3 closest_point(const Rectangle& rectangle, const Vector3& p) {
  const Vector3 q = p - rectangle.center;
  return rectangle.center +
         std::clamp(q.dot(across(rectangle)), -0.5 * rectangle.width, 0.5 * rectangle.width) * across(rectangle) +
         std::clamp(q.dot(rectangle.up), -0.5 * rectangle.height, 0.5 * rectangle.height) * rectangle.up;
}

Vector3 closest_point(const Triangle& triangle, const Vector3& p) {
  if (in_plane_gap(triangle, p) <= 0.0) return p - height(triangle, p) * triangle.normal;
  Vector3 nearest = triangle.corners[0];
  for (int i = 0; i < 3; ++i) {
    const Vector3& a = triangle.corners[i];
    const Vector3 edge = triangle.corners[(i + 1) % 3] - a;
    const Vector3 on_edge = a + std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0) * edge;
    if ((p - on_edge).squaredNorm() < (p - nearest).squaredNorm()) nearest = on_edge;
  }
  return nearest;
}

Vector3 closest_point(const Sphere& sphere, const Vector3& p) {
  const Vector3 q = p - sphere.center;
  const Vector3 direction = q.isZero(0.0) ? Vector3(Vector3::UnitX()) : Vector3(q.stableNormalized());
  return sphere.center + sphere.radius * direction;
}

Vector3 closest_point(const Box& box, const Vector3& p) {
  const Vector3 q = box.R_WB.transpose() * (p - box.center);
  Vector3 nearest = q.cwiseMax(-box.half_size).cwiseMin(box.half_size);
  if (nearest == q) {
    // Inside: up to the nearest face.
    Eigen::Index axis;
    (q.cwiseAbs() - box.half_size).maxCoeff(&axis);
    nearest[axis] = std::copysign(box.half_size[axis], q[axis]);
  }
  return box.center + box.R_WB * nearest;
}

}  // namespace trajet
