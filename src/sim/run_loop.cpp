#include "run_loop.hpp"

#include <cmath>

#include "impact_record.hpp"
#include "jump_derivative.hpp"
#include "ties.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/scene/describe_failure.hpp"
#include "trajet/scene/law_name.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {
namespace {

/// So many events of one course at one instant are sets that call each other, not a motion.
constexpr int kMaxEventsAtOnce = 1000;
/// Roundings of time within which an event that its own set has turned back happens at once.
constexpr double kSameTime = 8.0;
/// Roundings of time within which all is over of events that come faster and faster.
constexpr double kNearLimit = 256.0;

std::string status_text(StepStatus status) {
  return status == StepStatus::not_finite ? "the law is not finite"
                                          : "the tolerance cannot be met: the step became too small";
}

Recorder::Courses make_courses(const World& world) {
  Recorder::Courses courses;
  for (std::size_t g = 0; g < world.groups.size(); ++g)
    courses.push_back(std::make_unique<Course>(world, static_cast<int>(g)));
  return courses;
}

}  // namespace

RunLoop::RunLoop(const World& world, RunObserver& observer)
    : world_(world),
      direction_(world.direction()),
      courses_(make_courses(world)),
      encounters_(world),
      recorder_(world, courses_, observer),
      lasting_contacts_(world, courses_, encounters_, recorder_),
      last_impacts_(world.bodies.size()),
      last_bounces_(world.bodies.size()),
      last_events_(world.groups.size()),
      accumulations_(world.events.size()) {}

RunLoop::Incident RunLoop::next(int index) const {
  const Course& course = *courses_[static_cast<std::size_t>(index)];
  const Crossing& crossing = course.next();
  Incident first{crossing.time, nullptr};
  const bool is_end = crossing.kind == Crossing::Kind::segment_end;
  const bool is_event = crossing.kind == Crossing::Kind::event;
  const bool is_edge = crossing.kind == Crossing::Kind::past_edge;
  for (const int body : course.group().bodies) {
    const Pair* pair = encounters_.first(body);
    if (pair == nullptr) continue;
    const double ahead = direction_ * (first.time - pair->contact.time);
    if (is_event && first.contact == nullptr && std::abs(ahead) <= crossing.error_bound) {
      // at one instant, events come first: an impact that ends the run must not hide them
      if (ahead > 0.0) first.time = pair->contact.time;
      continue;
    }
    // where two faces meet, what slides into the edge has come to the other face before it is past its own
    constexpr double kFew = 4.0;
    const bool is_corner =
        is_edge && first.contact == nullptr && ahead >= -kFew * (crossing.error_bound + pair->contact.time_resolution);
    const bool is_first = ahead > 0.0 || (ahead == 0.0 && is_end && first.contact == nullptr);
    if (is_corner || is_first) first = {pair->contact.time, pair};
  }
  return first;
}

double RunLoop::next_time() const {
  if (!has_started_) return world_.epoch;
  return world_.epoch + (running_ && !agenda_.empty() ? next(agenda_.next()).time : recorder_.end_time());
}

void RunLoop::start() {
  has_started_ = true;
  double time = 0.0;
  if (!recorder_.sample_until(time)) return interrupt(time);
  if (world_.duration == 0.0) return;
  for (std::size_t i = 0; i < courses_.size() && running_; ++i) advance(static_cast<int>(i));
}

bool RunLoop::step() {
  if (!has_started_) {
    start();
  } else if (running_ && !agenda_.empty()) {
    const int index = agenda_.next();
    agenda_.pop();
    const Incident incident = next(index);
    double time = incident.time;
    if (stop_ && (direction_ * (time - stop_->time) > stop_->error_bound || is_segment_end(index, incident))) {
      if (agenda_.empty()) stop();
      return running_;
    }
    if (!recorder_.sample_until(time) || recorder_.is_interrupted(time)) {
      interrupt(time);
      return false;
    }
    recorder_.set_end_time(time);
    lasting_contacts_.record_until(time);
    if (incident.contact != nullptr) {
      handle_contact(index, *incident.contact);
    } else {
      switch (course(index).next().kind) {
        case Crossing::Kind::segment_end:
          if (!course(index).finished()) advance(index);
          break;
        case Crossing::Kind::event:
          handle_event(index, time);
          break;
        case Crossing::Kind::pull:
        case Crossing::Kind::past_edge:
          handle_contact_end(index);
          break;
        case Crossing::Kind::let_go:
          handle_hold_end(index);
          break;
      }
    }
  }
  if (running_ && agenda_.empty() && stop_) stop();
  if (running_ && agenda_.empty()) {
    fail_if_blown_up();
    running_ = false;
  }
  return running_;
}

void RunLoop::fail_if_blown_up() {
  const double t = recorder_.end_time();
  for (std::size_t g = 0; g < courses_.size(); ++g) {
    const Eigen::VectorXd q = courses_[g]->state(t);
    // a state that doubles in so small a part of the run may be on its way to infinity
    constexpr double kNoTime = 1e-6;
    const double elapsed = std::abs(t);
    if (!(q.cwiseAbs().array() < kNoTime * elapsed * courses_[g]->rate(t, q).cwiseAbs().array()).any()) continue;
    const std::string reason = describe_blow_up(world_, static_cast<int>(g), t, q);
    if (!reason.empty()) return fail(t, reason);
  }
}

RunResult RunLoop::result() {
  RunResult result = recorder_.result();
  result.statistics.contact_searches = encounters_.searches();
  return result;
}

void RunLoop::enqueue(int index) { agenda_.add(direction_ * next(index).time, index); }

void RunLoop::advance(int index) {
  Course& moving = course(index);
  if (!moving.is_within_step() && ++step_count_ > world_.max_steps) {
    const double t = recorder_.end_time();
    const std::string jump = describe_jump(world_, index, t, moving.state(t));
    return fail(
        t, "more than max_steps = " + std::to_string(world_.max_steps) + " steps" + (jump.empty() ? "" : ": ") + jump);
  }
  recorder_.motion(moving, moving.segment().t1());
  for (const int body : moving.group().bodies) encounters_.keep(body, moving, moving.segment().t1());
  if (const StepStatus status = moving.advance(); status != StepStatus::ok) {
    return fail(recorder_.end_time(), describe_failed_step(index, status));
  }
  record_slides(index);
  double until = moving.next().time;
  for (const int body : moving.group().bodies) {
    encounters_.follow(body, moving, until);
    if (const Pair* pair = encounters_.first(body)) until = std::min(until, pair->contact.time);
  }
  enqueue(index);
}

void RunLoop::record_slides(int index) {
  for (const BranchedStepper::Slide& slide : course(index).take_slides()) {
    const World::LawFormula* formula = find_formula(world_, index, slide.component);
    recorder_.event(slide.time, slide.begins ? "sticks" : "slips", slide.direction,
                    formula != nullptr ? name_of(world_, index, *formula) : "");
  }
}

std::string RunLoop::describe_failed_step(int index, StepStatus status) {
  const Course& moving = course(index);
  const double t = recorder_.end_time();
  if (const int component = moving.undecided_component(); component >= 0) {
    const World::LawFormula* formula = find_formula(world_, index, component);
    return "the law switches to and fro, and which of its branches holds cannot be decided" +
           (formula != nullptr ? ": " + name_with_place(world_, index, *formula) : "");
  }
  return status_text(status) + ": " + describe_failure(world_, index, t, moving.state(t));
}

void RunLoop::go_on(int index, const Instant& instant) {
  Course& moving = course(index);
  recorder_.motion(moving, instant.time());
  for (const int body : moving.group().bodies) encounters_.keep(body, moving, instant.time());
  const std::vector<EventHold> held_before = moving.holds();
  moving.restart(instant);
  for (const EventHold& hold : held_before) {
    if (ranges::any_of(moving.holds(), [&](const EventHold& each) { return each.event == hold.event; })) continue;
    recorder_.event(instant.time(), "slips", hold.side, name_of_event(hold.event));
  }
  encounters_.take(instant);
}

bool RunLoop::is_segment_end(int index, const Incident& incident) const {
  return incident.contact == nullptr &&
         courses_[static_cast<std::size_t>(index)]->next().kind == Crossing::Kind::segment_end;
}

void RunLoop::handle_event(int index, double time) {
  Course& moving = course(index);
  const Crossing crossing = moving.next();
  const World::Event& event = world_.events[static_cast<std::size_t>(crossing.index)];
  const EventWatch::Crossing found = moving.event_crossing(crossing.index);
  if (found.undecided) return fail(time, "whether event '" + event.name + "' happens cannot be decided");
  if (last_events_[static_cast<std::size_t>(index)].count_at(time) > kMaxEventsAtOnce)
    return fail(time, "event '" + event.name + "' happens again and again at one instant");
  recorder_.event(time, event.name, found.direction);
  switch (event.action) {
    case EventAction::stop:
      // when all that happens at this instant is done
      if (!stop_) stop_ = {time, found.error_bound};
      [[fallthrough]];
    case EventAction::record:
      moving.pass_event(crossing.index);
      for (const int body : moving.group().bodies) encounters_.search(body, moving, moving.next().time);
      enqueue(index);
      return;
    case EventAction::set:
      break;
  }
  if (const std::optional<double> limit = limit_of(index, crossing.index, time)) {
    if (hold(index, crossing.index, time, *limit)) return;
    return fail(time, name_of_event(crossing.index) + " happens faster and faster, infinitely often before t = " +
                          shortest_text(world_.epoch + *limit) +
                          " s: what its set turns back or stops, the law drives across zero again; the motion behind "
                          "that time is not followed");
  }
  set(index, crossing.index, time);
}

std::string RunLoop::name_of_event(int event) const {
  return "event '" + world_.events[static_cast<std::size_t>(event)].name + "'";
}

bool RunLoop::hold(int index, int event, double time, double limit) {
  Course& moving = course(index);
  const int direction = moving.event_crossing(event).direction;
  Instant instant(moving, time);
  if (!hold_at_limit(world_, event, direction, instant)) return false;
  recorder_.event(direction_ * (limit - time) > 0.0 ? limit : time, "sticks", direction, name_of_event(event));
  moving.take_event(event);
  go_on(index, instant);
  advance(index);
  return true;
}

void RunLoop::handle_hold_end(int index) {
  Course& moving = course(index);
  Instant instant(moving, moving.next().time);
  instant.holds.erase(instant.holds.begin() + moving.next().index);
  go_on(index, instant);
  advance(index);
}

std::optional<double> RunLoop::limit_of(int index, int event, double time) {
  Accumulation& times = accumulations_[static_cast<std::size_t>(event)];
  times.happen(time);
  const double rounding = kUnitRoundoff * std::abs(time);
  const bool is_stopped = course(index).has_turned(event) && std::abs(times.interval()) <= kSameTime * rounding;
  const std::optional<double> limit = is_stopped ? times.extrapolated_limit() : times.limit(kNearLimit * rounding);
  return limit || !is_stopped ? limit : std::optional(time);
}

void RunLoop::set(int index, int event_index, double time) {
  Course& moving = course(index);
  const World::Event& event = world_.events[static_cast<std::size_t>(event_index)];
  Instant instant(moving, time);
  Eigen::VectorXd values(static_cast<Eigen::Index>(event.targets.size()));
  Evaluator<double> evaluate(event.set);
  evaluate(time, instant.before().data(), values.data());
  for (std::size_t i = 0; i < event.targets.size(); ++i)
    instant.q[event.targets[i]] = values[static_cast<Eigen::Index>(i)];
  const Eigen::VectorXd rate = moving.rate(time, instant.before());
  instant.derivative = derivative_of_set(event, instant, rate);
  moving.take_event(event_index);
  lasting_contacts_.release_after_set(instant);
  go_on(index, instant);
  moving.turn_event(event_index, instant, rate);
  for (const int body : moving.group().bodies) {
    const int offset = world_.bodies[static_cast<std::size_t>(body)].offset;
    const Vector3 from = instant.before().segment<3>(offset), to = instant.q.segment<3>(offset);
    if (to != from) encounters_.move(body, time, from, to);
  }
  advance(index);
}

double RunLoop::end_of_pull(const Course& moving, const Crossing& crossing) const {
  const double known = crossing.time + direction_ * 2.0 * crossing.error_bound;
  bool is_next = direction_ * (moving.segment().t1() - known) > 0.0;
  for (const int body : moving.group().bodies) {
    const Pair* pair = encounters_.first(body);
    is_next = is_next && (pair == nullptr || direction_ * (pair->contact.time - known) > 0.0);
  }
  return is_next ? known : crossing.time;
}

void RunLoop::handle_contact_end(int index) {
  Course& moving = course(index);
  const Crossing crossing = moving.next();
  const double time = crossing.kind == Crossing::Kind::pull ? end_of_pull(moving, crossing) : crossing.time;
  Instant instant(moving, time);
  const int body = instant.contacts[static_cast<std::size_t>(crossing.index)].body;
  recorder_.sample(time, body, SamplePhase::before);
  recorder_.sample(time, body, SamplePhase::after);
  lasting_contacts_.leave(instant, crossing.index, crossing.kind == Crossing::Kind::past_edge,
                          crossing.error_bound + std::abs(time - crossing.time));
  go_on(index, instant);
  advance(index);
}

void RunLoop::stop() {
  if (stop_) recorder_.sample(recorder_.end_time());
  recorder_.end(RunStatus::stopped);
  running_ = false;
  agenda_ = {};
}

void RunLoop::fail(double time, const std::string& reason) {
  recorder_.set_end_time(time);
  recorder_.end(RunStatus::failed, reason);
  running_ = false;
  agenda_ = {};
}

void RunLoop::run_out_of_memory() {
  recorder_.hand_on_no_more();
  fail(recorder_.reached_time(), "memory has run out; what was computed until then is kept");
}

void RunLoop::interrupt(double time) {
  if (recorder_.is_out_of_time())
    return fail(time, "more than max_seconds = " + shortest_text(*world_.max_seconds) + " s of elapsed time");
  recorder_.set_end_time(time);
  recorder_.end(RunStatus::interrupted);
  running_ = false;
  agenda_ = {};
}

}  // namespace trajet
