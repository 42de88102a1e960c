#pragma once

#include <Eigen/Core>

namespace trajet::problems {

/// Uniform acceleration a = (0, 0, 1) from v = (2, 1, 0), r = (0, 0, 1). State: (v, r), m/s and m.
struct ConstantAcceleration {
  static constexpr int kDimension = 6;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = 0.0;
    dq[1] = 0.0;
    dq[2] = 1.0;
    for (int i = 0; i < 3; ++i) dq[3 + i] = q[i];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 10.0; }
  static State start() { return exact(0.0); }
  static State exact(double t) { return (State() << 2, 1, t, 2 * t, t, 1 + t * t / 2).finished(); }
};

/// The same under a = (0, 0, t).
struct LinearAcceleration {
  static constexpr int kDimension = 6;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector& q, Rate& dq) const {
    dq[0] = 0.0;
    dq[1] = 0.0;
    dq[2] = t;
    for (int i = 0; i < 3; ++i) dq[3 + i] = q[i];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 10.0; }
  static State start() { return exact(0.0); }
  static State exact(double t) { return (State() << 2, 1, t * t / 2, 2 * t, t, 1 + t * t * t / 6).finished(); }
};

}  // namespace trajet::problems
