#include "simulation.hpp"

#include <algorithm>
#include <cmath>

#include "body_state.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/scene/describe_failure.hpp"

namespace trajet {
namespace {

/// So many impacts of one body at one instant are a body that cannot get away, not a motion.
constexpr int kMaxImpactsAtOnce = 1000;

/// A step may hold any number of samples: so often in between the observer is asked whether to go on.
constexpr long kSamplesBetweenQuestions = 4096;

std::string status_text(StepStatus status) {
  return status == StepStatus::not_finite ? "the law is not finite"
                                          : "the tolerance cannot be met: the step became too small";
}

}  // namespace

Simulation::Simulation(const World& world, RunObserver& observer)
    : world_(world),
      observer_(observer),
      direction_(world.end < world.start ? -1.0 : 1.0),
      last_impacts_(world.bodies.size()) {
  observer_.begin(world_);
  for (std::size_t g = 0; g < world.groups.size(); ++g)
    motions_.push_back(std::make_unique<Motion>(world, static_cast<int>(g), observer));
  result_.scene = world.scene;
  result_.title = world.title;
  result_.method = world.method->name;
  result_.start_time = result_.end_time = world.start;
  result_.parameters = world.parameters;
  result_.warnings = world.warnings;
}

RunResult Simulation::run() {
  sample_until(world_.start);
  if (world_.end != world_.start)
    for (std::size_t i = 0; i < motions_.size() && running_; ++i) advance(static_cast<int>(i));
  while (running_ && !queue_.empty()) {
    const int index = queue_.top().motion;
    queue_.pop();
    const Incident incident = motion(index).next();
    sample_until(incident.time);
    if (!running_) break;
    result_.end_time = incident.time;
    if (observer_.interrupted(incident.time)) {
      interrupt(incident.time);
      break;
    }
    record_rests_until(incident.time);
    handle(index, incident);
  }
  if (running_) fail_if_blown_up();
  for (const auto& each : motions_) each->hand_on(result_.end_time);
  if (result_.status != RunStatus::stopped && last_sample_ != result_.end_time) write_sample(result_.end_time);
  result_.final = sample_at(result_.end_time);
  for (const auto& each : motions_) {
    const StepStatistics statistics = each->statistics();
    result_.statistics.steps += statistics.steps;
    result_.statistics.rejected_steps += statistics.rejected_steps;
    result_.statistics.law_evaluations += statistics.law_evaluations;
    if (statistics.proposed_step > 0.0)  // of several motions, the smallest
      result_.statistics.proposed_step = result_.statistics.proposed_step > 0.0
                                             ? std::min(result_.statistics.proposed_step, statistics.proposed_step)
                                             : statistics.proposed_step;
    for (const std::string& warning : each->warnings())
      if (std::ranges::find(result_.warnings, warning) == result_.warnings.end()) result_.warnings.push_back(warning);
  }
  return std::move(result_);
}

void Simulation::enqueue(int index) { queue_.push({direction_ * (motion(index).next().time - world_.start), index}); }

/// The next Segment of a motion, behind all that was handled.
void Simulation::advance(int index) {
  if (++step_count_ > world_.max_steps) {
    fail(result_.end_time, "more than max_steps = " + std::to_string(world_.max_steps) + " steps");
    return;
  }
  const StepStatus status = motion(index).advance();
  if (status != StepStatus::ok) {
    const double t = result_.end_time;
    const std::string reason = describe_failure(world_, index, t, motion(index).state(t));
    fail(t, status_text(status) + (reason.empty() ? "" : ": ") + reason);
    return;
  }
  enqueue(index);
}

void Simulation::handle(int index, const Incident& incident) {
  switch (incident.kind) {
    case Incident::Kind::segment_end:
      if (!motion(index).finished()) advance(index);
      return;
    case Incident::Kind::event:
      return handle_event(index, incident);
    case Incident::Kind::contact:
      return handle_contact(index, incident);
    case Incident::Kind::leave:
    case Incident::Kind::past_edge:
      return handle_leave(index, incident);
  }
}

void Simulation::handle_event(int index, const Incident& incident) {
  Motion& moving = motion(index);
  const World::Event& event = world_.events[static_cast<std::size_t>(incident.index)];
  const EventWatch::Crossing crossing = moving.crossing(incident.index);
  if (crossing.undecided) {
    fail(incident.time, "whether event '" + event.name + "' happens cannot be decided");
    return;
  }
  result_.events.push_back({incident.time, event.name, crossing.direction});
  switch (event.action) {
    case EventAction::record:
      moving.pass_event(incident.index);
      enqueue(index);
      return;
    case EventAction::stop:
      result_.status = RunStatus::stopped;
      running_ = false;
      write_sample(incident.time);
      return;
    case EventAction::set: {
      Eigen::VectorXd q = moving.state(incident.time);
      Eigen::VectorXd values(static_cast<Eigen::Index>(event.targets.size()));
      Evaluator<double>(event.set)(incident.time, q.data(), values.data());
      const Eigen::VectorXd before = q;
      for (std::size_t i = 0; i < event.targets.size(); ++i) q[event.targets[i]] = values[static_cast<Eigen::Index>(i)];
      moving.take_event(incident.index);
      const std::vector<Released> released = release_after_set(moving, incident.time, before, q);
      moving.restart(incident.time, q);
      for (const Released& each : released) moving.rebound(each.pair, each.memory);
      for (const int body : moving.group().bodies) {
        const int offset = world_.bodies[static_cast<std::size_t>(body)].offset;
        if (q.segment<3>(offset) != before.segment<3>(offset)) moving.forget_contacts(body);
      }
      advance(index);
      return;
    }
  }
}

double Simulation::mass(const World::Body& body, double t, const Eigen::VectorXd& q) const {
  double value = 1.0;
  if (body.mass) Evaluator<double> (*body.mass)(t, q.data(), &value);
  return value;
}

Impact Simulation::describe(const Motion& moving, const Incident& incident, const Eigen::VectorXd& q) const {
  const Motion::Pair& pair = moving.pair(incident.index);
  const World::Body& body = body_of(pair);
  Impact impact;
  impact.time = incident.time;
  impact.body = body.name;
  impact.with = obstacle_of(pair).name;
  impact.kind = pair.contact.status == ContactStatus::graze ? ImpactKind::graze : ImpactKind::hit;
  impact.point = pair.contact.point;
  impact.normal = pair.contact.normal;
  impact.position = q.segment<3>(body.offset);
  impact.velocity_before = impact.velocity_after = q.segment<3>(body.offset + 3);
  impact.angular_velocity_before = impact.angular_velocity_after = angular_velocity(body, q);
  impact.impulse = Vector3::Zero();
  impact.time_error_bound = pair.contact.time_error_bound;
  return impact;
}

void Simulation::record(const Impact& impact) {
  if (!result_.impacts.empty()) {
    const Impact& last = result_.impacts.back();
    const double apart = std::abs(impact.time - last.time);
    const bool is_tie = impact.with != last.with && apart <= impact.time_error_bound + last.time_error_bound;
    if (is_tie && impact.kind == ImpactKind::hit && last.kind == ImpactKind::hit)
      warn_of_tie(last, impact.body, impact.with);
  }
  result_.impacts.push_back(impact);
}

void Simulation::handle_contact(int index, const Incident& incident) {
  Motion& moving = motion(index);
  if (const int first = bounce_at_once(moving, incident.index); first != incident.index)
    return handle_contact(index, {incident.time, incident.kind, first});
  const Motion::Pair& pair = moving.pair(incident.index);
  const World::Body& body = body_of(pair);
  const World::Obstacle& obstacle = obstacle_of(pair);
  if (!body.is_ball) {
    fail(incident.time, "contact unresolved: " + std::string(body.shape) + " '" + body.name + "' comes within " +
                            "the reach of its farthest point from obstacle '" + obstacle.name +
                            "'; impacts of solids other than points and spheres are not supported yet");
    return;
  }
  if (pair.contact.status == ContactStatus::overlapping_at_start) {
    const std::string text = "body '" + body.name + "' starts inside obstacle '" + obstacle.name + "'";
    if (incident.time == world_.start) throw InputError(body.where, text);
    fail(incident.time, "body '" + body.name + "' is inside obstacle '" + obstacle.name + "'");
    return;
  }
  if (pair.contact.status == ContactStatus::unresolved) {
    fail(incident.time, "contact of '" + body.name + "' with '" + obstacle.name + "' is unresolved");
    return;
  }
  Impacts& impacts = last_impacts_[static_cast<std::size_t>(pair.body)];
  impacts = {incident.time, impacts.time == incident.time ? impacts.count + 1 : 1};
  if (impacts.count > kMaxImpactsAtOnce) {
    fail(incident.time, "body '" + body.name + "' has impact after impact with '" + obstacle.name + "' at one instant");
    return;
  }
  const Impact impact = describe(moving, incident, moving.state(incident.time));
  const bool is_hit = pair.contact.status == ContactStatus::hit && pair.contact.direction != ContactDirection::leaving;
  if (is_hit && obstacle.on_hit == OnHit::stop) {
    write_sample(incident.time);
    write_sample(incident.time);
    record(impact);
    warn_of_hidden_ties(moving, pair, impact);
    result_.status = RunStatus::stopped;
    running_ = false;
  } else if (is_hit && obstacle.on_hit == OnHit::bounce) {
    if (goes_on_from_contact(index, incident, impact)) return enqueue(index);
    bounce(index, incident, impact);
  } else {
    write_sample(incident.time);
    write_sample(incident.time);
    record(impact);
    moving.pass_contact(incident.index);
    enqueue(index);
  }
}

void Simulation::fail(double time, const std::string& reason) {
  result_.status = RunStatus::failed;
  result_.end_time = time;
  result_.failure = reason;
  running_ = false;
}

void Simulation::fail_if_blown_up() {
  for (std::size_t g = 0; g < motions_.size() && running_; ++g) {
    const double t = result_.end_time;
    const std::string reason = describe_blow_up(world_, static_cast<int>(g), t, motions_[g]->state(t));
    if (!reason.empty()) fail(t, reason);
  }
}

void Simulation::interrupt(double time) {
  result_.status = RunStatus::interrupted;
  result_.end_time = time;
  running_ = false;
}

void Simulation::sample_until(double time) {
  while (true) {
    double next = world_.start + direction_ * static_cast<double>(next_sample_) * world_.sample;
    // a multiple of the spacing that misses the end by rounding is the end
    constexpr double kRounding = 1e-9;
    if (std::abs(next - world_.end) < kRounding * world_.sample) next = world_.end;
    if (direction_ * (time - next) < 0.0) return;
    ++next_sample_;
    write_sample(next);
    if (next_sample_ % kSamplesBetweenQuestions == 0 && observer_.interrupted(next)) return interrupt(next);
  }
}

void Simulation::write_sample(double time) {
  last_sample_ = time;
  observer_.sample(sample_at(time));
}

Sample Simulation::sample_at(double time) const {
  Sample sample;
  sample.time = time;
  sample.bodies.resize(world_.bodies.size());
  sample.states.resize(world_.states.size());
  std::vector<Eigen::VectorXd> states;
  states.reserve(motions_.size());
  for (const auto& each : motions_) {
    states.push_back(each->state(time));
    const Eigen::VectorXd rate = each->rate(time, states.back());
    for (const int b : each->group().bodies) {
      const World::Body& body = world_.bodies[static_cast<std::size_t>(b)];
      sample.bodies[static_cast<std::size_t>(b)] = body_state(body, states.back(), rate);
    }
  }
  for (std::size_t i = 0; i < world_.states.size(); ++i) {
    const World::ExtraState& state = world_.states[i];
    sample.states[i] = {state.name, states[static_cast<std::size_t>(state.group)][state.offset]};
  }
  return sample;
}

}  // namespace trajet
