#pragma once

#include <Eigen/Core>
#include <cmath>

namespace trajet::problems {

/// The orbit about a unit mass from its nearest point, semi-major axis 1: class D of the DETEST set
/// [HullEnrightFellenSedgwick1972]. State: (x, y, vx, vy), the order in which its end values are published.
template <int EccentricityInTenths>
struct TwoBody {
  static constexpr int kDimension = 4;
  using State = Eigen::Matrix<double, kDimension, 1>;
  static constexpr double kEccentricity = EccentricityInTenths / 10.0;

  template <class Time, class Vector, class Rate>
  void operator()(const Time&, const Vector& q, Rate& dq) const {
    using std::sqrt;
    const auto r_squared = q[0] * q[0] + q[1] * q[1];
    const auto r_cubed = r_squared * sqrt(r_squared);
    dq[0] = q[2];
    dq[1] = q[3];
    dq[2] = -q[0] / r_cubed;
    dq[3] = -q[1] / r_cubed;
  }

  static double start_time() { return 0.0; }
  static double end_time() { return 20.0; }
  static State start() {
    return {1.0 - kEccentricity, 0.0, 0.0, std::sqrt((1.0 + kEccentricity) / (1.0 - kEccentricity))};
  }
};

/// D1, eccentricity 0.1, with its end from the public Toronto test set of non-stiff problems.
struct DetestD1 : TwoBody<1> {
  static State reference_end() {
    return {2.198835352008397e-1, 9.427076846341813e-1, -9.787659841058176e-1, 3.287977990962036e-1};
  }
};

/// D3, eccentricity 0.5, likewise.
struct DetestD3 : TwoBody<5> {
  static State reference_end() {
    return {-5.780432953035361e-1, 8.633840009194193e-1, -9.595083730380727e-1, -6.504915126712089e-2};
  }
};

}  // namespace trajet::problems
