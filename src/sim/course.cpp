#include "course.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "instant.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/math/polynomial.hpp"
#include "trajet/portable.hpp"
#include "trajet/sim/state_at.hpp"

namespace trajet {

Course::Course(const World& world, int group)
    : world_(world),
      group_(group),
      held_law_(world, group),
      switches_(this->group().law),
      orientations_(world, group),
      closed_rotations_(world, group),
      error_(static_cast<int>(this->group().start.size()), world.method->carries_extended ? 0x1p-64 : kUnitRoundoff),
      watches_(world, group, held_law_) {
  piece_ = {0.0, 0.0, 0.0, true};
  if (keeps_tolerance() && world.atol_follows_scale) scale_.emplace(world, group, orientations_.tolerance_factor());
  if (keeps_tolerance() && !world.atol_follows_scale) tolerance_check_.emplace(world, group);
  make_stepper();
  begin(0.0, this->group().start, nullptr);
}

void Course::use_law() {
  finished_steppers_ = statistics();
  finished_warnings_ = warnings();
  watches_.watch_holders();
  make_stepper();
}

std::vector<EventHold> Course::kept_holds(const Instant& instant) const {
  std::vector<EventHold> kept = instant.holds;
  std::erase_if(kept, [&](const EventHold& hold) {
    if (!held_law_.is_held(hold.event)) return false;  // it begins now
    std::array<double, 3> before{}, behind{};
    Evaluator<double> evaluate(hold.border);
    evaluate(instant.time(), instant.before().data(), before.data());
    evaluate(instant.time(), instant.q.data(), behind.data());
    return before[0] != behind[0] || before[1] != behind[1];
  });
  return kept;
}

bool Course::keeps_tolerance() const {
  // steps of parabolas have no error
  const int degree = held_law_.free().polynomial_degree();
  return world_.method->control == StepControl::adaptive && (degree < 0 || degree > 2);
}

void Course::make_stepper() {
  StepOptions options = world_.step_options;
  options.rtol *= orientations_.tolerance_factor();
  options.atol *= orientations_.tolerance_factor();
  if (scale_) options.component_atol = scale_->tolerances();
  ProgramSystem& law = held_law_.system();
  branched_ = nullptr;
  // of the directions of a contact's friction the contact itself knows when they are lost
  if (!chooses_by_state(held_law_.free().program())) {
    stepper_ = world_.method->make(law, options);
    return;
  }
  auto branches = std::make_unique<LawBranches>(law.program());
  auto branched = std::make_unique<BranchedStepper>(*world_.method, options, law, std::move(branches));
  branched_ = branched.get();
  stepper_ = std::move(branched);
}

void Course::enter_piece(double t) {
  if (piece_.is_switch && world_.direction() * (t - piece_.end) >= 0.0) piece_ = switches_.piece(t, world_.duration);
  held_law_.keep_within(piece_.first, piece_.last);
}

void Course::pass_switch() {
  const double t = stepper_->time();
  enter_piece(t);
  if (!switches_.may_jump()) {
    // behind a corner a method that knows the state alone goes on; what others remember is of the law before
    if (branched_ != nullptr) return branched_->forget();
    if (stepper_->is_extended() || stepper_->amend(end_state_)) return;
  }
  if (scale_) scale_->begin(t, end_state_, law());
  if (const auto extended = extended_state(static_cast<Extended>(t) - segment_.t0())) {
    stepper_->start_extended(t, *extended);
  } else {
    stepper_->start(t, end_state_);
  }
}

void Course::begin(double t, const Eigen::VectorXd& q, const Instant* instant) {
  if (!switches_.empty()) enter_piece(t);
  const Eigen::VectorXd* before = instant != nullptr ? &instant->before() : nullptr;
  end_state_ = q;
  const std::vector<const World::Rotation*> pushed = held_law_.pushed_rotations();
  orientations_.begin(end_state_, before, pushed);
  closed_rotations_.begin(t, end_state_, before, pushed);
  if (scale_) scale_->begin(t, end_state_, law());
  if (const auto extended = instant != nullptr ? instant->extended() : std::nullopt) {
    // orientations were put right in double precision
    const auto is_right = (extended->cast<double>().array() == end_state_.array());
    stepper_->start_extended(t, is_right.select(*extended, end_state_.cast<Extended>()));
  } else if (instant == nullptr && world_.extended) {
    stepper_->start_extended(t, world_.extended->starts[static_cast<std::size_t>(group_)]);
  } else {
    stepper_->start(t, end_state_);
  }
  rest_of_step_.clear();
  handed_on_ = t;
  begins_anew_ = true;
  segment_.resize(static_cast<int>(q.size()), 0);
  segment_.set_interval(t, t);
  segment_.coefficients().col(0) = end_state_;
  segment_.error_bound().setZero();
  next_ = {t};
}

std::optional<Eigen::VectorX<Extended>> Course::extended_state(Extended tau) const {
  const bool is_step = segment_.duration() != 0.0 && segment_.t1() == stepper_->time() && rest_of_step_.empty();
  return is_step ? stepper_->extended_state(tau) : std::nullopt;
}

std::optional<MotionPiece> Course::hand_on(double t) {
  if (t == handed_on_) return std::nullopt;
  const bool ends_step = t == segment_.t1() && rest_of_step_.empty();
  return MotionPiece{group_, segment_, std::exchange(handed_on_, t), t, std::exchange(begins_anew_, false), ends_step};
}

void Course::restart(const Instant& instant) {
  const double t = instant.time();
  pass_error(t);
  error_.jump(instant.derivative, instant.further_errors);
  const std::vector<EventHold> held_before = held_law_.holds();
  const bool is_held_anew = held_law_.take(instant.contacts, kept_holds(instant));
  if (is_held_anew) use_law();
  watches_.jump(t, instant.before(), instant.q, segment_, is_held_anew);
  if (!watches_.empty()) watches_.forget_edges(t, instant.q, free_rate(t, instant.before()), rate(t, instant.q));
  for (const EventHold& hold : held_before)
    if (!held_law_.is_held(hold.event)) watches_.stand_on(hold.event, t, instant.q, hold.side);
  begin(t, instant.q, &instant);
}

void Course::pass_error(double t) {
  error_.pass(law(), segment_, t);
  // the next step may be on another branch of the law
  if (branched_ != nullptr) error_.settle();
}

double Course::turning_limit(double limit) const {
  // forces at corners that turn are enclosed well over so small an angle only
  constexpr double kTurn = 0.1;  // rad
  const double t = stepper_->time();
  for (const World::Rotation* rotation : held_law_.turning_corners()) {
    const int w = rotation->offset + rotation->layout.size();
    const double speed = end_state_.segment<3>(w).norm(), faster = rate(t, end_state_).segment<3>(w).norm();
    // speed dt + faster dt^2 / 2 = kTurn
    const double longest = 2.0 * kTurn / (speed + std::sqrt(speed * speed + 2.0 * kTurn * faster));
    if (longest < std::abs(limit - t)) limit = t + world_.direction() * longest;
  }
  // and the friction of what slides, which has the direction of its slip
  const double longest = held_law_.time_of_slips(t, end_state_);
  if (longest > 0.0 && longest < std::abs(limit - t)) limit = t + world_.direction() * longest;
  return limit;
}

StepStatus Course::advance() {
  if (segment_.duration() != 0.0) pass_error(segment_.t1());
  if (rest_of_step_.empty()) {
    const bool has_switch = !switches_.empty() && piece_.is_switch;
    if (has_switch && stepper_->time() == piece_.end) pass_switch();
    const double limit = turning_limit(!switches_.empty() && piece_.is_switch ? piece_.end : world_.duration);
    if (const StepStatus status = stepper_->advance(limit); status != StepStatus::ok) return status;
    if (branched_ != nullptr)
      if (const auto jump = branched_->take_switch()) error_.jump(*jump);
    stepper_->fill_segment(segment_);
    end_state_ = stepper_->state();
    if (tolerance_check_) tolerance_check_->take(end_state_);
    if (scale_) scale_->grow(segment_.t1(), end_state_, segment_.duration(), law());
    if (!orientations_.empty()) put_orientations_right();
  }
  if (!rest_of_step_.empty()) {
    segment_ = std::move(rest_of_step_.front());
    rest_of_step_.pop_front();
  }
  watches_.search(segment_);
  next_ = watches_.next(segment_);
  return StepStatus::ok;
}

void Course::put_orientations_right() {
  const Eigen::VectorXd stepped = end_state_;
  orientations_.end_step(segment_, end_state_);
  if (!closed_rotations_.empty()) {
    closed_rotations_.write(segment_.t1(), end_state_);
    rest_of_step_ = closed_rotations_.pieces(segment_);
  }
  // a state that is right but for rounding may stay: a new one costs the method the rate that it knows at the end
  constexpr double kRounding = 1e-15;
  if ((end_state_ - stepped).cwiseAbs().maxCoeff() >= kRounding) amend_stepper(end_state_);
}

void Course::amend_stepper(const Eigen::VectorXd& q) {
  if (!stepper_->amend(q)) {
    // What is reported is right in any case: a method that would have to start anew does so only when it has drifted
    // far.
    constexpr double kFar = 0.5;
    if (orientations_.drift(stepper_->state()) < kFar) return;
    stepper_->start(segment_.t1(), q);
  }
  orientations_.was_taken();
}

void Course::turn_event(int event, const Instant& instant, const Eigen::VectorXd& rate_before) {
  watches_.turn_event(event, instant.time(), instant.before(), rate_before, instant.q, rate(instant.time(), instant.q));
}

void Course::pass_event(int event) {
  watches_.pass_event(event, segment_);
  next_ = watches_.next(segment_);
}

Eigen::VectorXd Course::state(double t) const {
  return t == segment_.t1() && rest_of_step_.empty() ? end_state_ : state_at(world_, group_, segment_, t);
}

Eigen::VectorXd Course::free_rate(double t, const Eigen::VectorXd& q) const {
  Eigen::VectorXd dq(q.size());
  held_law_.free().rate(t, q.data(), dq.data());
  return dq;
}

Eigen::VectorXd Course::rate(double t, const Eigen::VectorXd& q) const {
  Eigen::VectorXd dq(q.size());
  if (branched_ != nullptr && branched_->is_sliding() && t > segment_.t0()) {
    branched_->rate(t, q.data(), dq.data());
    return dq;
  }
  held_law_.system().rate(t, q.data(), dq.data());
  return dq;
}

double Course::velocity_error(const Eigen::VectorXd& direction, double t) {
  constexpr double kSteps = 10.0;  // whose errors may have added up
  if (tolerance_warning().empty()) return 0.0;
  return std::max(error_bound_along(direction, t), kSteps * world_.step_options.atol);
}

StepStatistics Course::statistics() const {
  StepStatistics sum = finished_steppers_;
  sum.steps += stepper_->statistics().steps;
  sum.rejected_steps += stepper_->statistics().rejected_steps;
  sum.law_evaluations += stepper_->statistics().law_evaluations;
  sum.proposed_step = stepper_->statistics().proposed_step;
  return sum;
}

std::vector<std::string> Course::warnings() const {
  std::vector<std::string> all = finished_warnings_;
  ranges::copy(stepper_->warnings(), std::back_inserter(all));
  return all;
}

}  // namespace trajet
