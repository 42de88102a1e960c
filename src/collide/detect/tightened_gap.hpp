#pragma once

#include <algorithm>

#include "contact_report.hpp"
#include "coordinate.hpp"
#include "step_end_search.hpp"
#include "trajet/math/root_search.hpp"

namespace trajet::detail {

/// The gap of a ball and a curved surface as a function whose roots can be searched. `Surface::gap(enclose)` encloses
/// it with its derivatives, by enclosures of the coordinates of the ball's centre; the mean value form tightens what
/// comes out wherever the gap may be zero.
template <class Surface>
class TightenedGap {
 public:
  using Piece = IntervalJet;

  TightenedGap(const Surface& surface, const MovingBall& ball, double touch_tolerance)
      : surface_(surface),
        begin_(tau_interval(ball).begin),
        end_(tau_interval(ball).end),
        touch_tolerance_(touch_tolerance) {}

  double begin() const { return begin_; }
  double end() const { return end_; }

  IntervalJet piece(double from, double to) const {
    IntervalJet f = surface_.gap([=](const Coordinate& x) { return x.between(from, to); });
    if (f[0].lower() > 0.0 || f[0].upper() < 0.0) return f;
    const double middle = 0.5 * from + 0.5 * to;
    const IntervalJet center = at_time(middle);
    const Interval offset = Interval::hull(from, to) - Interval(middle);
    // f(t) is in f(m) + f'([from, to]) (t - m), and f' likewise with f'' = 2 f[2]
    f[1] = tightened(f[1], center[1] + 2.0 * f[2] * offset);
    f[0] = tightened(f[0], center[0] + f[1] * offset);
    return f;
  }
  Range value_range(const IntervalJet& piece) const { return {piece[0].lower(), piece[0].upper()}; }
  Range rate_range(const IntervalJet& piece) const { return {piece[1].lower(), piece[1].upper()}; }
  Range curvature_range(const IntervalJet& piece) const { return {piece[2].lower(), piece[2].upper()}; }

  FunctionSample at(double tau) const {
    const IntervalJet f = at_time(tau);
    const double error = 0.5 * width(f[0]);
    return {{median(f[0]), median(f[1]), 2.0 * median(f[2])}, error, std::max(3.0 * error, touch_tolerance_)};
  }

 private:
  IntervalJet at_time(double tau) const {
    return surface_.gap([=](const Coordinate& x) { return x.at(tau); });
  }

  /// Both enclose the same numbers. Not-a-number bounds, where a derivative is not finite, make an empty interval.
  static Interval tightened(const Interval& a, const Interval& b) { return empty(b) ? a : intersect(a, b); }

  const Surface& surface_;
  double begin_;
  double end_;
  double touch_tolerance_;
};

/// The first contact by the gap that `surface` encloses. `place(position)` gives the SurfacePoint for the ball's centre
/// there; `depth` as of `report`.
template <class Surface, class Place, class Depth = Deep>
ContactResult contact_with_surface(const Surface& surface, const MovingBall& ball, const ContactMemory& memory,
                                   Place&& place, Depth&& depth = {}) {
  const TightenedGap gap(surface, ball, handled_tolerance(memory, ball));
  constexpr bool kIsSolid = true;
  const auto contact = search_gap(gap, ball, kIsSolid, memory, is_handled(memory, ball), [](double) { return true; });
  return report(gap, contact, ball, kIsSolid, place, depth);
}

}  // namespace trajet::detail
