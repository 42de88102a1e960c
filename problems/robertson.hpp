#pragma once

#include <Eigen/Core>

namespace trajet::problems {

/// Robertson's three chemical reactions, over eleven powers of ten of time: ROBER of [HairerWanner1996] IV.1 (1.4) and
/// of the Bari test set [MazziaMagherini2008]. The second substance appears in 1e-6 s and then stays near equilibrium.
struct Robertson {
  static constexpr int kDimension = 3;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = -0.04 * q[0] + 1e4 * q[1] * q[2];
    dq[2] = 3e7 * q[1] * q[1];
    dq[1] = -dq[0] - dq[2];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 1e11; }
  static State start() { return {1.0, 0.0, 0.0}; }
  /// By RADAU5 in quadruple precision, [MazziaMagherini2008] II-10.
  static State reference_end() { return {0.2083340149701255e-7, 0.8333360770334713e-13, 0.9999999791665050}; }
  /// The amount of all substances.
  static Eigen::Matrix<double, 1, 1> invariants(const State& q) { return Eigen::Matrix<double, 1, 1>(q.sum()); }
};

}  // namespace trajet::problems
