#pragma once

#include <Eigen/Core>
#include <numbers>

namespace trajet::problems {

/// Euler's equations of a free top: I1 w1' = (I2 - I3) w2 w3 and cyclic, principal axes of the body. State: the angular
/// velocity in the body's frame, rad/s. `Top` gives the `moments()`; their unit cancels.
template <class Top>
struct EulerTop {
  static constexpr int kDimension = 3;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    const State moment = Top::moments();
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      dq[i] = ((moment[j] - moment[k]) / moment[i]) * q[j] * q[k];
    }
  }

  /// Twice the energy and the square of the angular momentum.
  static Eigen::Vector2d invariants(const State& q) {
    const State momentum = Top::moments().cwiseProduct(q);
    return {momentum.dot(q), momentum.squaredNorm()};
  }

  static double start_time() { return 0.0; }
};

/// TestProblem8 of Hipparchus (an open-source Java library): elliptic functions of modulus k^2 = 0.9375, which come
/// back after their period.
struct HipparchusTop : EulerTop<HipparchusTop> {
  static State moments() { return {3.0 / 8.0, 1.0 / 2.0, 5.0 / 8.0}; }
  static double end_time() { return 6.861525571809244; }
  static State start() { return {5.0, 0.0, 4.0}; }
  static State reference_end() { return start(); }
};

/// The tumbling brick, check case 2 of NASA TM-2015-218675 (six-degree-of-freedom simulations): slug ft^2, deg/s in the
/// report.
struct TumblingBrick : EulerTop<TumblingBrick> {
  static State moments() { return {0.001894220, 0.006211019, 0.007194665}; }
  static double end_time() { return 30.0; }
  static State start() { return State(10.0, 20.0, 30.0) * kRadiansPerDegree; }
  static State reference_end() { return State(12.6183907757, -17.3974747619, 31.1195888868) * kRadiansPerDegree; }

 private:
  static constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
};

}  // namespace trajet::problems
