#include "recorder.hpp"

#include <algorithm>
#include <cmath>

#include "body_state.hpp"
#include "trajet/text/shortest_text.hpp"

#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// A step may hold any number of samples: so often in between the observer is asked whether to go on.
constexpr long kSamplesBetweenQuestions = 4096;

}  // namespace

Recorder::Recorder(const World& world, const Courses& courses, RunObserver& observer)
    : world_(world),
      courses_(courses),
      observer_(observer),
      wishes_(observer.wishes()),
      time_limit_(world.max_seconds),
      direction_(world.direction()) {
  observer_.begin(world_);
  result_.scene = world.scene;
  result_.title = world.title;
  result_.method = world.method->name;
  result_.start_time = world.epoch;
  result_.parameters = world.parameters;
  result_.warnings = world.warnings;
}

bool Recorder::sample_until(double& time) {
  if (!wishes_.samples) return true;
  while (true) {
    double next = direction_ * static_cast<double>(next_sample_) * world_.sample;
    // a multiple of the spacing that misses the end by rounding is the end
    constexpr double kRounding = 1e-9;
    if (std::abs(next - world_.duration) < kRounding * world_.sample) next = world_.duration;
    if (direction_ * (time - next) < 0.0) return true;
    ++next_sample_;
    sample(next);
    if (next_sample_ % kSamplesBetweenQuestions == 0 && is_interrupted(next)) {
      time = next;
      return false;
    }
  }
}

void Recorder::sample(double time) {
  if (!wishes_.samples) return;
  observer_.sample(sample_at(time, std::nullopt, SamplePhase::none));
  last_sample_ = time;
}

double Recorder::reached_time() const {
  const double sampled = last_sample_.value_or(0.0);
  return direction_ * (sampled - end_time()) > 0.0 ? sampled : end_time();
}

void Recorder::hand_on_no_more() { wishes_.motion = false; }

void Recorder::sample(double time, int body, SamplePhase phase) {
  if (!wishes_.samples) return;
  if (world_.bodies.size() == 1) last_sample_ = time;
  observer_.sample(sample_at(time, body, phase));
}

Sample Recorder::sample_at(double time, std::optional<int> only, SamplePhase phase) const {
  Sample sample;
  sample.time = world_.epoch + time;
  sample.elapsed = time;
  sample.phase = phase;
  const auto add = [&](const Course& course, std::span<const int> bodies) {
    const Eigen::VectorXd q = course.state(time);
    const Eigen::VectorXd rate = course.rate(time, q);
    for (const int b : bodies) {
      const World::Body& body = world_.bodies[static_cast<std::size_t>(b)];
      sample.bodies[only ? 0 : static_cast<std::size_t>(b)] = body_state(body, q, rate);
    }
  };
  sample.bodies.resize(only ? 1 : world_.bodies.size());
  if (only) {
    const int group = world_.bodies[static_cast<std::size_t>(*only)].group;
    add(*courses_[static_cast<std::size_t>(group)], {&*only, 1});
  } else {
    for (const auto& course : courses_) add(*course, course->group().bodies);
  }
  for (const World::ExtraState& state : world_.states)
    sample.states.push_back({state.name, courses_[static_cast<std::size_t>(state.group)]->state(time)[state.offset]});
  return sample;
}

void Recorder::motion(Course& course, double t) {
  if (!wishes_.motion) return;
  if (const std::optional<MotionPiece> piece = course.hand_on(t)) observer_.motion(*piece);
}

void Recorder::put_on_clock(Impact& impact) const {
  impact.time = world_.epoch + impact.elapsed;
  if (world_.epoch != 0.0) impact.time_error_bound += kUnitRoundoff * std::abs(impact.time);
  // all that is known of it then is that it is in the run
  if (!(impact.time_error_bound <= std::abs(world_.duration))) impact.time_error_bound = std::abs(world_.duration);
}

void Recorder::contact(double time, PairId id, ImpactKind mode) {
  contact_ends(time, id);
  open_contacts_[{id.body, id.obstacle}] = result_.contacts.size();
  result_.contacts.push_back({world_.epoch + time, std::nullopt, world_.bodies[static_cast<std::size_t>(id.body)].name,
                              world_.obstacles[static_cast<std::size_t>(id.obstacle)].name, mode});
}

void Recorder::contact_ends(double time, PairId id) {
  const auto open = open_contacts_.find({id.body, id.obstacle});
  if (open == open_contacts_.end()) return;
  result_.contacts[open->second].to = world_.epoch + time;
  open_contacts_.erase(open);
}

void Recorder::event(double time, const std::string& name, int direction, const std::string& law) {
  EventRecord event{world_.epoch + time, time, name, direction, law};
  observer_.event(event);
  if (!wishes_.takes_records) result_.events.push_back(std::move(event));
}

void Recorder::impact(Impact impact) {
  if (last_impact_) {
    const Impact& last = *last_impact_;
    const double apart = std::abs(impact.elapsed - last.elapsed);
    // a meeting of bodies that others cause at once is none: its handler knows
    const bool is_meeting = impact.partner || last.partner;
    const bool is_tie =
        !is_meeting && impact.with != last.with && apart <= impact.time_error_bound + last.time_error_bound;
    if (is_tie && impact.kind == ImpactKind::hit && last.kind == ImpactKind::hit)
      warn_of_tie(last, impact.body, impact.with);
  }
  keep(std::move(impact));
}

void Recorder::impacts(std::vector<Impact> group) {
  if (group.size() > 1) {
    ++group_count_;
    for (Impact& each : group) each.group = group_count_;
  }
  if (group.empty()) return;
  impact(group.front());
  for (Impact& each : std::span(group).subspan(1)) keep(std::move(each));
}

void Recorder::keep(Impact impact) {
  put_on_clock(impact);
  last_impact_ = impact;
  observer_.impact(impact);
  if (!wishes_.takes_records) result_.impacts.push_back(std::move(impact));
}

void Recorder::unresolved(double time, const std::string& body, const std::string& with, const std::string& why) {
  result_.unresolved.push_back({world_.epoch + time, body, with, why});
}

void Recorder::warn_of_tie(const Impact& impact, const std::string& body, const std::string& with) {
  constexpr int kMost = 5;
  if (++tie_count_ > kMost) return warn("further impacts are closer in time than their error bounds");
  warn("impacts of '" + impact.body + "' with '" + impact.with + "' and of '" + body + "' with '" + with +
       "' are closer in time than their error bounds: which is first is decided by rounding");
}

void Recorder::warn_of_gain(const Impact& impact, double energy) {
  constexpr int kMost = 5;
  if (++gain_count_ > kMost) return warn("further impacts by Newton's law gain energy");
  warn("the impact of '" + impact.body + "' with '" + impact.with +
       "' at t = " + shortest_text(world_.epoch + impact.elapsed) + " s gains " + shortest_text(energy) +
       " J: with friction Newton's law of impact can; impact = \"stronge\" and \"poisson\" never do");
}

void Recorder::warn(const std::string& text) {
  if (ranges::find(result_.warnings, text) == result_.warnings.end()) result_.warnings.push_back(text);
}

void Recorder::end(RunStatus status, const std::string& failure) {
  result_.status = status;
  result_.failure = failure;
}

void Recorder::bound_final_errors() {
  for (const auto& course : courses_) {
    const Eigen::VectorXd bound = course->error_bound(result_.elapsed);
    for (const int b : course->group().bodies) {
      BodyState& state = result_.final.bodies[static_cast<std::size_t>(b)];
      const int offset = world_.bodies[static_cast<std::size_t>(b)].offset;
      state.position_error_bound = bound.segment<3>(offset).norm();
      state.velocity_error_bound = bound.segment<3>(offset + 3).norm();
    }
  }
}

RunResult Recorder::result() {
  result_.end_time = world_.epoch + result_.elapsed;
  for (const auto& course : courses_) motion(*course, result_.elapsed);
  if (result_.status != RunStatus::stopped && last_sample_ != result_.elapsed) sample(result_.elapsed);
  result_.final = sample_at(result_.elapsed, std::nullopt, SamplePhase::none);
  bound_final_errors();
  for (const auto& course : courses_) {
    const StepStatistics statistics = course->statistics();
    result_.statistics.steps += statistics.steps;
    result_.statistics.rejected_steps += statistics.rejected_steps;
    result_.statistics.law_evaluations += statistics.law_evaluations;
    if (statistics.proposed_step > 0.0)  // of several motions, the smallest
      result_.statistics.proposed_step = result_.statistics.proposed_step > 0.0
                                             ? std::min(result_.statistics.proposed_step, statistics.proposed_step)
                                             : statistics.proposed_step;
    for (const std::string& warning : course->warnings()) warn(warning);
  }
  for (const auto& course : courses_)
    if (const std::string warning = course->tolerance_warning(); !warning.empty()) {
      warn(warning);
      break;
    }
  return std::move(result_);
}

}  // namespace trajet
