#include "motion.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "trajet/event/path.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/math/polynomial.hpp"

namespace trajet {

Motion::Motion(const World& world, int group, RunObserver& observer)
    : world_(world), group_(group), observer_(observer), rotations_(world, group) {
  for (const int body : this->group().bodies)
    for (std::size_t obstacle = 0; obstacle < world.obstacles.size(); ++obstacle)
      pairs_.push_back({body, static_cast<int>(obstacle)});
  for (const int event : this->group().events) {
    const World::Event& definition = world.events[static_cast<std::size_t>(event)];
    watches_.push_back({event, EventWatch(definition.when, definition.direction)});
  }
  error_ = Eigen::VectorXd::Zero(this->group().start.size());
  use_law();
  begin(world.start, this->group().start);
}

void Motion::collect_error(double t) {
  const double duration = std::abs(t - segment_.t0());
  for (const int body : group().bodies) {
    // an error of the velocity moves the body
    const int offset = world_.bodies[static_cast<std::size_t>(body)].offset;
    error_.segment<3>(offset) += duration * error_.segment<3>(offset + 3);
  }
  error_ += segment_.error_bound() + kUnitRoundoff * end_state_.cwiseAbs();
}

void Motion::use_law() {
  if (stepper_) {
    finished_steppers_ = statistics();
    finished_warnings_ = warnings();
  }
  Program law = group().law;
  for (const int body : group().bodies) {
    const int offset = world_.bodies[static_cast<std::size_t>(body)].offset;
    const Support support = this->support(offset);
    for (const Vector3& direction : support.blocked) law = hold(law, offset, direction);
    auto release = support.release.begin();
    for (RestingContact& contact : resting_)
      if (contact.offset == offset) contact.release = *release++;
  }
  stepper_.reset();
  system_ = std::make_unique<ProgramSystem>(law);
  StepOptions options = world_.step_options;
  options.rtol *= rotations_.tolerance_factor();
  options.atol *= rotations_.tolerance_factor();
  stepper_ = world_.method->make(*system_, options);
  release_watches_.clear();
  for (std::size_t i = 0; i < resting_.size(); ++i) {
    const Pair& resting_pair = pair(resting_[i].pair);
    const Shape& shape = world_.obstacles[static_cast<std::size_t>(resting_pair.obstacle)].shape;
    const ReleaseConditions conditions = release_conditions(group().law, shape, resting_[i]);
    const auto watch = [&](Incident::Kind kind, const Program& condition) {
      release_watches_.push_back({static_cast<int>(i), kind, EventWatch(condition, CrossingDirection::rising)});
    };
    watch(Incident::Kind::leave, conditions.pull);
    for (const Program& condition : conditions.past_edges) watch(Incident::Kind::past_edge, condition);
  }
}

void Motion::begin(double t, const Eigen::VectorXd& q) {
  stepper_->start(t, q);
  end_state_ = q;
  rotations_.begin(t, q);
  handed_on_ = t;
  begins_anew_ = true;
  segment_.resize(static_cast<int>(q.size()), 0);
  segment_.set_interval(t, t);
  segment_.coefficients().col(0) = q;
  segment_.error_bound().setZero();
  for (Pair& pair : pairs_) pair.known_at = t;
  next_ = {t};
}

void Motion::hand_on(double t) {
  if (t == handed_on_) return;
  observer_.motion({group_, segment_, handed_on_, t, begins_anew_, t == segment_.t1(), rotations_});
  handed_on_ = t;
  begins_anew_ = false;
}

void Motion::restart(double t, const Eigen::VectorXd& q) {
  hand_on(t);
  collect_error(t);
  const Eigen::VectorXd before = state(t);
  for (Pair& pair : pairs_) know_until(pair, t);
  for (Watch& watch : watches_) watch.watch.restart(t, before.data(), q.data());
  for (ReleaseWatch& release : release_watches_) release.watch.restart(t, before.data(), q.data());
  begin(t, q);
}

StepStatus Motion::advance() {
  hand_on(segment_.t1());
  if (segment_.duration() != 0.0) collect_error(segment_.t1());
  const StepStatus status = stepper_->advance(world_.end);
  if (status != StepStatus::ok) return status;
  for (Pair& pair : pairs_) know_until(pair, segment_.t1());
  stepper_->fill_segment(segment_);
  end_state_ = stepper_->state();
  if (!rotations_.empty()) settle_rotations();
  const double from = segment_.t0();
  for (Pair& pair : pairs_) pair.contact = first_contact_until(pair, segment_.t1());
  for (Watch& watch : watches_) watch.watch.search(segment_, from);
  for (ReleaseWatch& release : release_watches_) release.watch.search(segment_, from);
  find_next();
  return status;
}

void Motion::settle_rotations() {
  Eigen::VectorXd settled = end_state_;
  rotations_.settle(segment_.t1(), settled);
  // a quaternion that is unit but for rounding may stay: new ones cost the method the rate that it knows at the end
  constexpr double kRounding = 1e-15;
  if ((settled - end_state_).cwiseAbs().maxCoeff() < kRounding) return;
  if (!stepper_->amend(settled)) {
    // Reading the state settles it anyway: a method that would have to start anew does so only when it has drifted far.
    constexpr double kFar = 0.5;
    if (rotations_.unsettled(end_state_) < kFar) return;
    stepper_->start(segment_.t1(), settled);
  }
  end_state_ = settled;
}

ContactResult Motion::first_contact_until(const Pair& pair, double to) const {
  if (pair.resting) return {};
  const World::Body& body = world_.bodies[static_cast<std::size_t>(pair.body)];
  const World::Obstacle& obstacle = world_.obstacles[static_cast<std::size_t>(pair.obstacle)];
  const PointPath path(segment_, body.offset);
  const double start_error = error_.segment<3>(body.offset).norm();
  return first_contact(obstacle.shape,
                       {path, bounding_radius(body.solid), pair.known_at, to, world_.locate, start_error}, pair.memory);
}

void Motion::know_until(Pair& pair, double t) const {
  if (pair.known_at == t) return;
  const ContactResult contact = t == segment_.t1() ? pair.contact : first_contact_until(pair, t);
  const bool is_met = contact.status == ContactStatus::hit || contact.status == ContactStatus::graze;
  if (contact.status == ContactStatus::separated && !pair.resting) pair.memory = contact.memory;
  // a contact right at t, where another pair's was handled first, is still to come
  if (is_met) pair.memory = {.side = contact.side_before, .is_in_plane = contact.memory.is_in_plane};
  pair.known_at = t;
}

void Motion::find_next() {
  // at one time, events come first: an impact that ends the run must not hide them
  next_ = {segment_.t1()};
  const double direction = segment_.t1() < segment_.t0() ? -1.0 : 1.0;
  const auto consider = [&](double time, Incident::Kind kind, int index) {
    const double ahead = direction * (next_.time - time);
    if (ahead > 0.0 || (ahead == 0.0 && next_.kind == Incident::Kind::segment_end)) next_ = {time, kind, index};
  };
  for (const Watch& watch : watches_)
    if (watch.watch.next().found) consider(watch.watch.next().time, Incident::Kind::event, watch.event);
  for (const ReleaseWatch& release : release_watches_)
    if (release.watch.next().found) consider(release.watch.next().time, release.kind, release.resting);
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    if (pairs_[i].contact.status != ContactStatus::separated)
      consider(pairs_[i].contact.time, Incident::Kind::contact, static_cast<int>(i));
}

const EventWatch::Crossing& Motion::crossing(int event) const {
  for (const Watch& watch : watches_)
    if (watch.event == event) return watch.watch.next();
  std::abort();  // the event is one of the group's
}

void Motion::take_event(int event) {
  for (Watch& watch : watches_)
    if (watch.event == event) watch.watch.take();
}

void Motion::pass_event(int event) {
  for (Watch& watch : watches_) {
    if (watch.event != event) continue;
    const double time = watch.watch.next().time;
    watch.watch.take();
    watch.watch.search(segment_, time);
  }
  find_next();
}

void Motion::pass_contact(int index) {
  Pair& pair = pairs_[static_cast<std::size_t>(index)];
  pair.memory = pair.contact.memory;
  pair.known_at = pair.contact.time;
  pair.contact = first_contact_until(pair, segment_.t1());
  find_next();
}

bool Motion::stay_in_contact(int index, double height) {
  Pair& pair = pairs_[static_cast<std::size_t>(index)];
  const double time = pair.contact.time;
  ContactMemory memory = pair.contact.memory;
  memory.side = pair.contact.side_before;
  memory.contact_time = time;
  // how far the Segment goes astray is found by trying
  constexpr double kMore = 16.0;
  if (pair.memory.contact_time == time) memory.tolerance = std::max(memory.tolerance, kMore * pair.memory.tolerance);
  if (memory.tolerance > 0.5 * height) return false;
  pair.memory = memory;
  pair.known_at = time;
  pair.contact = first_contact_until(pair, segment_.t1());
  find_next();
  return true;
}

void Motion::begin_rest(int index, const Vector3& normal, const Vector3& point) {
  Pair& pair = pairs_[static_cast<std::size_t>(index)];
  const World::Body& body = world_.bodies[static_cast<std::size_t>(pair.body)];
  pair.resting = true;
  resting_.push_back({index, body.offset, normal, point, normal});
  use_law();
}

int Motion::end_rest(int resting, double t) {
  const int index = resting_[static_cast<std::size_t>(resting)].pair;
  Pair& pair = pairs_[static_cast<std::size_t>(index)];
  pair.resting = false;
  pair.known_at = t;  // until then it was in contact all the time
  resting_.erase(resting_.begin() + resting);
  use_law();
  return index;
}

Eigen::VectorXd Motion::state(double t) const {
  Eigen::VectorXd q = t == segment_.t1() ? end_state_ : segment_.state(t);
  rotations_.settle(t, q);
  return q;
}

Eigen::VectorXd Motion::rate(double t, const Eigen::VectorXd& q) const {
  Eigen::VectorXd dq(q.size());
  system_->rate(t, q.data(), dq.data());
  return dq;
}

Support Motion::support(int offset) const {
  std::vector<Vector3> normals;
  for (const RestingContact& contact : resting_)
    if (contact.offset == offset) normals.push_back(contact.normal);
  return trajet::support(normals);
}

Vector3 Motion::free_acceleration(int offset, double t, const Eigen::VectorXd& q) const {
  Eigen::VectorXd dq(q.size());
  Evaluator<double>(group().law)(t, q.data(), dq.data());
  return dq.segment<3>(offset + 3);
}

StepStatistics Motion::statistics() const {
  StepStatistics sum = finished_steppers_;
  sum.steps += stepper_->statistics().steps;
  sum.rejected_steps += stepper_->statistics().rejected_steps;
  sum.law_evaluations += stepper_->statistics().law_evaluations;
  sum.proposed_step = stepper_->statistics().proposed_step;
  return sum;
}

std::vector<std::string> Motion::warnings() const {
  std::vector<std::string> all = finished_warnings_;
  std::ranges::copy(stepper_->warnings(), std::back_inserter(all));
  return all;
}

}  // namespace trajet
