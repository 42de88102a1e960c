#pragma once

#include <Eigen/Core>
#include <cmath>

namespace trajet::problems {

/// P2: a spinning ball, a = g - K_d |v| v + K_m w x v with w = (0, 0, 50) rad/s. State: (v, r), m/s and m.
struct FreeKick {
  static constexpr int kDimension = 6;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    using std::sqrt;
    const auto drag = -kDrag * sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
    dq[0] = drag * q[0] - kMagnus * q[1];
    dq[1] = drag * q[1] + kMagnus * q[0];
    dq[2] = drag * q[2] - kGravity;
    for (int i = 0; i < 3; ++i) dq[3 + i] = q[i];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 2.0; }
  static State start() { return (State() << 25, 3, 8, 0, 0, 0).finished(); }

  /// By extrapolation of the midpoint rule in 113-bit arithmetic; 20 and 40 steps agree to 24 digits.
  static State reference_end() {
    return (State() << 11.35192114503020531, 9.944941720661236543, -10.79312753154674497,  //
            35.28750153096629655, 14.67794489570918087, -4.391400329706509820)
        .finished();
  }

 private:
  static constexpr double kGravity = 9.81;       // m/s^2
  static constexpr double kDrag = 0.0126;        // 1/m
  static constexpr double kMagnus = 0.006 * 50;  // 1/s
};

}  // namespace trajet::problems
