#pragma once

#include <Eigen/Core>
#include <cmath>

namespace trajet::problems {

/// P3: a top on which no torque acts, nearly about its middle axis, which flips over and over. State: (q_WB, w_WB_B),
/// the quaternion as (w, x, y, z); Euler's equations with I = (1, 2, 3) kg m^2 and dq/dt = 1/2 q (0, w).
struct FreeTop {
  static constexpr int kDimension = 7;
  using State = Eigen::Matrix<double, kDimension, 1>;
  static Eigen::Vector3d inertia() { return {1.0, 2.0, 3.0}; }

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = -0.5 * (q[1] * q[4] + q[2] * q[5] + q[3] * q[6]);
    dq[1] = 0.5 * (q[0] * q[4] + q[2] * q[6] - q[3] * q[5]);
    dq[2] = 0.5 * (q[0] * q[5] + q[3] * q[4] - q[1] * q[6]);
    dq[3] = 0.5 * (q[0] * q[6] + q[1] * q[5] - q[2] * q[4]);
    dq[4] = -(q[5] * q[6]);
    dq[5] = q[6] * q[4];
    dq[6] = q[4] * q[5] / -3.0;
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 100.0; }
  static State start() { return (State() << 1, 0, 0, 0, 0.01, 3, 0.02).finished(); }

  /// By power series in 45 digits.
  static State reference_end() {
    return (State() << -0.03721279083132670795600617, 0.7050721440314557909425512, -0.1178124955757913915943513,
            -0.6982898365260904474068683, -0.7446091735485840102351363, -2.906141286769673677480387,
            0.4303265509403702835510494)
        .finished();
  }

  /// Twice the kinetic energy, and the square of the angular momentum.
  static Eigen::Vector2d invariants(const State& q) {
    const Eigen::Vector3d w = q.tail<3>(), momentum = inertia().cwiseProduct(w);
    return {w.dot(momentum), momentum.squaredNorm()};
  }
};

}  // namespace trajet::problems
