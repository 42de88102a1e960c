#pragma once

#include <chrono>
#include <optional>

namespace trajet {

/// How long a run may take, by the clock on the wall.
class TimeLimit {
 public:
  /// The time begins now; without `seconds` there is no limit, and no clock is read.
  explicit TimeLimit(std::optional<double> seconds) {
    if (seconds) end_ = Clock::now() + Seconds(*seconds);
  }

  bool is_over() const { return end_ && Clock::now() > *end_; }

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  std::optional<std::chrono::time_point<Clock, Seconds>> end_;
};

}  // namespace trajet
