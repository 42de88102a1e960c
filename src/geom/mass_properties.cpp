#include "trajet/geom/mass_properties.hpp"

#include <numbers>
#include <stdexcept>

namespace trajet {

using std::numbers::pi;

VolumeProperties sphere_properties(double radius) {
  const double volume = 4.0 / 3.0 * pi * radius * radius * radius;
  return {volume, Vector3::Zero(), 0.4 * volume * radius * radius * Matrix3::Identity()};
}

VolumeProperties box_properties(const Vector3& size) {
  const double volume = size.prod();
  const Vector3 squares = size.cwiseAbs2();
  const Vector3 moments =
      volume / 12.0 * Vector3(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y());
  return {volume, Vector3::Zero(), moments.asDiagonal()};
}

VolumeProperties cylinder_properties(double radius, double height) {
  const double volume = pi * radius * radius * height;
  const double across = volume * (3.0 * radius * radius + height * height) / 12.0;
  return {volume, Vector3::Zero(), Vector3(across, across, 0.5 * volume * radius * radius).asDiagonal()};
}

VolumeProperties capsule_properties(double radius, double height) {
  const VolumeProperties cylinder = cylinder_properties(radius, height);
  const double ball = 4.0 / 3.0 * pi * radius * radius * radius;
  const double r2 = radius * radius, h2 = height * height;
  // Two half balls: about the diameter of its flat side each has 2/5 m r^2; its centre of mass is 3/8 r away from
  // there, so that about an axis h/2 further the pair has m (2/5 r^2 + h^2/4 + 3/8 r h).
  const double across = cylinder.inertia(0, 0) + ball * (0.4 * r2 + 0.25 * h2 + 0.375 * radius * height);
  const double along = cylinder.inertia(2, 2) + 0.4 * ball * r2;
  return {cylinder.volume + ball, Vector3::Zero(), Vector3(across, across, along).asDiagonal()};
}

VolumeProperties cone_properties(double radius, double height) {
  const double volume = pi / 3.0 * radius * radius * height;
  const double across = 3.0 / 80.0 * volume * (4.0 * radius * radius + height * height);
  return {volume, Vector3::Zero(), Vector3(across, across, 0.3 * volume * radius * radius).asDiagonal()};
}

VolumeProperties ellipsoid_properties(const Vector3& radii) {
  const double volume = 4.0 / 3.0 * pi * radii.prod();
  const Vector3 squares = radii.cwiseAbs2();
  const Vector3 moments =
      0.2 * volume * Vector3(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y());
  return {volume, Vector3::Zero(), moments.asDiagonal()};
}

VolumeProperties mesh_properties(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) throw std::domain_error("the surface has no vertices");
  // Sums over tetrahedra with the corners o, a, b, c, relative to o: with D = (a x b) . c, which is six times the
  // volume, int x = D/24 (a + b + c), int x x^T = D/120 (a a^T + b b^T + c c^T + (a + b + c) (a + b + c)^T)
  const Vector3 origin = mesh.vertices[0];
  double six_volumes = 0.0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
  for (const auto& triangle : mesh.triangles) {
    const auto corner = [&](std::size_t i) {
      return Vector3(mesh.vertices[static_cast<std::size_t>(triangle[i])] - origin);
    };
    const Vector3 a = corner(0), b = corner(1), c = corner(2);
    const Vector3 total = a + b + c;
    const double D = a.cross(b).dot(c);
    six_volumes += D;
    first += D / 24.0 * total;
    second += D / 120.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + total * total.transpose());
  }
  const double volume = six_volumes / 6.0;
  if (!(volume > 0.0)) throw std::domain_error("the surface encloses no volume");
  const Vector3 center = first / volume;
  const Matrix3 about_center = second - volume * center * center.transpose();
  return {volume, origin + center, about_center.trace() * Matrix3::Identity() - about_center};
}

}  // namespace trajet
