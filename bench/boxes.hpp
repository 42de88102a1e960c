#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "trajet/math/quaternion.hpp"

namespace trajet::bench {

/// The benchmark "boxes" of the engines under Gazebo [PetersHsu2014], without gravity: a box that tumbles freely for
/// 10 s. It turns nearly about its middle axis.
struct Boxes {
  static constexpr const char* kName = "Boxes";
  static constexpr double kMass = 10.0;      // kg
  static constexpr double kDuration = 10.0;  // s
  static Vector3 size() { return {0.1, 0.4, 0.9}; }
  static Vector3 velocity() { return {-2, 2, 8}; }
  static Vector3 angular_velocity() { return {0.1, 5, 0.1}; }

  static Vector3 inertia() {
    const Vector3 squares = size().cwiseAbs2();
    return kMass / 12.0 * (Vector3::Constant(squares.sum()) - squares);
  }

  /// The relative error of the energy of rotation or of the angular momentum, whichever is larger, at an orientation
  /// and an angular velocity in the world's frame.
  static double drift(const Quaternion& q_WB, const Vector3& w_WB_W) {
    const Vector3 w_start = angular_velocity(), momentum_start = inertia().cwiseProduct(w_start);
    const Quaternion unit = q_WB.normalized();
    const Vector3 w_body = rotate<double>(unit.conjugate(), w_WB_W);
    const Vector3 momentum = rotate<double>(unit, inertia().cwiseProduct(w_body));
    const double energy = w_body.dot(inertia().cwiseProduct(w_body)), energy_start = w_start.dot(momentum_start);
    return std::max(std::abs(energy / energy_start - 1.0), (momentum - momentum_start).norm() / momentum_start.norm());
  }
};

/// State: (r, v, q_WB, w_WB_B), the quaternion as (w, x, y, z).
struct FreeBox {
  Vector3 inertia = Boxes::inertia();

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    const auto &s = q[6], &x = q[7], &y = q[8], &z = q[9], &wx = q[10], &wy = q[11], &wz = q[12];
    for (int i = 0; i < 3; ++i) dq[i] = q[3 + i];
    for (int i = 3; i < 6; ++i) dq[i] = 0.0;
    dq[6] = -0.5 * (x * wx + y * wy + z * wz);
    dq[7] = 0.5 * (s * wx + y * wz - z * wy);
    dq[8] = 0.5 * (s * wy + z * wx - x * wz);
    dq[9] = 0.5 * (s * wz + x * wy - y * wx);
    dq[10] = (inertia[1] - inertia[2]) / inertia[0] * (wy * wz);
    dq[11] = (inertia[2] - inertia[0]) / inertia[1] * (wz * wx);
    dq[12] = (inertia[0] - inertia[1]) / inertia[2] * (wx * wy);
  }
};

}  // namespace trajet::bench
