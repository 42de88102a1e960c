#include "trajet/event/event_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trajet/math/number.hpp"

namespace trajet {
namespace {

/// A rate so much smaller than it was, or than those it is made of, is what rounding leaves of one that was stopped.
constexpr double kStopped = 1e-12;

/// The sign of all of the numbers; 0 where they have several or are not known.
int definite_sign(const Interval& values) { return values.lower() > 0.0 ? 1 : values.upper() < 0.0 ? -1 : 0; }

}  // namespace

EventWatch::EventWatch(Program when, CrossingDirection direction)
    : program_(std::make_shared<const Program>(std::move(when))),
      direction_(direction),
      inputs_(read_components(*program_)),
      state_(static_cast<std::size_t>(program_->input_count - 1)),
      values_(*program_),
      enclosures_(*program_) {}

Interval EventWatch::enclose(double t, const double* q, const double* rounding) {
  const double t_rounding = 2.0 * kUnitRoundoff * std::abs(t);
  for (const int i : inputs_)
    state_[static_cast<std::size_t>(i)] = IntervalJet(Interval(q[i] - rounding[i], q[i] + rounding[i]));
  IntervalJet result;
  enclosures_(IntervalJet(Interval(t - t_rounding, t + t_rounding)), state_.data(), &result);
  return result[0];
}

void EventWatch::restart(double t, const double* before, const double* q, const double* rounding) {
  double value_before = 0.0;
  double value = 0.0;
  values_(t, before, &value_before);
  values_(t, q, &value);
  const auto is_now = [t](const Crossing& crossing) {
    return crossing.found && std::abs(t - crossing.time) <= crossing.error_bound;
  };
  const bool is_pending = is_now(next_);
  const bool is_own = std::exchange(is_taken_, false);
  has_landed_ = false;
  has_turned_ = has_to_leave_ = false;
  if (value == value_before) {
    sign_ = static_cast<int>(sign(value));
    at_zero_ = 0.0;
    if (!is_pending) next_ = {};
    // zero to rounding: where the motion goes from here is no second crossing
    if ((is_pending && !next_.is_jump) || (is_now(last_) && !last_.is_jump)) {
      sign_ = 0;
      at_zero_ = 2.0 * std::abs(value);
    }
    return;
  }
  const Interval values = enclose(t, q, rounding);
  const int after = definite_sign(values);
  const int side = is_pending ? -next_.direction : is_own ? 0 : definite_sign(enclose(t, before, rounding));
  at_zero_ = after == 0 ? norm(values) : 0.0;
  sign_ = after;
  if (after != 0) last_ = {};
  if (is_pending && (after != side || side == 0)) {
    next_.is_jump = after != 0;
    return;
  }
  next_ = {};
  if (side == 0 || is_pending) return;
  if (after == 0) {
    sign_ = side;
    has_landed_ = true;
  } else if (after != side && wanted(after)) {
    next_ = {true, t, 2.0 * kUnitRoundoff * std::abs(t), after, false, true};
  }
}

double EventWatch::rate_at(double t, const double* q, const double* rate) {
  for (const int i : inputs_) {
    IntervalJet& component = state_[static_cast<std::size_t>(i)];
    component = IntervalJet(Interval(q[i]));
    component[1] = Interval(rate[i]);
  }
  IntervalJet result;
  enclosures_(IntervalJet::variable(Interval(t)), state_.data(), &result);
  return median(result[1]);
}

void EventWatch::turn(double t, const double* before, const double* rate_before, const double* q, const double* rate) {
  const double came = rate_at(t, before, rate_before);
  const double goes = rate_at(t, q, rate);
  has_turned_ = sign_ == 0 && last_.found && came != 0.0 && goes / came <= kStopped;
  has_to_leave_ = has_turned_;
  if (has_turned_) sign_ = -last_.direction;
}

void EventWatch::stand_on(double t, const double* q, int side) {
  double value = 0.0;
  values_(t, q, &value);
  next_ = last_ = {};
  sign_ = side;
  at_zero_ = 2.0 * std::abs(value);
}

void EventWatch::forget_unless_rising(double t, const double* q, const double* rate_before, const double* rate) {
  if (!next_.found) return;
  double largest = 0.0;
  for (const int i : inputs_) largest = std::max({largest, std::abs(rate[i]), std::abs(rate_before[i])});
  if (rate_at(t, q, rate) > kStopped * largest) return;
  next_ = {};
  sign_ = -1;
}

bool EventWatch::wanted(int direction) const {
  return direction_ == CrossingDirection::any || (direction_ == CrossingDirection::rising) == (direction > 0);
}

void EventWatch::search(const Segment<>& segment, double from, double until) {
  if (next_.found) return;  // where the motion was restarted
  next_ = {};
  const Path<Eigen::Dynamic> path(segment, inputs_);
  const double end = until == segment.t1() ? segment.duration() : until - segment.t0();
  const ComposedFunction function(path, ProgramFunction{&enclosures_, &inputs_, &state_}, from - segment.t0(), end,
                                  std::exchange(at_zero_, 0.0), true);
  const FunctionSample begin = function.at(function.begin());
  if (std::exchange(has_to_leave_, false) && last_.direction * begin.jet.curvature > 0.0 &&
      begin.jet.rate * begin.jet.rate <= 2.0 * std::abs(begin.jet.curvature) * begin.tolerance) {
    // what was turned back does not come as far as can be told from zero
    next_ = {true, from, 2.0 * kUnitRoundoff * std::abs(from), last_.direction, false};
    return;
  }
  if (sign_ == 0) {
    if (std::abs(begin.jet.value) > begin.tolerance) sign_ = static_cast<int>(sign(begin.jet.value));
  }
  const bool has_landed = std::exchange(has_landed_, false);
  const SearchStatus status = visit_roots(function, [&](const Root& root) {
    if (root.kind == RootKind::unresolved) {
      next_ = {true, segment.t0() + root.time, 0.0, 0, true};
      return false;
    }
    if (root.kind == RootKind::undefined) {
      sign_ = 0;
      return true;
    }
    // what was seen last decides: a root that was counted lies ahead again where `from` is rounded
    const int before = sign_ != 0 || root.at_begin ? sign_ : root.sign_before;
    const int after = root.sign_after;
    if (after == 0) return false;  // at the end of the Segment: the next one tells
    sign_ = after;
    const bool is_touch = root.kind == RootKind::touch && !root.at_begin;  // there the last Segment knows better
    if (is_touch || before == 0 || before == after || !wanted(after)) return true;
    const double time = segment.t0() + root.time;
    next_ = {true, time, root.error_bound + 2.0 * kUnitRoundoff * std::abs(time), after, false};
    return false;
  });
  if (status != SearchStatus::identically_zero || !has_landed) return;
  // it jumped onto zero and stays there
  const int direction = -std::exchange(sign_, 0);
  if (wanted(direction)) next_ = {true, from, 2.0 * kUnitRoundoff * std::abs(from), direction, false};
}

}  // namespace trajet
