#pragma once

#include <cmath>

#include "trajet/geom/shapes.hpp"
#include "trajet/math/number.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// Distances from a point to a shape, generic in the number type: on double they are values, on IntervalJets they
/// enclose the distance and its derivatives along a path. World frame, metres. Pure functions.

namespace detail {

/// a . b
template <class T>
T dot(const Vector3& a, const Vector3T<T>& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

/// p - a
template <class T>
Vector3T<T> difference(const Vector3T<T>& p, const Vector3& a) {
  return {p.x() - T(a.x()), p.y() - T(a.y()), p.z() - T(a.z())};
}

inline double square(double x) { return x * x; }

template <class T>
T squared_norm(const Vector3T<T>& v) {
  return square(v.x()) + square(v.y()) + square(v.z());
}

/// `a` where the condition holds, else `b`: a choice between functions whose values and gradients agree where it
/// changes. Number types that enclose derivatives have an overload beside the type that makes use of that.
inline double where_smooth(bool condition, double a, double b) { return condition ? a : b; }

/// max(x, 0)^2
template <class T>
T squared_overhang(const T& x) {
  return where_smooth(less_equal(x, T(0.0)), T(0.0), square(x));
}

/// The square of how far x is outside [-h, h]
template <class T>
T squared_overhang(const T& x, double h) {
  return squared_overhang<T>(x - T(h)) + squared_overhang<T>(-x - T(h));
}

/// |q . axis| - half_size for the three axes of a box, q from its centre
template <class T>
Vector3T<T> face_gaps(const Box& box, const Vector3T<T>& p) {
  const Vector3T<T> q = difference(p, box.center);
  using std::abs;
  const auto gap = [&](int i) { return abs(dot<T>(box.R_WB.col(i), q)) - T(box.half_size[i]); };
  return {gap(0), gap(1), gap(2)};
}

/// The square of the distance from p to the edge from a to b: with q = p - a and the unit vector e along the edge of
/// length l, |q - (q.e) e|^2 + max(-q.e, 0)^2 + max(q.e - l, 0)^2
template <class T>
T squared_distance_to_edge(const Vector3& a, const Vector3& b, const Vector3T<T>& p) {
  const double length = (b - a).norm();
  const Vector3 e = (b - a) / length;
  const Vector3T<T> q = difference(p, a);
  const T along = dot<T>(e, q);
  return squared_norm<T>({q.x() - e.x() * along, q.y() - e.y() * along, q.z() - e.z() * along}) +
         squared_overhang<T>(-along) + squared_overhang<T>(along - T(length));
}

}  // namespace detail

/// Height above the plane: n . (p - p0). Negative in the solid.
template <class T>
T signed_distance(const Plane& plane, const Vector3T<T>& p) {
  return detail::dot(plane.normal, detail::difference(p, plane.point));
}

/// |p - c| - R. Negative inside.
template <class T>
T signed_distance(const Sphere& sphere, const Vector3T<T>& p) {
  const Vector3T<T> q = detail::difference(p, sphere.center);
  return norm3(q.x(), q.y(), q.z()) - T(sphere.radius);
}

/// With d_i = |q_i| - h_i, q = R^T (p - c): max_i d_i. Zero on the surface, negative inside, less than the distance
/// outside where p is beyond an edge; smooth where a path crosses a face.
template <class T>
T face_gap(const Box& box, const Vector3T<T>& p) {
  const Vector3T<T> d = detail::face_gaps(box, p);
  return max(d.x(), max(d.y(), d.z()));
}

/// The distance to the solid box, zero inside: sqrt(sum_i max(|q_i| - h_i, 0)^2).
template <class T>
T distance(const Box& box, const Vector3T<T>& p) {
  const Vector3T<T> q = detail::difference(p, box.center);
  const auto overhang = [&](int i) {
    return detail::squared_overhang<T>(detail::dot<T>(box.R_WB.col(i), q), box.half_size[i]);
  };
  using std::sqrt;
  return sqrt(T(overhang(0) + overhang(1) + overhang(2)));
}

/// The distance outside, the depth below the nearest face, negative, inside.
template <class T>
T signed_distance(const Box& box, const Vector3T<T>& p) {
  const T gap = face_gap(box, p);
  return where(less_equal(gap, T(0.0)), gap, distance(box, p));
}

/// The height above a thin shape's plane, on the side of its normal: n . (p - c).
template <class T>
T height(const Disk& disk, const Vector3T<T>& p) {
  return detail::dot(disk.normal, detail::difference(p, disk.center));
}
template <class T>
T height(const Rectangle& rectangle, const Vector3T<T>& p) {
  return detail::dot(rectangle.normal, detail::difference(p, rectangle.center));
}
template <class T>
T height(const Triangle& triangle, const Vector3T<T>& p) {
  return detail::dot(triangle.normal, detail::difference(p, triangle.corners[0]));
}

/// How far the foot of p in the disk's plane is beyond the rim, negative within: |q - (n . q) n| - R.
template <class T>
T in_plane_gap(const Disk& disk, const Vector3T<T>& p) {
  const Vector3T<T> q = detail::difference(p, disk.center);
  const T a = detail::dot(disk.normal, q);
  const Vector3& n = disk.normal;
  return norm3(q.x() - n.x() * a, q.y() - n.y() * a, q.z() - n.z() * a) - T(disk.radius);
}

/// The direction of a rectangle's width.
inline Vector3 across(const Rectangle& rectangle) { return rectangle.up.cross(rectangle.normal); }

/// How far the foot of p in the rectangle's plane is beyond its lines of edges, negative within.
template <class T>
T in_plane_gap(const Rectangle& rectangle, const Vector3T<T>& p) {
  const Vector3T<T> q = detail::difference(p, rectangle.center);
  using std::abs;
  return max(T(abs(detail::dot<T>(across(rectangle), q)) - T(0.5 * rectangle.width)),
             T(abs(detail::dot(rectangle.up, q)) - T(0.5 * rectangle.height)));
}

/// How far the foot of p in the triangle's plane is beyond its lines of edges, negative within: max_i m_i . (p - p_i).
template <class T>
T in_plane_gap(const Triangle& triangle, const Vector3T<T>& p) {
  const auto beyond = [&](int i) {
    return detail::dot(edge_outward(triangle, i), detail::difference(p, triangle.corners[i]));
  };
  return max(beyond(0), max(beyond(1), beyond(2)));
}

/// The distance to the disk: sqrt(a^2 + max(rho - R, 0)^2), a the height, rho the distance from the axis.
template <class T>
T distance(const Disk& disk, const Vector3T<T>& p) {
  using detail::square;
  using std::sqrt;
  return sqrt(T(square(height(disk, p)) + detail::squared_overhang(in_plane_gap(disk, p))));
}

/// The distance to the rectangle: the height and the two overhangs beyond the edges are orthogonal.
template <class T>
T distance(const Rectangle& rectangle, const Vector3T<T>& p) {
  const Vector3T<T> q = detail::difference(p, rectangle.center);
  using detail::square;
  using std::sqrt;
  return sqrt(T(square(height(rectangle, p)) +
                detail::squared_overhang<T>(detail::dot<T>(across(rectangle), q), 0.5 * rectangle.width) +
                detail::squared_overhang<T>(detail::dot(rectangle.up, q), 0.5 * rectangle.height)));
}

/// The distance to the triangle: the height above its inside, else the least distance to an edge. Outside, the least of
/// the squares has a continuous gradient, because the triangle is convex.
template <class T>
T distance(const Triangle& triangle, const Vector3T<T>& p) {
  const auto to_edge = [&](int i) {
    return detail::squared_distance_to_edge<T>(triangle.corners[i], triangle.corners[(i + 1) % 3], p);
  };
  using detail::square, detail::where_smooth;
  using std::sqrt;
  const auto lesser = [](const T& a, const T& b) { return where_smooth(less(b, a), b, a); };
  return sqrt(T(where_smooth(less_equal(in_plane_gap(triangle, p), T(0.0)), T(square(height(triangle, p))),
                             lesser(to_edge(0), lesser(to_edge(1), to_edge(2))))));
}

}  // namespace trajet
