#include "trajet/event/event_watch.hpp"

#include <cmath>
#include <utility>

#include "trajet/math/number.hpp"

namespace trajet {
namespace {

/// The components of the state that a program reads, in rising order.
std::vector<int> read_components(const Program& program) {
  std::vector<bool> is_read(static_cast<std::size_t>(program.slot_count), false);
  for (const Instruction& instruction : program.instructions)
    for (const int slot : {instruction.a, instruction.b, instruction.c}) is_read[static_cast<std::size_t>(slot)] = true;
  for (const int slot : program.outputs) is_read[static_cast<std::size_t>(slot)] = true;
  std::vector<int> components;
  for (int slot = 1; slot < program.input_count; ++slot)
    if (is_read[static_cast<std::size_t>(slot)]) components.push_back(slot - 1);
  return components;
}

}  // namespace

EventWatch::EventWatch(Program when, CrossingDirection direction)
    : program_(std::make_shared<const Program>(std::move(when))),
      direction_(direction),
      inputs_(read_components(*program_)),
      state_(static_cast<std::size_t>(program_->input_count - 1)),
      values_(*program_),
      enclosures_(*program_) {}

void EventWatch::restart(double t, const double* before, const double* q) {
  double value_before = 0.0;
  double value = 0.0;
  values_(t, before, &value_before);
  values_(t, q, &value);
  const auto is_now = [t](const Crossing& crossing) {
    return crossing.found && std::abs(t - crossing.time) <= crossing.error_bound;
  };
  const bool is_pending = is_now(next_);
  if ((is_pending || is_now(last_)) && value == value_before) {
    // zero to rounding: where the motion goes from here is no second crossing
    sign_ = 0;
    at_zero_ = 2.0 * std::abs(value);
  } else {
    sign_ = static_cast<int>(sign(value));
    at_zero_ = 0.0;
  }
  if (!is_pending) next_ = {};
}

bool EventWatch::wanted(int direction) const {
  return direction_ == CrossingDirection::any || (direction_ == CrossingDirection::rising) == (direction > 0);
}

void EventWatch::search(const Segment<>& segment, double from) {
  if (next_.found) return;  // where the motion was restarted
  next_ = {};
  const Path<Eigen::Dynamic> path(segment, inputs_);
  const ComposedFunction function(path, Function{&enclosures_, &inputs_, &state_}, from - segment.t0(),
                                  segment.duration(), std::exchange(at_zero_, 0.0), true);
  if (sign_ == 0) {
    const FunctionSample begin = function.at(function.begin());
    if (std::abs(begin.jet.value) > begin.tolerance) sign_ = static_cast<int>(sign(begin.jet.value));
  }
  visit_roots(function, [&](const Root& root) {
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
}

}  // namespace trajet
