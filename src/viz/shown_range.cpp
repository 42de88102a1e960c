#include "shown_range.hpp"

#include <algorithm>

namespace trajet::detail {

namespace {

constexpr double kNear = 2.0;

bool is_near(const Range& motion, const Range& reference, double least_extent) {
  if (motion.is_empty() || reference.is_empty()) return true;
  const double room = kNear * std::max(reference.extent(), least_extent);
  return motion.low >= reference.low - room && motion.high <= reference.high + room;
}

}  // namespace

Ranges shown_ranges(const Ranges& reference, const std::vector<Ranges>& motions, double least_extent) {
  Ranges shown = reference;
  for (const Ranges& motion : motions) {
    bool stays = true;
    for (std::size_t axis = 0; axis < reference.size(); ++axis)
      stays = stays && is_near(motion[axis], reference[axis], least_extent);
    for (std::size_t axis = 0; axis < reference.size(); ++axis) {
      if (motion[axis].is_empty() || !(stays || reference[axis].is_empty())) continue;
      shown[axis].include(motion[axis].low);
      shown[axis].include(motion[axis].high);
    }
  }
  return shown;
}

bool leaves(const Ranges& motion, const Ranges& shown) {
  for (std::size_t axis = 0; axis < shown.size(); ++axis) {
    const Range room = shown[axis].padded();
    if (!motion[axis].is_empty() && (motion[axis].low < room.low || motion[axis].high > room.high)) return true;
  }
  return false;
}

}  // namespace trajet::detail
