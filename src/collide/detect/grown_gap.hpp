#pragma once

#include <algorithm>

#include "contact_report.hpp"
#include "coordinate.hpp"
#include "trajet/math/root_search.hpp"

namespace trajet::detail {

/// The distance from the centre of a ball to a convex solid, less the ball's radius, as a function whose roots can be
/// searched. The distance has a continuous gradient where it is positive, so that the gap is smooth enough at its
/// roots: edges and corners of the grown solid are round.
///
/// `Solid` gives the coordinates of the ball's centre that its gap needs, as an array of Coordinates, and encloses
/// distance and derivatives by their enclosures; what is more than `far` above `radius` need not have derivatives.
template <class Solid>
class GrownGap {
 public:
  using Piece = IntervalJet;

  GrownGap(const Solid& solid, const MovingBall& ball, double touch_tolerance)
      : solid_(solid),
        radius_(ball.radius),
        begin_(tau_interval(ball).begin),
        end_(tau_interval(ball).end),
        touch_tolerance_(touch_tolerance),
        far_(std::max(at(begin_).tolerance, at(end_).tolerance)) {}

  double begin() const { return begin_; }
  double end() const { return end_; }

  IntervalJet piece(double from, double to) const {
    return less_radius(solid_.distance([=](const Coordinate& x) { return x.between(from, to); }, radius_ + far_));
  }
  Range value_range(const IntervalJet& piece) const { return {piece[0].lower(), piece[0].upper()}; }
  Range rate_range(const IntervalJet& piece) const { return {piece[1].lower(), piece[1].upper()}; }
  Range curvature_range(const IntervalJet& piece) const { return {piece[2].lower(), piece[2].upper()}; }

  FunctionSample at(double tau) const {
    constexpr double kNowhere = std::numeric_limits<double>::infinity();
    const IntervalJet f = less_radius(solid_.distance([=](const Coordinate& x) { return x.at(tau); }, kNowhere));
    const double error = 0.5 * width(f[0]);
    return {{median(f[0]), median(f[1]), 2.0 * median(f[2])}, error, std::max(3.0 * error, touch_tolerance_)};
  }

 private:
  IntervalJet less_radius(IntervalJet distance) const {
    distance[0] -= radius_;
    return distance;
  }

  const Solid& solid_;
  double radius_;
  double begin_;
  double end_;
  double touch_tolerance_;
  double far_;
};

/// The distance of a point from a place, sqrt(sum_i x_i^2), where the x_i and their derivatives are enclosed. With rho
/// the distance: rho' = sum x_i x_i' / rho, rho'' = (sum x_i'^2 + x_i x_i'' - rho'^2) / rho.
template <std::size_t Count>
IntervalJet distance_of(const std::array<IntervalJet, Count>& x) {
  Interval squares(0.0), product(0.0), second(0.0);
  for (const IntervalJet& each : x) {
    squares += square(each[0]);
    product += each[0] * each[1];
    second += square(each[1]) + 2.0 * each[0] * each[2];
  }
  IntervalJet rho(sqrt(squares));
  rho[1] = rho[2] = Interval::whole();
  if (!(rho[0].lower() > 0.0)) return rho;
  rho[1] = product / rho[0];
  rho[2] = 0.5 * (second - square(rho[1])) / rho[0];
  return rho;
}

/// x - h above h, x + h below -h, else 0, with the rates that hold for each: it grows with x. Its rate jumps where it
/// is 0, but not that of its square, which is what counts: x - clamp(x) times its own rate is that times x'.
inline IntervalJet overhang(const IntervalJet& x, double half) {
  const auto beyond = [half](double at) { return at > half ? at - half : at < -half ? at + half : 0.0; };
  const double lower = beyond(x[0].lower()), upper = beyond(x[0].upper());
  IntervalJet w(Interval(lower == 0.0 ? 0.0 : next_below(lower), upper == 0.0 ? 0.0 : next_above(upper)));
  const bool is_beyond = lower > 0.0 || upper < 0.0;
  const bool is_within = lower == 0.0 && upper == 0.0;
  w[1] = is_within ? Interval(0.0) : is_beyond ? x[1] : hull(x[1], 0.0);
  w[2] = is_within ? Interval(0.0) : is_beyond ? x[2] : hull(x[2], 0.0);
  return w;
}

/// A distance of which only the value is known: what is far away is not asked for more.
inline IntervalJet far_away(double lower) {
  IntervalJet rho(Interval(lower, std::numeric_limits<double>::infinity()));
  rho[1] = rho[2] = Interval::whole();
  return rho;
}

/// The smallest of |x|.
inline double least_size(const Interval& x) { return std::max({0.0, x.lower(), -x.upper()}); }

}  // namespace trajet::detail
