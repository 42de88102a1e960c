#pragma once

#include <Eigen/Core>
#include <cmath>

namespace trajet::problems {

/// P4: the orbit of eccentricity 0.6 about a unit mass, from its nearest point, ten periods. State: (vx, vy, x, y),
/// semi-major axis and gravitational parameter 1.
struct Kepler {
  static constexpr int kDimension = 4;
  using State = Eigen::Matrix<double, kDimension, 1>;
  static constexpr double kEccentricity = 0.6;
  static constexpr double kPeriod = 6.283185307179586;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    using std::sqrt;
    const auto r_squared = q[2] * q[2] + q[3] * q[3];
    const auto r_cubed = r_squared * sqrt(r_squared);
    dq[0] = -q[2] / r_cubed;
    dq[1] = -q[3] / r_cubed;
    dq[2] = q[0];
    dq[3] = q[1];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 10.0 * kPeriod; }
  static State start() { return exact(0.0); }

  /// By Kepler's equation t = E - e sin E.
  static State exact(double t) {
    const double mean = std::remainder(t, kPeriod);
    double anomaly = mean;
    // Newton's iteration; for e = 0.6 it settles within eight from anywhere.
    for (int i = 0; i < 12; ++i)
      anomaly -= (anomaly - kEccentricity * std::sin(anomaly) - mean) / (1.0 - kEccentricity * std::cos(anomaly));
    const double b = std::sqrt(1.0 - kEccentricity * kEccentricity);
    const double rate = 1.0 / (1.0 - kEccentricity * std::cos(anomaly));
    return {-std::sin(anomaly) * rate, b * std::cos(anomaly) * rate, std::cos(anomaly) - kEccentricity,
            b * std::sin(anomaly)};
  }

  /// From the doubles of start(), whose rounding moves the end by 2e-13, to that of end_time(): Kepler's equation in 45
  /// digits.
  static State reference_end() {
    return {1.788019208334965628000023e-13, 2.0, 0.4000000000000000222044605, -5.721661466671890644832104e-14};
  }

  /// Energy and angular momentum per mass.
  static Eigen::Vector2d invariants(const State& q) {
    const double kinetic = 0.5 * (q[0] * q[0] + q[1] * q[1]);
    return {kinetic - 1.0 / std::hypot(q[2], q[3]), q[2] * q[1] - q[3] * q[0]};
  }
};

}  // namespace trajet::problems
