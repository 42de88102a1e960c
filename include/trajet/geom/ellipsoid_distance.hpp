#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "trajet/geom/shapes.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// The way to an ellipsoid with the radii a_i along the axes of its frame. With q the place of a point in that frame,
/// the foot p of the perpendicular is p_i = a_i^2 q_i / (lambda + a_i^2), lambda the largest root of the secular
/// equation
///   sum_i (a_i q_i / (lambda + a_i^2))^2 = 1,
/// positive outside, and the normal is along u_i = q_i / (lambda + a_i^2), of length d / lambda [Eberly2013].

namespace detail {

template <class T>
struct EllipsoidFoot {
  T lambda;
  Vector3T<T> normal;  ///< unit, outward
  Vector3T<T> point;   ///< of the surface, nearest
  T distance;          ///< signed, negative inside
};

/// Of a point in the frame of the ellipsoid. T is double or Extended. Where several points are nearest, in the middle,
/// one of them.
template <class T>
EllipsoidFoot<T> ellipsoid_foot(const Vector3& radii, const Vector3T<T>& q) {
  using std::abs, std::sqrt;
  const Vector3T<T> a = radii.template cast<T>();
  const Vector3T<T> a2 = a.cwiseProduct(a);
  const Vector3T<T> aq = a.cwiseProduct(q).cwiseAbs();
  const T least2 = a2.minCoeff();
  // lambda = s - least2, s > 0: near the least radius nothing is lost. All s_i = s + (a_i^2 - least2).
  const Vector3T<T> more = a2 - Vector3T<T>::Constant(least2);
  const auto excess = [&](T s, T& rate) {
    T sum = T(-1);
    rate = T(0);
    for (int i = 0; i < 3; ++i) {
      if (aq[i] == T(0)) continue;
      const T ratio = aq[i] / (s + more[i]);
      sum += ratio * ratio;
      rate -= T(2) * ratio * ratio / (s + more[i]);
    }
    return sum;
  };
  // The sum falls and is convex: from a place at which it is not below zero Newton's steps come near from there.
  // Each term alone is 1 at s_i = a_i |q_i|: no root is below the largest of these.
  T s = T(0);
  for (int i = 0; i < 3; ++i) s = std::max(s, aq[i] - more[i]);
  T rate;
  bool has_root = s > T(0) || excess(T(0), rate) >= T(0);
  if (has_root) {
    constexpr int kMaxSteps = 100;
    for (int step = 0; step < kMaxSteps; ++step) {
      const T value = excess(s, rate);
      const T next = s - value / rate;
      if (!(next > s)) break;
      s = next;
    }
  }
  EllipsoidFoot<T> foot;
  foot.lambda = s - least2;
  Vector3T<T> u;
  for (int i = 0; i < 3; ++i) u[i] = aq[i] == T(0) ? T(0) : q[i] / (s + more[i]);
  if (!has_root) {
    // In the middle, where the axis of a least radius is met: the foot is beside it.
    T rest = T(1);
    for (int i = 0; i < 3; ++i) rest -= a2[i] * u[i] * u[i];
    Eigen::Index least;
    a2.minCoeff(&least);
    u[least] = sqrt(std::max(T(0), rest)) / a[least];
  }
  const T norm = u.norm();
  foot.normal = u / norm;
  // The support function: of all tangent planes that of the foot is the farthest outside and the nearest inside, so
  // that what rounding does to the normal counts twice over.
  const Vector3T<T> an = a.cwiseProduct(foot.normal);
  const T reach = an.norm();
  foot.distance = foot.normal.dot(q) - reach;
  foot.point = a.cwiseProduct(an) / reach;
  return foot;
}

}  // namespace detail

/// The distance outside, the depth, negative, inside. T is double or Extended.
template <class T>
T signed_distance(const EllipsoidBody& ellipsoid, const Vector3T<T>& p) {
  const Matrix3 R_BW = ellipsoid.R_WB.transpose();
  const Vector3T<T> q = R_BW.template cast<T>() * (p - ellipsoid.center.template cast<T>());
  return detail::ellipsoid_foot<T>(ellipsoid.radii, q).distance;
}

/// The nearest point of the surface; T is double or Extended.
template <class T>
Vector3T<T> closest_point(const EllipsoidBody& ellipsoid, const Vector3T<T>& p) {
  const Matrix3 R_BW = ellipsoid.R_WB.transpose();
  const Vector3T<T> q = R_BW.template cast<T>() * (p - ellipsoid.center.template cast<T>());
  return ellipsoid.center.template cast<T>() +
         ellipsoid.R_WB.template cast<T>() * detail::ellipsoid_foot<T>(ellipsoid.radii, q).point;
}

}  // namespace trajet
