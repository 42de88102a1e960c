#pragma once

#include <Eigen/Core>

namespace trajet::problems {

/// Van der Pol's oscillator with mu = 1000, a relaxation oscillation: slow for 800 s, then a jump within a thousandth
/// of a second; VDPOL of the Bari test set [MazziaMagherini2008], [HairerWanner1996] IV.1 (1.5).
struct VanDerPol {
  static constexpr int kDimension = 2;
  using State = Eigen::Matrix<double, kDimension, 1>;
  static constexpr double kMu = 1000.0;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = q[1];
    dq[1] = kMu * (1.0 - q[0] * q[0]) * q[1] - q[0];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 2000.0; }
  static State start() { return {2.0, 0.0}; }
  /// By RADAU5 in quadruple precision, [MazziaMagherini2008] II-9.
  static State reference_end() { return {0.1706167732170469e1, -0.8928097010248125e-3}; }
};

}  // namespace trajet::problems
