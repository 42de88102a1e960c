#pragma once

#include <Eigen/Core>
#include <cmath>

namespace trajet::problems {

/// P1: dv_i/dt = -v_i^2 / k_i with a different k_i along each axis. State: (v, r), m/s and m.
struct Drag {
  static constexpr int kDimension = 6;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = q[0] * q[0] / -2.0;
    dq[1] = q[1] * q[1] / -1.0;
    dq[2] = q[2] * q[2] / -3.0;
    for (int i = 0; i < 3; ++i) dq[3 + i] = q[i];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 10.0; }
  static State start() { return (State() << 1, 1, 1, 0, 0, 0).finished(); }

  /// v_i = k_i / (k_i + t),  x_i = k_i ln(1 + t / k_i)
  static State exact(double t) {
    constexpr double k[3] = {2.0, 1.0, 3.0};  // m
    State q;
    for (int i = 0; i < 3; ++i) {
      q[i] = k[i] / (k[i] + t);
      q[3 + i] = k[i] * std::log1p(t / k[i]);
    }
    return q;
  }
};

}  // namespace trajet::problems
