#pragma once

#include <Eigen/Core>

namespace trajet::problems {

/// Arenstorf's orbit: a satellite about earth and moon in the frame that turns with them, [HairerNorsettWanner1993]
/// II.0 (0.1), (0.2). It comes close to the moon, and back to its start after a period; errors grow a thousandfold on
/// the way. State: (x, y, vx, vy).
struct Arenstorf {
  static constexpr int kDimension = 4;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    using std::sqrt;
    constexpr double kMoon = 0.012277471;
    constexpr double kEarth = 1.0 - kMoon;
    const auto from_earth = q[0] + kMoon;
    const auto from_moon = q[0] - kEarth;
    const auto y_squared = q[1] * q[1];
    const auto d_earth_squared = from_earth * from_earth + y_squared;
    const auto d_moon_squared = from_moon * from_moon + y_squared;
    const auto pull_earth = kEarth / (d_earth_squared * sqrt(d_earth_squared));
    const auto pull_moon = kMoon / (d_moon_squared * sqrt(d_moon_squared));
    dq[0] = q[2];
    dq[1] = q[3];
    dq[2] = q[0] + 2.0 * q[3] - pull_earth * from_earth - pull_moon * from_moon;
    dq[3] = q[1] - 2.0 * q[2] - (pull_earth + pull_moon) * q[1];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 17.0652165601579625588917206249; }
  static State start() { return {0.994, 0.0, 0.0, -2.00158510637908252240537862224}; }
  static State reference_end() { return start(); }
};

}  // namespace trajet::problems
