#include "accumulation.hpp"

#include <cmath>

namespace trajet {

void Accumulation::happen(double t) {
  const double interval = t - last_;
  const double ratio = interval / interval_;
  const double last_extrapolated = extrapolated_;
  last_ = t;
  interval_ = std::isnan(interval) ? interval_ : interval;
  if (interval == 0.0) return;  // over
  if (!(ratio > 0.0 && ratio < 1.0)) {
    shrinking_ = 0;
    extrapolated_ = std::numeric_limits<double>::quiet_NaN();
    least_move_ = std::numeric_limits<double>::infinity();
    return;
  }
  ++shrinking_;
  remaining_ = interval * ratio / (1.0 - ratio);
  extrapolated_ = t + remaining_;
  const double move = std::abs(extrapolated_ - last_extrapolated);
  if (!(move >= least_move_)) limit_ = extrapolated_;
  if (move < least_move_) least_move_ = move;
}

std::optional<double> Accumulation::extrapolated_limit() const {
  if (shrinking_ == 0) return std::nullopt;
  return limit_;
}

std::optional<double> Accumulation::limit(double resolution) const {
  // fewer are near each other by chance
  constexpr int kEnough = 8;
  if (shrinking_ < kEnough || !(std::abs(remaining_) <= resolution)) return std::nullopt;
  return limit_;
}

}  // namespace trajet
