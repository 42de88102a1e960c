#pragma once

#include <array>
#include <cstddef>

#include "trajet/math/quaternion.hpp"

namespace trajet {

// The equations of motion of an orientation and of an angular velocity, for any number type. W is the world, B the
// body; w_WB_W and w_WB_B are the same angular velocity (rad/s) in the frames W and B.

/// The matrix w~ of v -> w x v.
template <class T>
Matrix3T<T> cross_matrix(const Vector3T<T>& w) {
  const T zero(0.0);
  Matrix3T<T> m;
  m << zero, -w.z(), w.y(), w.z(), zero, -w.x(), -w.y(), w.x(), zero;
  return m;
}

/// dR/dt = w~ R for w in the world's frame.
template <class T>
Matrix3T<T> matrix_rate_world(const Matrix3T<T>& R_WB, const Vector3T<T>& w_WB_W) {
  return cross_matrix(w_WB_W) * R_WB;
}
/// dR/dt = R w~ for w in the body's frame.
template <class T>
Matrix3T<T> matrix_rate_body(const Matrix3T<T>& R_WB, const Vector3T<T>& w_WB_B) {
  return R_WB * cross_matrix(w_WB_B);
}

/// dq/dt = 1/2 (0, w) q for w in the world's frame: the factors in this order.
template <class T>
QuaternionT<T> quaternion_rate_world(const QuaternionT<T>& q_WB, const Vector3T<T>& w_WB_W) {
  return scaled(T(0.5), pure(w_WB_W) * q_WB);
}
/// dq/dt = 1/2 q (0, w) for w in the body's frame.
template <class T>
QuaternionT<T> quaternion_rate_body(const QuaternionT<T>& q_WB, const Vector3T<T>& w_WB_B) {
  return scaled(T(0.5), q_WB * pure(w_WB_B));
}

namespace detail {

/// sum_k c_k s^k.
template <class T, std::size_t N>
T polynomial(const std::array<double, N>& c, const T& s) {
  T sum = T(c[N - 1]);
  for (std::size_t k = N - 1; k-- > 0;) sum = sum * s + T(c[k]);
  return sum;
}

/// (-1/4)^k / (2k + first)! for k = 0, 1, …: cos(sqrt(s) / 2) for first = 0, sin(sqrt(s) / 2) / (sqrt(s) / 2) for 1.
template <std::size_t N>
constexpr std::array<double, N> half_angle_coefficients(int first) {
  std::array<double, N> c{};
  c[0] = 1.0;
  for (std::size_t k = 1; k < N; ++k) {
    const double n = 2.0 * static_cast<double>(k) + first;
    c[k] = -0.25 * c[k - 1] / (n * (n - 1.0));
  }
  return c;
}
// The first term left out is below 2^-53 for turns up to pi.
inline constexpr auto kHalfCosine = half_angle_coefficients<12>(0);
inline constexpr auto kHalfSinc = half_angle_coefficients<12>(1);

// (1 - theta/2 cot(theta/2)) / theta^2 = sum_k |B_(2k+2)| / (2k + 2)! theta^(2k), B the numbers of Bernoulli. The terms
// left out are below 2^-53 for turns up to 0.9 rad; they are of order 22 in the step.
inline constexpr std::array<double, 10> kInverseDerivative{1.0 / 12,
                                                           1.0 / 720,
                                                           1.0 / 30240,
                                                           1.0 / 1209600,
                                                           1.0 / 47900160,
                                                           691.0 / 1307674368000,
                                                           1.0 / 74724249600,
                                                           3617.0 / 10670622842880000,
                                                           43867.0 / 5109094217170944000,
                                                           174611.0 / 802857662698291200000.0};

}  // namespace detail

/// The quaternion of a rotation by |u| about u, |u| <= pi, for any number type: a series in |u|^2 that has no special
/// case at 0. Compare from_rotation_vector.
template <class T>
QuaternionT<T> small_rotation(const Vector3T<T>& u) {
  const T s = u.x() * u.x() + u.y() * u.y() + u.z() * u.z();
  const T half_sinc = T(0.5) * detail::polynomial(detail::kHalfSinc, s);
  return {detail::polynomial(detail::kHalfCosine, s), half_sinc * u.x(), half_sinc * u.y(), half_sinc * u.z()};
}

namespace detail {
/// w + sign/2 u x w + c(|u|^2) u x (u x w)
template <class T>
Vector3T<T> inverse_derivative(const Vector3T<T>& u, const Vector3T<T>& w, double sign) {
  const Matrix3T<T> cross = cross_matrix(u);
  const Vector3T<T> once = cross * w;
  const Vector3T<T> twice = cross * once;
  const T s = u.x() * u.x() + u.y() * u.y() + u.z() * u.z();
  const T c = polynomial(kInverseDerivative, s);
  const T half = T(0.5 * sign);
  return {w.x() + half * once.x() + c * twice.x(), w.y() + half * once.y() + c * twice.y(),
          w.z() + half * once.z() + c * twice.z()};
}
}  // namespace detail

/// du/dt of R = exp(u~) R_0 for w in the world's frame: the inverse of the derivative of the exponential, without
/// commutators of stages [MuntheKaas1998], [IserlesMuntheKaasNorsettZanna2000] 2.5 and B.
template <class T>
Vector3T<T> rotation_vector_rate_world(const Vector3T<T>& u, const Vector3T<T>& w_WB_W) {
  return detail::inverse_derivative(u, w_WB_W, -1.0);
}
/// du/dt of R = R_0 exp(u~) for w in the body's frame.
template <class T>
Vector3T<T> rotation_vector_rate_body(const Vector3T<T>& u, const Vector3T<T>& w_WB_B) {
  return detail::inverse_derivative(u, w_WB_B, 1.0);
}

/// Euler's equations: dw/dt = I^-1 (torque - w x I w), all in the body's frame, I about the centre of mass (kg m^2).
template <class T>
Vector3T<T> angular_acceleration_body(const Matrix3& inertia, const Matrix3& inverse_inertia, const Vector3T<T>& w_WB_B,
                                      const Vector3T<T>& torque_B) {
  const Vector3T<T> momentum = inertia.cast<T>() * w_WB_B;
  const Vector3T<T> gyroscopic = cross_matrix(w_WB_B) * momentum;
  const Vector3T<T> net = torque_B - gyroscopic;
  return inverse_inertia.cast<T>() * net;
}

/// A point of a solid, fixed in it at p_B.
struct PointMotion {
  Vector3 position;      ///< m
  Vector3 velocity;      ///< m/s
  Vector3 acceleration;  ///< m/s^2
};

/// From the motion of the centre of mass, the matrix that carries body coordinates into the world, and the angular
/// velocity and acceleration in the world's frame: r + rho, v + w x rho, a + alpha x rho + w x (w x rho), rho = R p_B.
inline PointMotion point_motion(const PointMotion& center, const Matrix3& R_WB, const Vector3& w_WB_W,
                                const Vector3& alpha_WB_W, const Vector3& p_B) {
  const Vector3 rho = R_WB * p_B;
  const Vector3 swing = w_WB_W.cross(rho);
  return {center.position + rho, center.velocity + swing,
          center.acceleration + alpha_WB_W.cross(rho) + w_WB_W.cross(swing)};
}

}  // namespace trajet
