#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "trajet/geom/shapes.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// Distances to a solid of revolution. In the half plane of a point and the axis the solid is a polygon that has grown;
/// rho is the distance from the axis, z the height along it.

namespace detail {

/// An edge of a profile: from a corner to the next, its outward normal m, unit, and m . p = limit on it.
struct ProfileEdge {
  Eigen::Vector2d from, to;
  Eigen::Vector2d along;   ///< unit
  Eigen::Vector2d normal;  ///< unit
  double length;

  ProfileEdge(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
      : from(a), to(b), along((b - a).normalized()), normal(along.y(), -along.x()), length((b - a).norm()) {}
  /// Parallel to the axis's normal plane: it meets the axis without a corner.
  bool is_level() const { return normal.x() == 0.0; }
};

inline ProfileEdge edge(const SolidOfRevolution& solid, std::size_t i) {
  return {solid.profile[i], solid.profile[i + 1]};
}

/// The nearest point of the surface in the half plane, with the outward normal there and the signed distance to it.
template <class T>
struct ProfilePlace {
  Eigen::Matrix<T, 2, 1> point, normal;
  T distance;
};

template <class T>
ProfilePlace<T> nearest_on_profile(const SolidOfRevolution& solid, const Eigen::Matrix<T, 2, 1>& p) {
  using Vector2T = Eigen::Matrix<T, 2, 1>;
  T height = -std::numeric_limits<T>::infinity(), nearest = std::numeric_limits<T>::infinity();
  Vector2T face_normal = Vector2T::Zero(), closest = Vector2T::Zero();
  for (std::size_t i = 0; i + 1 < solid.profile.size(); ++i) {
    const ProfileEdge each = edge(solid, i);
    // in the precision of p: the corners are doubles, their directions are not
    const Vector2T from = each.from.template cast<T>();
    const Vector2T way = each.to.template cast<T>() - from;
    const Vector2T along = way.normalized(), normal(along.y(), -along.x());
    const T above = normal.dot(p - from);
    if (above > height) {
      height = above;
      face_normal = normal;
    }
    const Vector2T on_edge = from + std::clamp<T>(along.dot(p - from), T(0), way.norm()) * along;
    const T distance = (p - on_edge).norm();
    if (distance < nearest) {
      nearest = distance;
      closest = on_edge;
    }
  }
  const T growth = T(solid.growth);
  if (height <= T(0) || !(nearest > T(0)))  // in the core: up to the nearest face
    return {p + (growth - height) * face_normal, face_normal, height - growth};
  const Vector2T normal = (p - closest) / nearest;
  return {closest + growth * normal, normal, nearest - growth};
}

template <class T>
struct RevolutionPlace {
  Vector3T<T> point, normal;
  T distance;
};

/// On the axis, where all directions are as good, that of x.
template <class T>
RevolutionPlace<T> nearest_on_surface(const SolidOfRevolution& solid, const Vector3T<T>& p) {
  const Matrix3 R_BW = solid.R_WB.transpose();
  const Vector3T<T> q = R_BW.template cast<T>() * (p - solid.center.template cast<T>());
  const T rho = std::sqrt(q.x() * q.x() + q.y() * q.y());
  const T x = rho > T(0) ? q.x() / rho : T(1), y = rho > T(0) ? q.y() / rho : T(0);
  const ProfilePlace<T> place = nearest_on_profile<T>(solid, {rho, q.z()});
  const auto in_world = [&](const Eigen::Matrix<T, 2, 1>& v) {
    return Vector3T<T>(solid.R_WB.template cast<T>() * Vector3T<T>(v.x() * x, v.x() * y, v.y()));
  };
  return {Vector3T<T>(solid.center.template cast<T>() + in_world(place.point)), in_world(place.normal), place.distance};
}

}  // namespace detail

/// The distance outside, the depth below the nearest face, negative, inside. T is double or Extended.
template <class T>
T signed_distance(const SolidOfRevolution& solid, const Vector3T<T>& p) {
  return detail::nearest_on_surface(solid, p).distance;
}

/// The nearest point of the surface; T is double or Extended.
template <class T>
Vector3T<T> closest_point(const SolidOfRevolution& solid, const Vector3T<T>& p) {
  return detail::nearest_on_surface(solid, p).point;
}

}  // namespace trajet
