#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "trajet/math/root_search.hpp"

namespace trajet {

namespace detail {

/// Where the rate of a function, positive at `a` and negative at `b`, vanishes: Newton's steps, halves where they leave
/// the bracket.
template <EnclosedFunction F>
double turning_time(const F& f, double a, double b) {
  double t = 0.5 * a + 0.5 * b;
  for (int i = 0; i < 100; ++i) {
    const Jet jet = f.at(t).jet;
    (jet.rate > 0.0 ? a : b) = t;
    const double newton = t - jet.rate / jet.curvature;
    const bool is_inside = newton > std::min(a, b) && newton < std::max(a, b);
    const double next = is_inside ? newton : 0.5 * a + 0.5 * b;
    if (next == t || jet.rate == 0.0) break;
    t = next;
  }
  return t;
}

}  // namespace detail

/// The largest value that a function takes between f.begin() and f.end(), both included, to rounding; -infinity where
/// it has none.
///
/// Pieces whose enclosure lies below what has been found are dropped; on those that rise, fall or bend up the largest
/// value is at an end, on those that bend down where the rate vanishes. All others are halved.
template <EnclosedFunction F>
double largest_value(const F& f) {
  constexpr int kMostHalvings = 60;
  constexpr int kMostPieces = 100'000;  // of a function that is not finite, or flat to rounding over long times
  struct Stretch {
    double from, to;
    int halvings;
  };
  double best = -INFINITY;
  double rounding = 0.0;
  const auto look_at = [&](double t) {
    const FunctionSample sample = f.at(t);
    if (!(sample.jet.value > best)) return;
    best = sample.jet.value;
    rounding = sample.value_error;
  };
  look_at(f.begin());
  look_at(f.end());
  std::vector<Stretch> stretches{{f.begin(), f.end(), 0}};
  for (int pieces = 0; !stretches.empty() && pieces < kMostPieces; ++pieces) {
    const auto [from, to, halvings] = stretches.back();
    stretches.pop_back();
    const auto piece = f.piece(from, to);
    if (f.value_range(piece).upper <= best + rounding) continue;
    const Range rate = f.rate_range(piece), curvature = f.curvature_range(piece);
    if (rate.lower >= 0.0 || rate.upper <= 0.0 || curvature.lower >= 0.0) continue;
    if (curvature.upper < 0.0) {
      // bends down: the rate is positive at the earlier end, or the largest value is at an end
      const double early = std::min(from, to), late = std::max(from, to);
      if (f.at(early).jet.rate > 0.0 && f.at(late).jet.rate < 0.0) look_at(detail::turning_time(f, early, late));
      continue;
    }
    if (halvings == kMostHalvings) continue;
    const double middle = 0.5 * from + 0.5 * to;
    look_at(middle);
    stretches.push_back({from, middle, halvings + 1});
    stretches.push_back({middle, to, halvings + 1});
  }
  return best;
}

}  // namespace trajet
