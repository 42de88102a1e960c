#include "run_loop.hpp"

#include <cmath>

#include "trajet/scene/describe_failure.hpp"
#include "trajet/scene/law_name.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {
namespace {

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
      solids_(world),
      encounters_(world, solids_),
      meetings_(world, courses_, solids_),
      recorder_(world, courses_, observer),
      lasting_contacts_(world, courses_, encounters_, recorder_),
      agenda_(courses_.size()),
      control_(*this),
      events_(control_),
      contacts_(control_),
      groups_(control_, contacts_),
      meeting_handler_(control_) {}

RunLoop::Incident RunLoop::next(int index) const {
  const Course& course = *courses_[static_cast<std::size_t>(index)];
  const Crossing& crossing = course.next();
  Incident first{crossing.time};
  const bool is_end = crossing.kind == Crossing::Kind::segment_end;
  const bool is_event = crossing.kind == Crossing::Kind::event;
  const bool is_edge = crossing.kind == Crossing::Kind::past_edge;
  const auto is_own = [&] { return first.contact == nullptr && first.meeting == nullptr; };
  // at one instant, events come first: an impact that ends the run must not hide them
  const auto waits_for_event = [&](double time) {
    if (!is_event || !is_own() || std::abs(first.time - time) > crossing.error_bound) return false;
    if (direction_ * (first.time - time) > 0.0) first.time = time;
    return true;
  };
  for (const int body : course.group().bodies) {
    const Meeting* meeting = meetings_.first(body);
    if (meeting != nullptr && !waits_for_event(meeting->contact.time)) {
      const double ahead = direction_ * (first.time - meeting->contact.time);
      if (ahead > 0.0 || (ahead == 0.0 && is_end && is_own())) first = {meeting->contact.time, nullptr, meeting};
    }
    const Pair* pair = encounters_.first(body);
    if (pair == nullptr || waits_for_event(pair->contact.time)) continue;
    const double ahead = direction_ * (first.time - pair->contact.time);
    // where two faces meet, what slides into the edge has come to the other face before it is past its own
    constexpr double kFew = 4.0;
    const bool is_corner =
        is_edge && is_own() && ahead >= -kFew * (crossing.error_bound + pair->contact.time_resolution);
    const bool is_first = ahead > 0.0 || (ahead == 0.0 && is_end && is_own());
    if (is_corner || is_first) first = {pair->contact.time, pair};
  }
  for (const int body : course.group().bodies)
    if (const auto end = meetings_.looked_to(body); end && direction_ * (first.time - *end) > 0.0)
      first = {*end, nullptr, nullptr, true};
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
    handle(index, incident);
  }
  if (running_ && agenda_.empty() && stop_) stop();
  if (running_ && agenda_.empty()) {
    fail_if_blown_up();
    running_ = false;
  }
  return running_;
}

void RunLoop::handle(int index, const Incident& incident) {
  if (incident.contact != nullptr) return contacts_.handle(index, *incident.contact);
  if (incident.meeting != nullptr) return meeting_handler_.handle(index, *incident.meeting);
  Course& moving = course(index);
  if (incident.is_look) {
    for (const int body : moving.group().bodies) meetings_.look_on(body, incident.time, moving.next().time);
    return enqueue(index);
  }
  switch (moving.next().kind) {
    case Crossing::Kind::segment_end:
      if (!moving.finished()) advance(index);
      break;
    case Crossing::Kind::event:
      events_.handle(index, incident.time);
      break;
    case Crossing::Kind::pull:
    case Crossing::Kind::past_edge:
    case Crossing::Kind::mode:
      contacts_.handle_end(index);
      break;
    case Crossing::Kind::let_go:
      events_.handle_hold_end(index);
      break;
  }
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
  result.statistics.contact_searches = encounters_.searches() + meetings_.searches();
  return result;
}

void RunLoop::enqueue(int index) {
  agenda_.set(direction_ * next(index).time, index);
  for (const int other : meetings_.take_changed())
    if (other != index) agenda_.set(direction_ * next(other).time, other);
}

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
  for (const int body : moving.group().bodies) meetings_.follow(body, until);
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
  for (const int body : moving.group().bodies) {
    encounters_.keep(body, moving, instant.time());
    meetings_.leave(body, instant.time());
  }
  const std::vector<EventHold> held_before = moving.held_law().holds();
  moving.restart(instant);
  for (const EventHold& hold : held_before) {
    if (ranges::any_of(moving.held_law().holds(), [&](const EventHold& each) { return each.event == hold.event; }))
      continue;
    recorder_.event(instant.time(), "slips", hold.side, events_.name_of(hold.event));
  }
  encounters_.take(instant);
}

bool RunLoop::is_segment_end(int index, const Incident& incident) const {
  return incident.contact == nullptr && incident.meeting == nullptr && !incident.is_look &&
         courses_[static_cast<std::size_t>(index)]->next().kind == Crossing::Kind::segment_end;
}

void RunLoop::stop() {
  if (stop_) recorder_.sample(recorder_.end_time());
  recorder_.end(RunStatus::stopped);
  running_ = false;
  agenda_.clear();
}

void RunLoop::fail(double time, const std::string& reason) {
  recorder_.set_end_time(time);
  recorder_.end(RunStatus::failed, reason);
  running_ = false;
  agenda_.clear();
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
  agenda_.clear();
}

}  // namespace trajet
