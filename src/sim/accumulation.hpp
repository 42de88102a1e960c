#pragma once

#include <limits>
#include <optional>

namespace trajet {

/// Events that come faster and faster, such as the bounces that a `set` makes: whether infinitely many of them happen
/// before some time, and when that is.
///
/// Their intervals shrink like a geometric series; the limit is that of Aitken's extrapolation. Where the intervals are
/// long the series is not yet geometric, where they are short the rounding of time is in them: the limit is the one
/// that has moved least from one event to the next.
class Accumulation {
 public:
  /// The event happens at time t, s.
  void happen(double t);
  /// How long ago the event had happened before, s.
  double interval() const { return interval_; }
  /// The time at which the events accumulate if their intervals go on shrinking as they do, s; none if they do not
  /// shrink.
  std::optional<double> extrapolated_limit() const;
  /// The same once all that are to come happen within `resolution` (s).
  std::optional<double> limit(double resolution) const;

 private:
  double last_ = std::numeric_limits<double>::quiet_NaN();      // s, of the last event
  double interval_ = std::numeric_limits<double>::infinity();   // s, signed as time runs
  double remaining_ = std::numeric_limits<double>::infinity();  // s, from the last event to the extrapolated limit
  double extrapolated_ = std::numeric_limits<double>::quiet_NaN();
  double limit_ = std::numeric_limits<double>::quiet_NaN();
  double least_move_ = std::numeric_limits<double>::infinity();
  int shrinking_ = 0;  // intervals in succession, each shorter than the one before
};

}  // namespace trajet
