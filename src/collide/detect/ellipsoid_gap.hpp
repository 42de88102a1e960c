#pragma once

#include <array>
#include <cmath>

#include "coordinate.hpp"
#include "trajet/geom/ellipsoid_distance.hpp"

namespace trajet::detail {

/// The signed distance of a point on a path from an ellipsoid, with its derivatives by time.
///
/// It grows with each |q_i|, as lambda does: their ranges are those of two corners. With n the normal d' = n . q' and
/// d'' = n . q'' + n' . q', by the derivatives of the secular equation.
class EllipsoidDistance {
 public:
  EllipsoidDistance(const EllipsoidBody& ellipsoid, const PointPath& path)
      : radii_(ellipsoid.radii),
        coordinates_{Coordinate(path, ellipsoid.R_WB.col(0), ellipsoid.center),
                     Coordinate(path, ellipsoid.R_WB.col(1), ellipsoid.center),
                     Coordinate(path, ellipsoid.R_WB.col(2), ellipsoid.center)} {}

  template <class Enclose>
  IntervalJet signed_distance(const Enclose& enclose) const {
    std::array<IntervalJet, 3> q;
    Vector3 near, far;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      q[k] = enclose(coordinates_[k]);
      const Interval size = abs(q[k][0]);
      near[i] = size.lower();
      far[i] = size.upper();
    }
    const EllipsoidFoot<double> low = ellipsoid_foot<double>(radii_, near), high = ellipsoid_foot<double>(radii_, far);
    const double largest = radii_.maxCoeff(), least2 = radii_.minCoeff() * radii_.minCoeff();
    // n . q and |A n| are sums of three products each
    constexpr double kRoundings = 8.0;
    const double rounding = kRoundings * kUnitRoundoff * (far.lpNorm<1>() + largest);
    IntervalJet d(Interval(low.distance - rounding, high.distance + rounding));

    // what the sum of three squares, of a few roundings each, makes of the root
    constexpr double kRootRoundings = 32.0;
    const auto widened = [&](double lambda, double side) {
      return lambda + side * kRootRoundings * kUnitRoundoff * (std::abs(lambda) + largest * largest);
    };
    const Interval lambda(widened(low.lambda, -1.0), widened(high.lambda, 1.0));
    if (lambda.lower() > -least2) {
      add_derivatives(q, lambda, d);
    } else {
      const double speed = sqrt(square(q[0][1]) + square(q[1][1]) + square(q[2][1])).upper();
      d[1] = Interval(-speed, speed);
      d[2] = Interval::whole();
    }
    return d;
  }

 private:
  void add_derivatives(const std::array<IntervalJet, 3>& q, const Interval& lambda, IntervalJet& d) const {
    std::array<Interval, 3> s, u, n;
    Interval u2(0.0), weighted_rate(0.0), weight(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
      const double a = radii_[static_cast<Eigen::Index>(i)];
      s[i] = lambda + a * a;
      // (a u)^2 is a part of the sum that is one
      const double most = next_above(1.0 / a);
      u[i] = intersect(q[i][0] / s[i], Interval(-most, most));
      const Interval w = a * a / s[i];
      u2 += square(u[i]);
      weighted_rate += w * u[i] * q[i][1];
      weight += w * square(u[i]);
    }
    // 1 / a_max <= |u| <= 1 / a_min
    const Interval norm =
        intersect(sqrt(u2), Interval(next_below(1.0 / radii_.maxCoeff()), next_above(1.0 / radii_.minCoeff())));
    // sum w u^2 >= min_i 1/s_i, for sum a^2 u^2 = 1
    double least_weight = std::numeric_limits<double>::infinity();
    for (const Interval& each : s) least_weight = std::min(least_weight, next_below(1.0 / each.upper()));
    weight = Interval(std::max(weight.lower(), least_weight), std::max(weight.upper(), least_weight));
    const Interval lambda_rate = weighted_rate / weight;

    Interval rate(0.0), bend(0.0);
    std::array<Interval, 3> du;
    for (std::size_t i = 0; i < 3; ++i) {
      n[i] = intersect(u[i] / norm, Interval(-1.0, 1.0));
      du[i] = (q[i][1] - u[i] * lambda_rate) / s[i];
      rate += n[i] * q[i][1];
    }
    const Interval stretch = n[0] * du[0] + n[1] * du[1] + n[2] * du[2];
    for (std::size_t i = 0; i < 3; ++i) bend += (du[i] - n[i] * stretch) / norm * q[i][1];
    // the distance from a convex solid is convex
    bend = Interval(std::max(0.0, bend.lower()), std::max(0.0, bend.upper()));
    d[1] = rate;
    d[2] = 0.5 * bend;
    for (std::size_t i = 0; i < 3; ++i) d[2] += n[i] * q[i][2];
  }

  Vector3 radii_;
  std::array<Coordinate, 3> coordinates_;
};

}  // namespace trajet::detail
