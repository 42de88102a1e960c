#pragma once

#include <Eigen/Core>

namespace trajet::problems {

/// High irradiance response: eight reactions of plant physiology, HIRES of [HairerWanner1996] IV.10 and of the Bari
/// test set [MazziaMagherini2008].
struct Hires {
  static constexpr int kDimension = 8;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = -1.71 * q[0] + 0.43 * q[1] + 8.32 * q[2] + 0.0007;
    dq[1] = 1.71 * q[0] - 8.75 * q[1];
    dq[2] = -10.03 * q[2] + 0.43 * q[3] + 0.035 * q[4];
    dq[3] = 8.32 * q[1] + 1.71 * q[2] - 1.12 * q[3];
    dq[4] = -1.745 * q[4] + 0.43 * q[5] + 0.43 * q[6];
    dq[5] = -280.0 * q[5] * q[7] + 0.69 * q[3] + 1.71 * q[4] - 0.43 * q[5] + 0.69 * q[6];
    dq[6] = 280.0 * q[5] * q[7] - 1.81 * q[6];
    dq[7] = -dq[6];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 321.8122; }
  static State start() { return (State() << 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0057).finished(); }
  /// By RADAU5 in quadruple precision, [MazziaMagherini2008] II-1.
  static State reference_end() {
    return (State() << 0.7371312573325668e-3, 0.1442485726316185e-3, 0.5888729740967575e-4, 0.1175651343283149e-2,
            0.2386356198831331e-2, 0.6238968252742796e-2, 0.2849998395185769e-2, 0.2850001604814231e-2)
        .finished();
  }
};

}  // namespace trajet::problems
