#pragma once

#include <Eigen/Core>
#include <cmath>

namespace trajet::problems {

/// An acceleration of time alone, a = -sin t - e^-t, from v = 2, x = -1. State: (v, x).
struct Driven {
  static constexpr int kDimension = 2;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector& q, Rate& dq) const {
    using std::exp, std::sin;
    dq[0] = -sin(t) - exp(-t);
    dq[1] = q[0];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 10.0; }
  static State start() { return exact(0.0); }
  static State exact(double t) { return {std::cos(t) + std::exp(-t), std::sin(t) - std::exp(-t)}; }
};

}  // namespace trajet::problems
