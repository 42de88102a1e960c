#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "trajet/geom/ellipsoid_distance.hpp"
#include "trajet/geom/shapes.hpp"
#include "trajet/geom/triangle_mesh.hpp"

namespace trajet {

/// A wall at a distance from a stretch of an axis, seen from the axis: of a bowl, where the stretch is a point, of a
/// hollow capsule, or of a pipe, where it has no end.
struct RoundWall {
  Vector3 center;
  Matrix3 R_WB;        ///< the last of its columns is the axis
  double half_length;  ///< of the stretch, m, >= 0; may be infinite
  double radius;
};

/// The walls of a cavity. Its inside is what is before all of them; every kind may be absent.
struct CavityWalls {
  std::vector<Plane> planes{};  ///< normals inward
  std::optional<RoundWall> round{};
  std::optional<EllipsoidBody> ellipsoid{};
  TriangleMesh picture{};  ///< in the world, outward; empty where another part of the same obstacle shows it
};

/// The inside of a sphere, a box, a cylinder, a capsule, an ellipsoid. Conditions as of the solid ones.
Cavity make_sphere_cavity(const Vector3& center, double radius);
Cavity make_box_cavity(const Vector3& center, const Vector3& size, const Matrix3& R_WB);
Cavity make_cylinder_cavity(const Vector3& center, const Matrix3& R_WB, double radius, double height);
Cavity make_capsule_cavity(const Vector3& center, const Matrix3& R_WB, double radius, double height);
Cavity make_ellipsoid_cavity(const Vector3& center, const Matrix3& R_WB, const Vector3& radii);

/// The same walls, each a cavity of its own: for those who meet several at once. The first one has the picture.
std::vector<Cavity> walls_of(const Cavity& cavity);

/// The radius of the largest ball that touches the walls everywhere: what is larger does not come into their bends.
/// Infinite where no wall is bent.
double largest_ball(const Cavity& cavity);

namespace detail {

template <class T>
struct WallPlace {
  Vector3T<T> point, normal;  ///< of the wall; the normal is unit, inward
  T height = std::numeric_limits<T>::infinity();
};

template <class T>
WallPlace<T> place_on(const Plane& plane, const Vector3T<T>& p) {
  const Vector3T<T> n = plane.normal.template cast<T>();
  const T height = n.dot(p - plane.point.template cast<T>());
  return {Vector3T<T>(p - height * n), n, height};
}

template <class T>
WallPlace<T> place_on(const RoundWall& wall, const Vector3T<T>& p) {
  const Vector3T<T> axis = Vector3(wall.R_WB.col(2)).template cast<T>();
  const Vector3T<T> q = p - wall.center.template cast<T>();
  const T half = T(wall.half_length), along = q.dot(axis);
  const T on_axis = along < -half ? -half : along > half ? half : along;
  const Vector3T<T> arm = q - on_axis * axis;
  const T rho = arm.norm();
  const Vector3T<T> outward =
      rho > T(0) ? Vector3T<T>(arm / rho) : Vector3T<T>(Vector3(wall.R_WB.col(0)).template cast<T>());
  return {Vector3T<T>(p + (T(wall.radius) - rho) * outward), Vector3T<T>(-outward), T(wall.radius) - rho};
}

template <class T>
WallPlace<T> place_on(const EllipsoidBody& ellipsoid, const Vector3T<T>& p) {
  const Matrix3 R_BW = ellipsoid.R_WB.transpose();
  const auto R_WB = ellipsoid.R_WB.template cast<T>();
  const Vector3T<T> center = ellipsoid.center.template cast<T>();
  const EllipsoidFoot<T> foot = ellipsoid_foot<T>(ellipsoid.radii, R_BW.template cast<T>() * (p - center));
  return {Vector3T<T>(center + R_WB * foot.point), Vector3T<T>(-(R_WB * foot.normal)), -foot.distance};
}

/// On the nearest wall.
template <class T>
WallPlace<T> nearest_on_walls(const Cavity& cavity, const Vector3T<T>& p) {
  WallPlace<T> nearest;
  const auto look_at = [&](const WallPlace<T>& place) {
    if (place.height < nearest.height) nearest = place;
  };
  for (const Plane& plane : cavity.walls->planes) look_at(place_on<T>(plane, p));
  if (cavity.walls->round) look_at(place_on<T>(*cavity.walls->round, p));
  if (cavity.walls->ellipsoid) look_at(place_on<T>(*cavity.walls->ellipsoid, p));
  return nearest;
}

}  // namespace detail

/// How far p is before the nearest wall; negative in the matter. T is double or Extended.
template <class T>
T signed_distance(const Cavity& cavity, const Vector3T<T>& p) {
  return detail::nearest_on_walls(cavity, p).height;
}

/// The nearest point of the walls; T is double or Extended.
template <class T>
Vector3T<T> closest_point(const Cavity& cavity, const Vector3T<T>& p) {
  return detail::nearest_on_walls(cavity, p).point;
}

}  // namespace trajet
