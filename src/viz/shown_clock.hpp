#pragma once

#include <cmath>
#include <string>

#include "trajet/text/shortest_text.hpp"

namespace trajet::detail {

/// Figures have the times of the scene's clock, unless its start is so far away that their digits would not tell them
/// apart: then those since the start.
struct ShownClock {
  double epoch;     ///< s, of the scene's clock at the start
  double duration;  ///< s, of the run

  bool is_far() const {
    constexpr double kFar = 1e3;
    return std::abs(epoch) > kFar * std::abs(duration);
  }
  /// What a figure shows of a time since the start, s.
  double time(double elapsed) const { return is_far() ? elapsed : epoch + elapsed; }
  std::string label() const { return is_far() ? "time since " + shortest_text(epoch) + " s [s]" : "time [s]"; }
};

}  // namespace trajet::detail
