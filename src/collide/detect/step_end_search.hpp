#pragma once

#include <algorithm>
#include <cmath>

#include "contact_search.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/math/polynomial.hpp"

namespace trajet::detail {

/// The first contact by a gap function as the course finds it: only the gaps at the two ends of a step are compared, so
/// that a gap that opens again within the step is missed; then the time is located by the course's 3.1 or 3.2.
///
/// A crossing counts at the step that ends on the surface or beyond it. `is_solid` and `accept` as in ContactSearch;
/// here `accept` judges the place at the located time.
template <EnclosedFunction F, class Accept>
class StepEndSearch {
 public:
  StepEndSearch(const F& gap, Locator locator, bool is_solid, const ContactMemory& memory, bool is_handled,
                Accept accept)
      : gap_(gap),
        locator_(locator),
        is_solid_(is_solid),
        side_(memory.side),
        is_handled_(is_handled),
        accept_(accept),
        begin_(gap.at(gap.begin())),
        end_(gap.at(gap.end())) {}

  GapContact run() {
    if (!std::isfinite(begin_.jet.value) || !std::isfinite(end_.jet.value))
      return {.status = ContactStatus::unresolved, .tau = gap_.begin(), .side_before = side_};
    const int begin_sign = sign(begin_);
    const int end_sign = sign(end_);
    if (side_ == 0) {
      // A first position within the rounding of the motion to come is not inside yet.
      if (is_solid_ && begin_.jet.value < -std::max(begin_.tolerance, end_.tolerance))
        return {
            .status = ContactStatus::overlapping_at_start, .tau = gap_.begin(), .side_before = -1, .side_after = -1};
      side_ = is_solid_ ? 1 : begin_sign != 0 ? begin_sign : end_sign;
    }
    // The located time leaves a body short of the surface or beyond it: on its way to its side it is still in contact.
    if (is_handled_ && begin_sign == -side_ && !goes_deeper())
      return {.side_before = side_, .side_after = side_, .stays_in_contact = end_sign != side_};

    // z_{i-1} > z_s >= z_i; a body that starts on the surface must end beyond it
    const bool crosses = begin_sign == side_ ? end_sign != side_ : end_sign == -side_;
    if (!crosses) return {.side_before = side_, .side_after = side_};
    const double tau = begin_sign == side_ ? locate() : gap_.begin();
    if (!accept_(tau)) return {.side_before = -side_, .side_after = -side_};
    return {ContactStatus::hit, tau, location_error(tau), side_, -side_, false, false};
  }

 private:
  /// 3.2's J.
  static constexpr int kParts = 10;
  /// 3.2's epsilon, m. Far above rounding, far below what can be seen.
  static constexpr double kNear = 1e-9;

  static int sign(const FunctionSample& sample) {
    if (std::abs(sample.jet.value) <= sample.tolerance) return 0;
    return sample.jet.value > 0.0 ? 1 : -1;
  }

  bool goes_deeper() const { return sign(end_) == -side_ && std::abs(end_.jet.value) >= std::abs(begin_.jet.value); }

  double locate() const { return locator_ == Locator::interpolation ? interpolate() : subdivide(); }

  /// 3.1: t_f = t_{i-1} + (z_s - z_{i-1}) / v, v = (v_{i-1} + v_i) / 2
  double interpolate() const {
    const double mean_rate = 0.5 * (begin_.jet.rate + end_.jet.rate);
    const double tau = gap_.begin() - begin_.jet.value / mean_rate;
    const bool is_within = std::min(gap_.begin(), gap_.end()) <= tau && tau <= std::max(gap_.begin(), gap_.end());
    // Where the rates tell nothing of the crossing, it is known to be over at the end of the step.
    return is_within ? tau : gap_.end();
  }

  /// 3.2: the part of the step in which the gap changes its sign, again and again, until an end of it is near.
  double subdivide() const {
    double left = gap_.begin();
    double right = gap_.end();
    if (!is_handled_ && is_near(left)) return left;
    while (!is_near(right)) {
      const double part = (right - left) / kParts;
      double before = left;
      double after = left + part;
      for (int j = 2; !is_crossed(after) && j <= kParts; ++j) {
        before = after;
        after = j == kParts ? right : left + j * part;
      }
      if (before == after || (before == left && after == right)) return right;  // no time is left between the two
      if (before != left && is_near(before)) return before;
      left = before;
      right = after;
    }
    return right;
  }

  bool is_near(double tau) const { return std::abs(gap_.at(tau).jet.value) < kNear; }
  bool is_crossed(double tau) const { return gap_.at(tau).jet.value * side_ <= 0.0; }

  /// How far the time may be off by the gap that is left: dt = dx / |gap rate|, at most the step.
  double location_error(double tau) const {
    const Jet jet = gap_.at(tau).jet;
    const double error = std::abs(jet.value / jet.rate);
    const double step = std::abs(gap_.end() - gap_.begin());
    return error < step ? error : step;
  }

  const F& gap_;
  Locator locator_;
  bool is_solid_;
  int side_;
  bool is_handled_;
  Accept accept_;
  FunctionSample begin_;
  FunctionSample end_;
};

/// The first contact by a gap function, found the way that the ball asks for.
template <EnclosedFunction F, class Accept>
GapContact search_gap(const F& gap, const MovingBall& ball, bool is_solid, const ContactMemory& memory, bool is_handled,
                      Accept accept) {
  if (ball.locator == Locator::polynomial) return ContactSearch(gap, is_solid, memory, is_handled, accept).run();
  return StepEndSearch(gap, ball.locator, is_solid, memory, is_handled, accept).run();
}

}  // namespace trajet::detail
