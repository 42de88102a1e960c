#include "event_handler.hpp"

#include <cmath>

#include "event_hold.hpp"
#include "jump_derivative.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {
namespace {

/// So many events of one course at one instant are sets that call each other, not a motion.
constexpr int kMaxEventsAtOnce = 1000;
/// Roundings of time within which an event that its own set has turned back happens at once.
constexpr double kSameTime = 8.0;
/// Roundings of time within which all is over of events that come faster and faster.
constexpr double kNearLimit = 256.0;

}  // namespace

EventHandler::EventHandler(const RunControl& control)
    : run_(control), last_events_(control.world().groups.size()), accumulations_(control.world().events.size()) {}

void EventHandler::handle(int index, double time) {
  Course& moving = run_.course(index);
  const Crossing crossing = moving.next();
  const World::Event& event = run_.world().events[static_cast<std::size_t>(crossing.index)];
  const EventWatch::Crossing found = moving.watches().event_crossing(crossing.index);
  if (found.undecided) return run_.fail(time, "whether event '" + event.name + "' happens cannot be decided");
  if (last_events_[static_cast<std::size_t>(index)].count_at(time) > kMaxEventsAtOnce)
    return run_.fail(time, "event '" + event.name + "' happens again and again at one instant");
  run_.recorder().event(time, event.name, found.direction);
  switch (event.action) {
    case EventAction::stop:
      run_.stop_after(time, found.error_bound);
      [[fallthrough]];
    case EventAction::record:
      moving.pass_event(crossing.index);
      return run_.pass_on(index);
    case EventAction::set:
      break;
  }
  if (const std::optional<double> limit = limit_of(index, crossing.index, time)) {
    if (hold(index, crossing.index, time, *limit)) return;
    return run_.fail(time,
                     name_of(crossing.index) + " happens faster and faster, infinitely often before t = " +
                         shortest_text(run_.world().epoch + *limit) +
                         " s: what its set turns back or stops, the law drives across zero again; the motion behind "
                         "that time is not followed");
  }
  set(index, crossing.index, time);
}

std::string EventHandler::name_of(int event) const {
  return "event '" + run_.world().events[static_cast<std::size_t>(event)].name + "'";
}

bool EventHandler::hold(int index, int event, double time, double limit) {
  Course& moving = run_.course(index);
  const int direction = moving.watches().event_crossing(event).direction;
  Instant instant(moving, time);
  if (!hold_at_limit(run_.world(), event, direction, instant)) return false;
  run_.recorder().event(run_.world().direction() * (limit - time) > 0.0 ? limit : time, "sticks", direction,
                        name_of(event));
  moving.take_event(event);
  run_.go_on(index, instant);
  run_.advance(index);
  return true;
}

void EventHandler::handle_hold_end(int index) {
  Course& moving = run_.course(index);
  Instant instant(moving, moving.next().time);
  instant.holds.erase(instant.holds.begin() + moving.next().index);
  run_.go_on(index, instant);
  run_.advance(index);
}

std::optional<double> EventHandler::limit_of(int index, int event, double time) {
  Accumulation& times = accumulations_[static_cast<std::size_t>(event)];
  times.happen(time);
  const double rounding = kUnitRoundoff * std::abs(time);
  const bool is_stopped =
      run_.course(index).watches().has_turned(event) && std::abs(times.interval()) <= kSameTime * rounding;
  const std::optional<double> limit = is_stopped ? times.extrapolated_limit() : times.limit(kNearLimit * rounding);
  return limit || !is_stopped ? limit : std::optional(time);
}

void EventHandler::set(int index, int event_index, double time) {
  Course& moving = run_.course(index);
  const World::Event& event = run_.world().events[static_cast<std::size_t>(event_index)];
  Instant instant(moving, time);
  Eigen::VectorXd values(static_cast<Eigen::Index>(event.targets.size()));
  Evaluator<double> evaluate(event.set);
  evaluate(time, instant.before().data(), values.data());
  for (std::size_t i = 0; i < event.targets.size(); ++i)
    instant.q[event.targets[i]] = values[static_cast<Eigen::Index>(i)];
  const Eigen::VectorXd rate = moving.rate(time, instant.before());
  instant.derivative = derivative_of_set(event, instant, rate);
  moving.take_event(event_index);
  if (const std::string failure = run_.lasting_contacts().release_after_set(instant); !failure.empty())
    return run_.fail(time, "behind event '" + event.name + "' a body in contact: " + failure);
  run_.go_on(index, instant);
  moving.turn_event(event_index, instant, rate);
  for (const int body : moving.group().bodies) {
    const int offset = run_.world().bodies[static_cast<std::size_t>(body)].offset;
    const Vector3 from = instant.before().segment<3>(offset), to = instant.q.segment<3>(offset);
    if (to == from) continue;
    run_.encounters().move(body, time, from, to);
    run_.meetings().forget(body);
  }
  run_.advance(index);
}

}  // namespace trajet
