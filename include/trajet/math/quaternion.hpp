#pragma once

#include <cmath>

#include "trajet/math/vector.hpp"

namespace trajet {

/// A quaternion (w, x, y, z) of any number type, Hamilton's product: ij = k.
template <class T>
using QuaternionT = Eigen::Quaternion<T>;
template <class T>
using Matrix3T = Eigen::Matrix<T, 3, 3>;

// What Eigen's type lacks. It has the product a * b, a.conjugate(), a.norm(), a.inverse(), a.dot(b).
// [Kuipers1999] ch. 5.

/// The quaternion (0, v) of a vector.
template <class T>
QuaternionT<T> pure(const Vector3T<T>& v) {
  return {T(0.0), v.x(), v.y(), v.z()};
}

/// a + b.
template <class T>
QuaternionT<T> sum(const QuaternionT<T>& a, const QuaternionT<T>& b) {
  return {a.w() + b.w(), a.x() + b.x(), a.y() + b.y(), a.z() + b.z()};
}

/// a - b.
template <class T>
QuaternionT<T> difference(const QuaternionT<T>& a, const QuaternionT<T>& b) {
  return {a.w() - b.w(), a.x() - b.x(), a.y() - b.y(), a.z() - b.z()};
}

/// s q for a number s.
template <class T>
QuaternionT<T> scaled(const T& s, const QuaternionT<T>& q) {
  return {s * q.w(), s * q.x(), s * q.y(), s * q.z()};
}

/// a . b = a_w b_w + a_x b_x + a_y b_y + a_z b_z, which is the scalar part of a b*, not a b* itself.
template <class T>
T dot(const QuaternionT<T>& a, const QuaternionT<T>& b) {
  return a.w() * b.w() + a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

/// q^-1 = q* / |q|^2.
template <class T>
QuaternionT<T> inverse(const QuaternionT<T>& q) {
  const T norm_squared = dot(q, q);
  return {q.w() / norm_squared, -q.x() / norm_squared, -q.y() / norm_squared, -q.z() / norm_squared};
}

/// q^-1 p: the solution x of q x = p.
template <class T>
QuaternionT<T> left_quotient(const QuaternionT<T>& q, const QuaternionT<T>& p) {
  return inverse(q) * p;
}

/// p q^-1: the solution x of x q = p.
template <class T>
QuaternionT<T> right_quotient(const QuaternionT<T>& p, const QuaternionT<T>& q) {
  return p * inverse(q);
}

/// The matrix of v -> vec(q (0, v) q*): a rotation if |q| = 1, else |q|^2 times one.
template <class T>
Matrix3T<T> rotation_matrix(const QuaternionT<T>& q) {
  const T ww = q.w() * q.w(), xx = q.x() * q.x(), yy = q.y() * q.y(), zz = q.z() * q.z();
  const T wx = q.w() * q.x(), wy = q.w() * q.y(), wz = q.w() * q.z();
  const T xy = q.x() * q.y(), xz = q.x() * q.z(), yz = q.y() * q.z();
  const T two(2.0);
  Matrix3T<T> R;
  R << ww + xx - yy - zz, two * (xy - wz), two * (xz + wy),  //
      two * (xy + wz), ww - xx + yy - zz, two * (yz - wx),   //
      two * (xz - wy), two * (yz + wx), ww - xx - yy + zz;
  return R;
}

/// vec(q (0, v) q*): v rotated if |q| = 1, else stretched by |q|^2 too.
template <class T>
Vector3T<T> rotate(const QuaternionT<T>& q, const Vector3T<T>& v) {
  return rotation_matrix(q) * v;
}

// From here on for plain numbers: there are cases.

/// exp(q) = e^w (cos |v|, v sin |v| / |v|), q = (w, v).
template <class T>
QuaternionT<T> exp(const QuaternionT<T>& q) {
  const T length = q.vec().stableNorm();
  const T sinc = length == T(0) ? T(1) : std::sin(length) / length;
  const T scale = std::exp(q.w());
  const Vector3T<T> v = scale * sinc * q.vec();
  return {scale * std::cos(length), v.x(), v.y(), v.z()};
}

/// log(q) = (ln |q|, v / |v| atan2(|v|, w)), q = (w, v) not 0: the inverse of exp with the shortest vector part.
/// Of a negative number, whose vector part can have any direction, the logarithm is (ln |q|, pi, 0, 0).
template <class T>
QuaternionT<T> log(const QuaternionT<T>& q) {
  const T length = q.vec().stableNorm();
  const T angle = std::atan2(length, q.w());
  const Vector3T<T> v = length == T(0) ? Vector3T<T>(angle, T(0), T(0)) : Vector3T<T>(q.vec() * (angle / length));
  return {std::log(std::hypot(length, q.w())), v.x(), v.y(), v.z()};
}

/// q^x = exp(x log q): a rotation by x times the angle.
template <class T>
QuaternionT<T> pow(const QuaternionT<T>& q, T x) {
  return exp(scaled(x, log(q)));
}

/// The unit quaternion of the rotation by |u| radians about u: exp((0, u / 2)).
template <class T>
QuaternionT<T> from_rotation_vector(const Vector3T<T>& u) {
  return exp(pure<T>(u / T(2)));
}

/// The rotation vector u of q's rotation, 0 <= |u| <= pi, rad. The length of q does not matter.
template <class T>
Vector3T<T> to_rotation_vector(const QuaternionT<T>& q) {
  // q and -q are one rotation: of the two, the one with w >= 0 turns by at most pi.
  return T(2) * log(q.w() < T(0) ? scaled(T(-1), q) : q).vec();
}

/// A rotation by `angle_rad` about `axis` (unit).
template <class T>
struct AxisAngle {
  Vector3T<T> axis;
  T angle_rad;
};

/// (cos(a / 2), u sin(a / 2)) for the angle a about the unit vector u. `axis` may have any length but 0.
template <class T>
QuaternionT<T> from_axis_angle(const Vector3T<T>& axis, T angle_rad) {
  return from_rotation_vector<T>(axis.stableNormalized() * angle_rad);
}

/// The angle is between 0 and pi. A rotation by 0 has the x axis.
template <class T>
AxisAngle<T> to_axis_angle(const QuaternionT<T>& q) {
  const Vector3T<T> u = to_rotation_vector(q);
  const T angle = u.stableNorm();
  return {angle == T(0) ? Vector3T<T>(Vector3T<T>::UnitX()) : Vector3T<T>(u / angle), angle};
}

/// The rotation at part t of the way from a to b (unit), at constant speed along the shortest way [Shoemake1985]:
/// a (a^-1 b)^t, with -b for b if that is nearer.
template <class T>
QuaternionT<T> slerp(const QuaternionT<T>& a, const QuaternionT<T>& b, T t) {
  return a * pow(a.conjugate() * (dot(a, b) < T(0) ? scaled(T(-1), b) : b), t);
}

/// The unit quaternion of a rotation matrix, w >= 0.
inline Quaternion from_rotation_matrix(const Matrix3& R) {
  const Quaternion q = Quaternion(R).normalized();
  return q.w() < 0.0 ? scaled(-1.0, q) : q;
}

/// The rotation nearest to a matrix in the sum of squares: U V^T of its singular value decomposition U S V^T, the last
/// singular vector turned round if that is no rotation.
Matrix3 nearest_rotation(const Matrix3& M);

}  // namespace trajet
