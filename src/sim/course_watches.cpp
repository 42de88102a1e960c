#include "course_watches.hpp"

#include <cmath>
#include <cstddef>

#include "trajet/portable.hpp"

namespace trajet {
namespace {

Crossing::Kind kind_of(ContactEnd end) {
  if (end == ContactEnd::pull) return Crossing::Kind::pull;
  return end == ContactEnd::past_edge ? Crossing::Kind::past_edge : Crossing::Kind::mode;
}

/// Whether a motion at a contact ends.
bool is_stop(ContactEnd end) {
  return end == ContactEnd::slip_stops || end == ContactEnd::roll_stops || end == ContactEnd::spin_stops ||
         end == ContactEnd::one_stops;
}

}  // namespace

CourseWatches::CourseWatches(const World& world, int group, const HeldCourseLaw& law)
    : world_(world), group_(group), law_(law) {
  for (const int event : this->group().events) {
    const World::Event& definition = world.events[static_cast<std::size_t>(event)];
    watches_.push_back({Crossing::Kind::event, event, EventWatch(definition.when, definition.direction)});
  }
}

void CourseWatches::watch_holders() {
  std::erase_if(watches_, [](const Watch& watch) { return watch.kind != Crossing::Kind::event; });
  watch_contacts();
  watch_holds();
}

void CourseWatches::watch_contacts() {
  const std::vector<RestingContact>& contacts = law_.contacts();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!are_plain(contacts, contacts[i].body)) continue;
    const Shape& shape = world_.obstacles[static_cast<std::size_t>(contacts[i].obstacle)].shape;
    const ReleaseConditions conditions =
        release_conditions(group().law, shape, contacts[i], support_of(contacts, contacts[i].offset).blocked);
    const auto watch = [&](ContactEnd end, const Program& condition) {
      watches_.push_back({kind_of(end), static_cast<int>(i), EventWatch(condition, CrossingDirection::rising), end});
    };
    watch(ContactEnd::pull, conditions.pull);
    for (const Program& condition : conditions.past_edges) watch(ContactEnd::past_edge, condition);
  }
  for (const ContactEndCondition& end : law_.ends())
    watches_.push_back(
        {kind_of(end.end), end.contact, EventWatch(end.program, CrossingDirection::rising), end.end, end.detail});
}

void CourseWatches::watch_holds() {
  const std::vector<EventHold>& holds = law_.holds();
  for (std::size_t i = 0; i < holds.size(); ++i) {
    std::vector<EventHold> others = holds;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const EventHold& hold = holds[i];
    const Program& when = world_.events[static_cast<std::size_t>(hold.event)].when;
    const Program pull = hold_on_border(law_.with(law_.contacts(), others), when, hold.direction)->pull;
    const auto away = hold.side > 0 ? CrossingDirection::rising : CrossingDirection::falling;
    watches_.push_back({Crossing::Kind::let_go, static_cast<int>(i), EventWatch(pull, away)});
  }
}

void CourseWatches::search(const Segment<>& segment) {
  // the motion does not go on behind the first end of what holds it, where forces may have no enclosure any more: ends
  // that show in the velocities alone are found first
  double until = segment.t1();
  const double direction = segment.t1() < segment.t0() ? -1.0 : 1.0;
  const auto search = [&](Watch& watch) {
    watch.watch.search(segment, segment.t0(), until);
    const EventWatch::Crossing& found = watch.watch.next();
    if (watch.kind == Crossing::Kind::event || !found.found) return;
    constexpr double kTied = 4.0;  // error bounds: what cannot be told apart from it in time
    const double end = found.time + direction * kTied * found.error_bound;
    if (direction * (until - end) > 0.0) until = end;
  };
  for (Watch& watch : watches_)
    if (is_stop(watch.end) && !is_asleep(watch)) search(watch);
  for (Watch& watch : watches_)
    if (!is_stop(watch.end) && !is_asleep(watch)) search(watch);
}

Crossing CourseWatches::next(const Segment<>& segment) const {
  Crossing next{segment.t1()};
  const double direction = segment.t1() < segment.t0() ? -1.0 : 1.0;
  const Watch* first = nullptr;
  for (const Watch& watch : watches_) {
    if (!watch.watch.next().found || is_asleep(watch)) continue;
    const double ahead = direction * (next.time - watch.watch.next().time);
    if (ahead < 0.0 || (ahead == 0.0 && first != nullptr)) continue;
    first = &watch;
    next = {watch.watch.next().time, watch.kind, watch.index, watch.watch.next().error_bound, watch.end, watch.detail};
  }
  if (first == nullptr) return next;
  // of what cannot be told apart in time, the one that stands first is the next
  const auto is_now = [&](const Watch& watch) {
    const EventWatch::Crossing& other = watch.watch.next();
    return other.found && std::abs(other.time - next.time) <= other.error_bound + first->watch.next().error_bound;
  };
  const Watch& now = *ranges::find_if(watches_, is_now);
  next.kind = now.kind;
  next.index = now.index;
  next.end = now.end;
  next.detail = now.detail;
  return next;
}

std::size_t CourseWatches::place_of(int event) const {
  return static_cast<std::size_t>(ranges::find(group().events, event) - group().events.begin());
}

void CourseWatches::turn_event(int event, double t, const Eigen::VectorXd& before, const Eigen::VectorXd& rate_before,
                               const Eigen::VectorXd& behind, const Eigen::VectorXd& rate_behind) {
  watches_[place_of(event)].watch.turn(t, before.data(), rate_before.data(), behind.data(), rate_behind.data());
}

void CourseWatches::pass_event(int event, const Segment<>& segment) {
  EventWatch& passed = watches_[place_of(event)].watch;
  const double time = passed.next().time;
  passed.pass();
  passed.search(segment, time);
}

void CourseWatches::stand_on(int event, double t, const Eigen::VectorXd& q, int side) {
  watches_[place_of(event)].watch.stand_on(t, q.data(), side);
}

void CourseWatches::jump(double t, const Eigen::VectorXd& before, const Eigen::VectorXd& behind,
                         const Segment<>& segment, bool are_held_anew) {
  if (watches_.empty()) return;
  // of the jump, and of the state that the motion has at a rounded time
  constexpr double kRoundings = 8.0;
  const double time = std::abs(t) + std::abs(t - segment.t0());
  Eigen::VectorXd rounding(behind.size());
  for (int i = 0; i < rounding.size(); ++i) {
    const double change = time * std::abs(segment.derivative(i, t));
    rounding[i] = kRoundings * kUnitRoundoff * (std::abs(before[i]) + std::abs(behind[i]) + change);
  }
  for (Watch& watch : watches_) {
    const bool begins = are_held_anew && watch.kind != Crossing::Kind::event;
    watch.watch.restart(t, begins ? behind.data() : before.data(), behind.data(), rounding.data());
  }
}

void CourseWatches::forget_edges(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& rate_before,
                                 const Eigen::VectorXd& rate_behind) {
  for (Watch& watch : watches_)
    if (watch.kind == Crossing::Kind::past_edge)
      watch.watch.forget_unless_rising(t, q.data(), rate_before.data(), rate_behind.data());
}

}  // namespace trajet
