#include "branched_stepper.hpp"

#include <cmath>
#include <utility>

#include "trajet/ode/step_control.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// Where it was not decided so often which branch holds, the law switches to and fro at one place.
constexpr int kMostUndecided = 1000;
/// So often a step of a set length is made again at one end of a branch.
constexpr int kMostRetakes = 20;

}  // namespace

BranchedStepper::BranchedStepper(const MethodInfo& method, const StepOptions& options, ProgramSystem& whole,
                                 std::unique_ptr<LawBranches> branches)
    : most_retakes_(method.needs_step()                 ? kMostRetakes
                    : method.dense_order < method.order ? 1
                                                        : 0),
      is_fixed_(method.needs_step()),
      branches_(std::move(branches)),
      system_(whole, branches_->pinned().law),
      stepper_(method.make(system_, options)) {}

void BranchedStepper::start(double t, const State& q) {
  time_ = t;
  state_ = q;
  extended_.reset();
  passed_.reset();
  arrival_.reset();
  begins_ = true;
}

void BranchedStepper::start_extended(double t, const ExtendedState& q) {
  start(t, q.cast<double>());
  extended_ = q;
}

void BranchedStepper::begin(double direction, bool may_pin) {
  using Finding = LawBranches::Finding;
  const std::vector<SlidingBorder> before(branches_->sliding().begin(), branches_->sliding().end());
  const double t = system_.within_piece(time_);
  if (may_pin) {
    Finding finding = passed_ ? branches_->pass(*passed_, t, state_.data(), direction)
                              : branches_->begin(t, state_.data(), direction);
    displace();
    if (finding == Finding::moved) finding = branches_->begin(t, state_.data(), direction);
    undecided_ += finding == Finding::undecided ? 1 : 0;
    may_pin = finding == Finding::decided;
    if (may_pin) record_slides(before);
  }
  if (may_pin) {
    system_.take_branches(*branches_);
  } else {
    system_.take_whole();
  }
  if (extended_) {
    stepper_->start_extended(time_, *extended_);
  } else {
    stepper_->start(time_, state_);
  }
}

void BranchedStepper::displace() {
  const Eigen::VectorXd& displacement = branches_->displacement();
  if (displacement.isZero(0.0)) return;
  state_ += displacement;
  if (!extended_) return;
  for (Eigen::Index i = 0; i < displacement.size(); ++i) {
    Extended& component = (*extended_)[i];
    if (displacement[i] != 0.0) component = state_[i] == 0.0 ? Extended(0) : component + Extended(displacement[i]);
  }
}

bool BranchedStepper::approach(double& t_limit, double direction) {
  if (branches_->pinned().directions.empty() || system_.is_whole()) return false;
  const State error =
      segment_.dimension() == state_.size() ? State(segment_.error_bound()) : State::Zero(state_.size());
  const auto approach = branches_->approach(system_.within_piece(time_), state_.data(), direction, error);
  if (!approach) return false;
  if (approach->is_there) {
    passed_ = LawBranches::End{time_, approach->border, 0.0, -1.0, false, true};
    return true;
  }
  // The direction turns the faster the shorter the vector is: no step comes to its end at once.
  constexpr double kPart = 0.5;
  if (kPart * approach->duration < std::abs(t_limit - time_)) t_limit = time_ + direction * kPart * approach->duration;
  return false;
}

void BranchedStepper::record_slides(const std::vector<SlidingBorder>& before) {
  const auto add = [&](int border, bool begins) {
    const bool is_passed = passed_ && passed_->border == border;
    slides_.push_back(
        {time_, first_output_of(branches_->pinned(), border), begins, is_passed && passed_->onward < 0.0 ? -1 : 1});
  };
  const auto is_among = [](const auto& borders, int border) {
    return ranges::any_of(borders, [border](const SlidingBorder& each) { return each.border == border; });
  };
  for (const SlidingBorder& each : before)
    if (!is_among(branches_->sliding(), each.border)) add(each.border, false);
  for (const SlidingBorder& each : branches_->sliding())
    if (!is_among(before, each.border)) add(each.border, true);
}

void BranchedStepper::find_switch() {
  if (!arrival_) return;
  const auto size = arrival_->state.size();
  State behind(size);
  system_.rate(arrival_->time, arrival_->state.data(), behind.data());
  const Eigen::RowVectorXd by_state = arrival_->gradient.head(size);
  const double speed = by_state.dot(arrival_->rate) + arrival_->gradient[size];
  const Eigen::MatrixXd jump = (behind - arrival_->rate) * (by_state / speed);
  if (jump.allFinite()) switch_ = Eigen::MatrixXd::Identity(size, size) + jump;
  arrival_.reset();
}

void BranchedStepper::undo_step() { extended_ = stepper_->extended_state(0.0L); }

StepStatus BranchedStepper::advance(double t_limit) {
  slides_.clear();
  switch_.reset();
  system_.keep_within_piece();
  const double direction = t_limit < time_ ? -1.0 : 1.0;
  int changes = 0, approaches = 0;
  bool may_pin = true;
  while (true) {
    branches_->set_horizon(std::abs(t_limit - time_));
    if (std::exchange(begins_, false)) begin(direction, may_pin);
    double limit = t_limit;
    if (++approaches <= kMaxBranchChanges && approach(limit, direction)) {
      if (!begins_) extended_ = stepper_->extended_state(static_cast<Extended>(segment_.duration()));
      begins_ = true;
      continue;
    }
    if (undecided_ > kMostUndecided) {
      undecided_component_ = first_output_of(branches_->pinned(), branches_->undecided().front());
      return StepStatus::step_too_small;
    }
    if (const StepStatus status = step(limit); status != StepStatus::ok) {
      if (system_.is_whole()) return status;
      may_pin = false;
      begins_ = true;
      continue;
    }
    if (system_.is_whole()) break;
    retake_to_end();
    if (!end_) break;
    if (end_->is_known && std::abs(end_->time - time_) >= smallest_step(time_)) {
      find_switch();
      cut(*end_);
      return StepStatus::ok;
    }
    if (end_->is_known) arrive(*end_);
    undo_step();
    begins_ = true;
    may_pin = end_->is_known && ++changes <= kMaxBranchChanges;
    passed_ = end_;
  }
  find_switch();
  time_ = stepper_->time();
  state_ = stepper_->state();
  extended_.reset();
  passed_.reset();
  begins_ = system_.is_whole();
  if (begins_) extended_ = stepper_->extended_state(static_cast<Extended>(segment_.duration()));
  return StepStatus::ok;
}

StepStatus BranchedStepper::step(double t_limit) {
  constexpr int kMostTries = 6;
  constexpr double kShorter = 1.0 / 16.0;
  for (int tries = 0;; ++tries) {
    const StepStatus status = stepper_->advance(t_limit);
    if (status == StepStatus::ok) stepper_->fill_segment(segment_);
    if (system_.is_whole()) return status;
    end_ = status == StepStatus::ok ? branches_->find_end(segment_) : std::nullopt;
    // one that seems to turn back at once may be bent by what it has met far beyond
    const bool turns_back = end_ && std::abs(end_->time - time_) < smallest_step(time_);
    const bool is_lost = status == StepStatus::not_finite || turns_back || (end_ && !end_->is_known);
    if (!is_lost || !is_fixed_ || tries == kMostTries) return status;
    t_limit = time_ + kShorter * (t_limit - time_);
    stepper_->start(time_, state_);
  }
}

void BranchedStepper::retake_to_end() {
  constexpr double kNear = 1e-3;  // of the step: so near to its end its polynomial is as exact as that
  constexpr double kLonger = 4.0;
  const double direction = segment_.duration() < 0.0 ? -1.0 : 1.0;
  double passing = std::abs(segment_.duration());  // a step so long has passed the end
  for (int tries = 0; tries < most_retakes_; ++tries) {
    const double last = std::abs(segment_.duration());
    double next = kLonger * last;  // where the last one has seemed to pass it too early
    if (end_) {
      next = std::abs(end_->time - time_);
      if (!end_->is_known || next > (1.0 - kNear) * last || next < smallest_step(time_)) return;
      passing = last;
    } else if (next >= passing) {
      return;
    }
    stepper_->start(time_, state_);
    if (stepper_->advance(time_ + direction * next) != StepStatus::ok) {
      stepper_->start(time_, state_);
      if (!end_ && stepper_->advance(segment_.t1()) == StepStatus::ok) stepper_->fill_segment(segment_);
      return;
    }
    stepper_->fill_segment(segment_);
    end_ = branches_->find_end(segment_);
  }
}

void BranchedStepper::cut(const LawBranches::End& end) {
  extended_ = stepper_->extended_state(static_cast<Extended>(end.time) - static_cast<Extended>(segment_.t0()));
  segment_.set_interval(segment_.t0(), end.time);
  time_ = end.time;
  state_ = segment_.state(end.time);
  passed_ = end;
  begins_ = true;
  arrive(end);
}

void BranchedStepper::arrive(const LawBranches::End& end) {
  // a law does not jump where it lets go; and what came here first has come by the law before
  if (end.is_slip || arrival_) return;
  Arrival arrival{time_, state_, State(state_.size()), branches_->gradient(end.border, time_, state_.data())};
  system_.rate(time_, state_.data(), arrival.rate.data());
  arrival_ = std::move(arrival);
}

void BranchedStepper::forget() {
  if (begins_ || stepper_->is_extended() || stepper_->amend(state_)) return;
  stepper_->start(time_, state_);
}

bool BranchedStepper::amend(const State& q) {
  if (!begins_ && !stepper_->amend(q)) return false;
  state_ = q;
  extended_.reset();
  return true;
}

}  // namespace trajet
