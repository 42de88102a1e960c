#pragma once

#include <Eigen/Core>
#include <cmath>

namespace trajet::problems {

/// The harmonic oscillator x'' = -x, one turn in 2 pi. State: (v, x).
struct Oscillator {
  static constexpr int kDimension = 2;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = -q[1];
    dq[1] = q[0];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 20.0; }
  static State start() { return {0.0, 1.0}; }
  static State exact(double t) { return {-std::sin(t), std::cos(t)}; }
  /// Twice the energy.
  static Eigen::Matrix<double, 1, 1> invariants(const State& q) {
    return Eigen::Matrix<double, 1, 1>(q[0] * q[0] + q[1] * q[1]);
  }
};

}  // namespace trajet::problems
