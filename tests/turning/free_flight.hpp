#pragma once

#include <Eigen/Core>
#include <type_traits>

namespace trajet::turning {

/// A rigid body that falls and turns freely. State: (r, v, q_WB, w_WB_B), the quaternion as (w, x, y, z); Euler's
/// equations about principal axes and dq/dt = 1/2 q (0, w).
struct FreeFlight {
  using State = Eigen::Matrix<double, 13, 1>;

  Eigen::Vector3d inertia = Eigen::Vector3d::Ones();  ///< kg m^2; only ratios matter
  double gravity = 9.81;                              ///< m/s^2, against z

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& d) const {
    using N = std::decay_t<decltype(d[0])>;
    for (int i = 0; i < 3; ++i) d[i] = q[3 + i];
    d[3] = N(0.0), d[4] = N(0.0), d[5] = N(-gravity);
    const auto &w = q[6], &x = q[7], &y = q[8], &z = q[9], &a = q[10], &b = q[11], &c = q[12];
    d[6] = N(-0.5) * (x * a + y * b + z * c), d[7] = N(0.5) * (w * a + y * c - z * b);
    d[8] = N(0.5) * (w * b + z * a - x * c), d[9] = N(0.5) * (w * c + x * b - y * a);
    d[10] = N((inertia[1] - inertia[2]) / inertia[0]) * (b * c);
    d[11] = N((inertia[2] - inertia[0]) / inertia[1]) * (c * a);
    d[12] = N((inertia[0] - inertia[1]) / inertia[2]) * (a * b);
  }
};

}  // namespace trajet::turning
