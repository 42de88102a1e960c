#pragma once

#include <algorithm>
#include <span>

#include "trajet/math/interval.hpp"

namespace trajet::detail {

/// Encloses a function that is one of several, each with its derivatives, without saying which.
class JetHull {
 public:
  void add(const IntervalJet& f) {
    hull_ = is_empty_ ? f : IntervalJet::from([&](int k) { return boost::numeric::hull(hull_[k], f[k]); });
    is_empty_ = false;
  }
  bool is_empty() const { return is_empty_; }
  const IntervalJet& hull() const { return hull_; }

 private:
  IntervalJet hull_{};
  bool is_empty_ = true;
};

/// Of several functions the greatest: where more than one may be, it has corners.
inline IntervalJet greatest(std::span<const IntervalJet> all) {
  double lower = all[0][0].lower(), upper = all[0][0].upper();
  for (const IntervalJet& f : all) {
    lower = std::max(lower, f[0].lower());
    upper = std::max(upper, f[0].upper());
  }
  JetHull hull;
  bool is_one = true;
  for (const IntervalJet& f : all) {
    if (f[0].upper() < lower) continue;
    is_one = hull.is_empty();
    hull.add(f);
  }
  IntervalJet result = hull.hull();
  result[0] = Interval(lower, upper);
  if (!is_one) result[2] = Interval::whole();
  return result;
}

}  // namespace trajet::detail
