#pragma once

#include <Eigen/Core>
#include <cmath>

namespace trajet::problems {

/// Prey and predator: problem B1 of the DETEST set [HullEnrightFellenSedgwick1972].
struct LotkaVolterra {
  static constexpr int kDimension = 2;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = 2.0 * (q[0] - q[0] * q[1]);
    dq[1] = q[0] * q[1] - q[1];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 20.0; }
  static State start() { return {1.0, 3.0}; }
  /// From the public Toronto test set of non-stiff problems.
  static State reference_end() { return {6.761876008576667e-1, 1.860816099640036e-1}; }
  /// q1 - ln q1 + 2 (q2 - ln q2)
  static Eigen::Matrix<double, 1, 1> invariants(const State& q) {
    return Eigen::Matrix<double, 1, 1>(q[0] - std::log(q[0]) + 2.0 * (q[1] - std::log(q[1])));
  }
};

}  // namespace trajet::problems
