#pragma once

#include <algorithm>
#include <cmath>

#include "trajet/geom/cavity.hpp"
#include "trajet/geom/distance.hpp"
#include "trajet/geom/ellipsoid_distance.hpp"
#include "trajet/geom/landscape.hpp"
#include "trajet/geom/revolution_distance.hpp"
#include "trajet/geom/shapes.hpp"
#include "trajet/portable.hpp"

namespace trajet {

/// The point of a shape's surface that is nearest to p; of thin shapes, the nearest point. In the precision of p: T is
/// double or Extended.

template <class T>
Vector3T<T> closest_point(const Plane& plane, const Vector3T<T>& p) {
  return p - signed_distance(plane, p) * plane.normal.cast<T>();
}

template <class T>
Vector3T<T> closest_point(const Disk& disk, const Vector3T<T>& p) {
  const Vector3T<T> foot = p - height(disk, p) * disk.normal.cast<T>();
  const Vector3T<T> radial = foot - disk.center.cast<T>();
  const T rho = radial.norm();
  return rho <= T(disk.radius) ? foot : Vector3T<T>(disk.center.cast<T>() + radial * (T(disk.radius) / rho));
}

template <class T>
Vector3T<T> closest_point(const Rectangle& rectangle, const Vector3T<T>& p) {
  const Vector3T<T> center = rectangle.center.cast<T>(), up = rectangle.up.cast<T>();
  const Vector3T<T> side = across(rectangle).template cast<T>(), q = p - center;
  const T half_width = T(0.5) * T(rectangle.width), half_height = T(0.5) * T(rectangle.height);
  return center + std::clamp<T>(q.dot(side), -half_width, half_width) * side +
         std::clamp<T>(q.dot(up), -half_height, half_height) * up;
}

template <class T>
Vector3T<T> closest_point(const Triangle& triangle, const Vector3T<T>& p) {
  if (in_plane_gap(triangle, Vector3(p.template cast<double>())) <= 0.0)
    return p - height(triangle, p) * triangle.normal.cast<T>();
  Vector3T<T> nearest = triangle.corners[0].cast<T>();
  for (int i = 0; i < 3; ++i) {
    const Vector3T<T> a = triangle.corners[i].cast<T>();
    const Vector3T<T> edge = triangle.corners[(i + 1) % 3].cast<T>() - a;
    const Vector3T<T> on_edge = a + std::clamp<T>((p - a).dot(edge) / edge.squaredNorm(), T(0), T(1)) * edge;
    if ((p - on_edge).squaredNorm() < (p - nearest).squaredNorm()) nearest = on_edge;
  }
  return nearest;
}

/// The centre itself has no nearest point: the point in the direction of x then.
template <class T>
Vector3T<T> closest_point(const Sphere& sphere, const Vector3T<T>& p) {
  const Vector3T<T> q = p - sphere.center.cast<T>();
  const Vector3T<T> direction = q.isZero(T(0)) ? Vector3T<T>(Vector3T<T>::UnitX()) : Vector3T<T>(q.stableNormalized());
  return sphere.center.cast<T>() + T(sphere.radius) * direction;
}

template <class T>
Vector3T<T> closest_point(const Box& box, const Vector3T<T>& p) {
  const Vector3T<T> half_size = box.half_size.cast<T>();
  const Vector3T<T> q = box.R_WB.transpose().cast<T>() * (p - box.center.cast<T>());
  Vector3T<T> nearest = q.cwiseMax(-half_size).cwiseMin(half_size);
  if (nearest == q) {
    // Inside: up to the nearest face.
    Eigen::Index axis;
    (q.cwiseAbs() - half_size).maxCoeff(&axis);
    nearest[axis] = std::copysign(half_size[axis], q[axis]);
  }
  return box.center.cast<T>() + box.R_WB.cast<T>() * nearest;
}

/// The triangle of a surface that is nearest to p.
Triangle nearest_triangle(const MeshSurface& surface, const Vector3& p);
/// How far a surface has grown from its triangles.
double growth(const MeshSurface& surface);

template <class T>
Vector3T<T> closest_point(const MeshSurface& surface, const Vector3T<T>& p) {
  const Triangle triangle = nearest_triangle(surface, Vector3(p.template cast<double>()));
  const Vector3T<T> nearest = closest_point(triangle, p);
  const T grown = T(growth(surface));
  if (grown == T(0)) return nearest;
  // outside the triangles along the way to p, within them along the face's normal
  const Vector3T<T> way = p - nearest, normal = triangle.normal.cast<T>();
  return nearest + grown * (way.dot(normal) > T(0) ? Vector3T<T>(way.normalized()) : normal);
}

}  // namespace trajet
