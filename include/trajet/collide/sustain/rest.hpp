#pragma once

#include <algorithm>

namespace trajet {

/// Whether a body that moves away with `speed` (m/s) from an obstacle towards which it is accelerated with `pull`
/// (m/s^2) is in contact still. A flight so much higher than the gap that can be told from contact, `tolerance` (m), is
/// a flight: u^2 / (2 g) against the gap.
inline bool is_below_flight(double speed, double pull, double tolerance) {
  constexpr double kLowestFlight = 1e5;
  return speed * speed <= 2.0 * pull * kLowestFlight * tolerance;
}

/// Whether it lies there, whatever its restitution: its speed, either way, is not more than what `pull` gives over the
/// few roundings of the gap that nobody can tell from contact.
inline bool is_lying(double speed, double pull, double tolerance) {
  constexpr double kFew = 16.0;
  return speed * speed <= 2.0 * pull * kFew * tolerance;
}

/// For how long a body still bounces that leaves an obstacle with `speed`, pulled back with `pull`, before it rests: all
/// flights to come, 2 u/g (1 + e + e^2 + ...), s. Zero for one that bounces for ever, of which only the first is left.
inline double bouncing_time(double speed, double pull, double restitution) {
  return restitution < 1.0 ? 2.0 * std::max(0.0, speed) / (pull * (1.0 - restitution)) : 0.0;
}

}  // namespace trajet
