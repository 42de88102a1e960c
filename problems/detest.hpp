#pragma once

#include <Eigen/Core>
#include <cmath>

// Problems of the DETEST set [HullEnrightFellenSedgwick1972], each from t = 0 to 20, with the end values of the public
// Toronto test set of non-stiff problems. Its B1 is lotka_volterra.hpp, its class D two_body.hpp.

namespace trajet::problems {

/// A1: y' = -y.
struct DetestA1 {
  static constexpr int kDimension = 1;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = -q[0];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 20.0; }
  static State start() { return State(1.0); }
  static State exact(double t) { return State(std::exp(-t)); }
  static State reference_end() { return State(2.061153353012535e-9); }
};

/// A2: y' = -y^3/2, a special case of the Riccati equation. Solution: (1 + t)^(-1/2).
struct DetestA2 {
  static constexpr int kDimension = 1;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = -0.5 * q[0] * q[0] * q[0];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 20.0; }
  static State start() { return State(1.0); }
  static State exact(double t) { return State(1.0 / std::sqrt(1.0 + t)); }
  static State reference_end() { return State(2.182178902359887e-1); }
};

/// A3: y' = y cos t, an oscillation. Solution: exp(sin t).
struct DetestA3 {
  static constexpr int kDimension = 1;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector& q, Rate& dq) const {
    using std::cos;
    dq[0] = q[0] * cos(t);
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 20.0; }
  static State start() { return State(1.0); }
  static State exact(double t) { return State(std::exp(std::sin(t))); }
  static State reference_end() { return State(2.491650271850414); }
};

/// B2: a linear chemical reaction. The sum of the three is kept.
struct DetestB2 {
  static constexpr int kDimension = 3;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = -q[0] + q[1];
    dq[1] = q[0] - 2.0 * q[1] + q[2];
    dq[2] = q[1] - q[2];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 20.0; }
  static State start() { return {2.0, 0.0, 1.0}; }
  static State reference_end() { return {1.000000001030576, 1.0, 9.999999989694235e-1}; }
};

/// B5: Euler's equations of a rigid body without torque.
struct DetestB5 {
  static constexpr int kDimension = 3;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    dq[0] = q[1] * q[2];
    dq[1] = -q[0] * q[2];
    dq[2] = -0.51 * q[0] * q[1];
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 20.0; }
  static State start() { return {0.0, 1.0, 1.0}; }
  static State reference_end() { return {-9.396570798729192e-1, -3.421177754000779e-1, 7.414126596199957e-1}; }
};

/// E1: Bessel's equation of order 1/2, the origin shifted to t = -1.
struct DetestE1 {
  static constexpr int kDimension = 2;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector& q, Rate& dq) const {
    const auto x = t + 1.0;
    dq[0] = q[1];
    dq[1] = -(q[1] / x + (1.0 - 0.25 / (x * x)) * q[0]);
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 20.0; }
  static State start() { return {0.6713967071418030, 0.09540051444747446}; }
  static State reference_end() { return {1.456723600728308e-1, -9.883500195574063e-2}; }
};

/// E3: Duffing's equation, driven.
struct DetestE3 {
  static constexpr int kDimension = 2;
  using State = Eigen::Matrix<double, kDimension, 1>;

  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector& q, Rate& dq) const {
    using std::sin;
    dq[0] = q[1];
    dq[1] = q[0] * q[0] * q[0] / 6.0 - q[0] + 2.0 * sin(2.78535 * t);
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 20.0; }
  static State start() { return {0.0, 0.0}; }
  static State reference_end() { return {-1.004178858647128e-1, 2.411400132095954e-1}; }
};

}  // namespace trajet::problems
