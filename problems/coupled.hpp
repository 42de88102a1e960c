#pragma once

#include <Eigen/Core>
#include <cmath>

namespace trajet::problems {

/// y1' = 2 t y1 y2, y2' = -2 t ln y1: coupled, non-linear, and with time in the law, so that every order condition
/// matters. Solution: y1 = exp(sin t^2), y2 = cos t^2.
struct Coupled {
  static constexpr int kDimension = 2;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector& q, Rate& dq) const {
    using std::log;
    dq[0] = 2.0 * t * q[0] * q[1];
    dq[1] = -2.0 * t * log(q[0]);
  }

  static double start_time() { return 0.25; }
  static double end_time() { return 2.0; }
  static State start() { return exact(start_time()); }
  static State exact(double t) { return {std::exp(std::sin(t * t)), std::cos(t * t)}; }
};

}  // namespace trajet::problems
