#include "course.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "instant.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/math/polynomial.hpp"
#include "trajet/portable.hpp"
#include "trajet/sim/state_at.hpp"

namespace trajet {

Support support_of(const std::vector<RestingContact>& contacts, int offset) {
  std::vector<Vector3> normals;
  for (const RestingContact& contact : contacts)
    if (contact.offset == offset) normals.push_back(contact.normal);
  return support(normals);
}

Course::Course(const World& world, int group)
    : world_(world),
      group_(group),
      free_system_(std::make_unique<ProgramSystem>(this->group().law)),
      switches_(this->group().law),
      orientations_(world, group),
      closed_rotations_(world, group),
      error_(static_cast<int>(this->group().start.size()), world.method->carries_extended ? 0x1p-64 : kUnitRoundoff) {
  for (const int event : this->group().events) {
    const World::Event& definition = world.events[static_cast<std::size_t>(event)];
    watches_.push_back({Crossing::Kind::event, event, EventWatch(definition.when, definition.direction)});
  }
  piece_ = {0.0, 0.0, 0.0, true};
  if (keeps_tolerance() && world.atol_follows_scale) scale_.emplace(world, group, orientations_.tolerance_factor());
  if (keeps_tolerance() && !world.atol_follows_scale) tolerance_check_.emplace(world, group);
  use_contacts();
  begin(0.0, this->group().start, nullptr);
}

void Course::use_contacts() {
  if (stepper_) {
    finished_steppers_ = statistics();
    finished_warnings_ = warnings();
  }
  stepper_.reset();
  held_system_.reset();
  std::erase_if(watches_, [](const Watch& watch) { return watch.kind != Crossing::Kind::event; });
  if (!contacts_.empty() || !holds_.empty())
    held_system_ = std::make_unique<ProgramSystem>(law_with(contacts_, holds_));
  watch_contacts();
  watch_holds();
  make_stepper();
}

Program Course::law_with(const std::vector<RestingContact>& contacts, const std::vector<EventHold>& holds) const {
  Program law = group().law;
  for (const int body : group().bodies) {
    const int offset = world_.bodies[static_cast<std::size_t>(body)].offset;
    for (const Vector3& direction : support_of(contacts, offset).blocked) law = hold(law, offset, direction);
  }
  for (const EventHold& each : holds)
    law = hold_on_border(law, world_.events[static_cast<std::size_t>(each.event)].when, each.direction)->law;
  return law;
}

void Course::watch_contacts() {
  for (const int body : group().bodies) {
    const int offset = world_.bodies[static_cast<std::size_t>(body)].offset;
    const Support support = support_of(contacts_, offset);
    auto release = support.release.begin();
    for (RestingContact& contact : contacts_)
      if (contact.offset == offset) contact.release = *release++;
  }
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Shape& shape = world_.obstacles[static_cast<std::size_t>(contacts_[i].obstacle)].shape;
    const ReleaseConditions conditions =
        release_conditions(group().law, shape, contacts_[i], support_of(contacts_, contacts_[i].offset).blocked);
    const auto watch = [&](Crossing::Kind kind, const Program& condition) {
      watches_.push_back({kind, static_cast<int>(i), EventWatch(condition, CrossingDirection::rising)});
    };
    watch(Crossing::Kind::pull, conditions.pull);
    for (const Program& condition : conditions.past_edges) watch(Crossing::Kind::past_edge, condition);
  }
}

void Course::watch_holds() {
  for (std::size_t i = 0; i < holds_.size(); ++i) {
    std::vector<EventHold> others = holds_;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const EventHold& hold = holds_[i];
    const Program& when = world_.events[static_cast<std::size_t>(hold.event)].when;
    const Program pull = hold_on_border(law_with(contacts_, others), when, hold.direction)->pull;
    const auto away = hold.side > 0 ? CrossingDirection::rising : CrossingDirection::falling;
    watches_.push_back({Crossing::Kind::let_go, static_cast<int>(i), EventWatch(pull, away)});
  }
}

bool Course::is_held(int event) const {
  return ranges::any_of(holds_, [event](const EventHold& hold) { return hold.event == event; });
}

std::vector<EventHold> Course::kept_holds(const Instant& instant) const {
  std::vector<EventHold> kept = instant.holds;
  std::erase_if(kept, [&](const EventHold& hold) {
    if (!is_held(hold.event)) return false;  // it begins now
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
  const int degree = free_system_->polynomial_degree();
  return world_.method->control == StepControl::adaptive && (degree < 0 || degree > 2);
}

void Course::make_stepper() {
  StepOptions options = world_.step_options;
  options.rtol *= orientations_.tolerance_factor();
  options.atol *= orientations_.tolerance_factor();
  if (scale_) options.component_atol = scale_->tolerances();
  ProgramSystem& law = held_system_ ? *held_system_ : *free_system_;
  branched_ = nullptr;
  if (!chooses_by_state(law.program())) {
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
  free_system_->keep_within(piece_.first, piece_.last);
  if (held_system_) held_system_->keep_within(piece_.first, piece_.last);
}

void Course::pass_switch() {
  const double t = stepper_->time();
  enter_piece(t);
  // a law that only has a corner there goes on from the rate that the method knows
  if (!switches_.may_jump()) return;
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
  orientations_.begin(end_state_, before);
  closed_rotations_.begin(t, end_state_, before);
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
  const auto same = [](const RestingContact& a, const RestingContact& b) {
    return a.body == b.body && a.obstacle == b.obstacle && a.normal == b.normal && a.point == b.point;
  };
  const std::vector<EventHold> held_before = std::exchange(holds_, kept_holds(instant));
  const bool is_held_anew = !ranges::equal(contacts_, instant.contacts, same) ||
                            !ranges::equal(held_before, holds_, {}, &EventHold::event, &EventHold::event);
  if (is_held_anew) {
    contacts_ = instant.contacts;
    use_contacts();
  }
  restart_watches(instant, is_held_anew);
  for (const EventHold& hold : held_before)
    if (!is_held(hold.event)) watches_[place_of(hold.event)].watch.stand_on(t, instant.q.data(), hold.side);
  begin(t, instant.q, &instant);
}

void Course::restart_watches(const Instant& instant, bool is_held_anew) {
  if (watches_.empty()) return;
  const double t = instant.time();
  // of the jump, and of the state that the motion has at a rounded time
  constexpr double kRoundings = 8.0;
  const double time = std::abs(t) + std::abs(t - segment_.t0());
  Eigen::VectorXd rounding(instant.q.size());
  for (int i = 0; i < rounding.size(); ++i) {
    const double change = time * std::abs(segment_.derivative(i, t));
    rounding[i] = kRoundings * kUnitRoundoff * (std::abs(instant.before()[i]) + std::abs(instant.q[i]) + change);
  }
  for (Watch& watch : watches_) {
    const bool begins = is_held_anew && watch.kind != Crossing::Kind::event;
    const Eigen::VectorXd& before = begins ? instant.q : instant.before();
    watch.watch.restart(t, before.data(), instant.q.data(), rounding.data());
    if (watch.kind == Crossing::Kind::past_edge)
      watch.watch.forget_unless_rising(t, instant.q.data(), free_rate(t, instant.before()).data(),
                                       rate(t, instant.q).data());
  }
}

void Course::pass_error(double t) {
  error_.pass(law(), segment_, t);
  // the next step may be on another branch of the law
  if (branched_ != nullptr) error_.settle();
}

StepStatus Course::advance() {
  if (segment_.duration() != 0.0) pass_error(segment_.t1());
  if (rest_of_step_.empty()) {
    const bool has_switch = !switches_.empty() && piece_.is_switch;
    if (has_switch && stepper_->time() == piece_.end) pass_switch();
    const double limit = !switches_.empty() && piece_.is_switch ? piece_.end : world_.duration;
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
  for (Watch& watch : watches_)
    if (watch.kind != Crossing::Kind::event || !is_held(watch.index)) watch.watch.search(segment_, segment_.t0());
  find_next();
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

void Course::find_next() {
  next_ = {segment_.t1()};
  const double direction = segment_.t1() < segment_.t0() ? -1.0 : 1.0;
  const Watch* first = nullptr;
  for (const Watch& watch : watches_) {
    if (!watch.watch.next().found || (watch.kind == Crossing::Kind::event && is_held(watch.index))) continue;
    const double ahead = direction * (next_.time - watch.watch.next().time);
    if (ahead < 0.0 || (ahead == 0.0 && first != nullptr)) continue;
    first = &watch;
    next_ = {watch.watch.next().time, watch.kind, watch.index, watch.watch.next().error_bound};
  }
  if (first == nullptr) return;
  // of what cannot be told apart in time, the one that stands first is the next
  const auto is_now = [&](const Watch& watch) {
    const EventWatch::Crossing& other = watch.watch.next();
    return other.found && std::abs(other.time - next_.time) <= other.error_bound + first->watch.next().error_bound;
  };
  const Watch& next = *ranges::find_if(watches_, is_now);
  next_.kind = next.kind;
  next_.index = next.index;
}

std::size_t Course::place_of(int event) const {
  return static_cast<std::size_t>(ranges::find(group().events, event) - group().events.begin());
}

const EventWatch::Crossing& Course::event_crossing(int event) const { return watches_[place_of(event)].watch.next(); }

void Course::take_event(int event) { watches_[place_of(event)].watch.take(); }

void Course::turn_event(int event, const Instant& instant, const Eigen::VectorXd& rate_before) {
  const double t = instant.time();
  watches_[place_of(event)].watch.turn(t, instant.before().data(), rate_before.data(), instant.q.data(),
                                       rate(t, instant.q).data());
}

void Course::pass_event(int event) {
  EventWatch& passed = watches_[place_of(event)].watch;
  const double time = passed.next().time;
  passed.pass();
  passed.search(segment_, time);
  find_next();
}

Eigen::VectorXd Course::state(double t) const {
  return t == segment_.t1() && rest_of_step_.empty() ? end_state_ : state_at(world_, group_, segment_, t);
}

Eigen::VectorXd Course::free_rate(double t, const Eigen::VectorXd& q) const {
  Eigen::VectorXd dq(q.size());
  free_system_->rate(t, q.data(), dq.data());
  return dq;
}

Eigen::VectorXd Course::rate(double t, const Eigen::VectorXd& q) const {
  Eigen::VectorXd dq(q.size());
  if (branched_ != nullptr && branched_->is_sliding() && t > segment_.t0()) {
    branched_->rate(t, q.data(), dq.data());
    return dq;
  }
  if (!held_system_) return free_rate(t, q);
  held_system_->rate(t, q.data(), dq.data());
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
