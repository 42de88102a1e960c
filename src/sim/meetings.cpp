#include "meetings.hpp"

#include <algorithm>
#include <cmath>

#include "ball_meeting.hpp"
#include "last_contact.hpp"
#include "swept_box.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// A window is as long as it meets no more than that, or than so many more as it begins among.
constexpr std::size_t kFew = 8;

/// Whether two bodies may meet at all: the cheap part of the answer.
bool may_meet(const World& world) {
  const auto lets_bodies = [](const World::Body& body) {
    return body.company.has_all_bodies || !body.company.bodies.empty();
  };
  return ranges::count_if(world.bodies, lets_bodies) > 1 &&
         ranges::any_of(world.bodies, [](const World::Body& body) { return bounding_radius(body.solid) > 0.0; });
}

}  // namespace

Meetings::Meetings(const World& world, const Recorder::Courses& courses, SolidSearch& solids)
    : world_(world),
      courses_(courses),
      solids_(solids),
      direction_(world.direction()),
      is_possible_(may_meet(world)),
      // the course's 3.1 and 3.2 know whole steps only
      has_windows_(world.bodies.size() > kFew + 1 && world.locate == Locator::polynomial),
      windows_(world.bodies.size()) {
  if (!is_possible_ || !has_windows_) return;
  // where all are at the start: so long as some have not moved, the others know how near they are
  for (int index = 0; index < static_cast<int>(windows_.size()); ++index) {
    Window& window = this->window(index);
    const Segment<>& segment = course_of(index).segment();
    window.box = swept_box(body(index), segment, segment.t0(), segment.t0());
    window.is_open = true;
    boxes_.insert(index, window.box);
  }
}

const Course& Meetings::course_of(int index) const { return *courses_[static_cast<std::size_t>(body(index).group)]; }

void Meetings::follow(int body, double until) {
  if (is_possible_) look_on(body, course_of(body).segment().t0(), until);
}

void Meetings::look_on(int index, double from, double until) {
  close(index);
  const Segment<>& segment = course_of(index).segment();
  Window& window = this->window(index);
  double to = segment.t1();
  std::optional<std::vector<int>> others;
  if (has_windows_) {
    if (direction_ * (until - from) > 0.0 && direction_ * (to - until) > 0.0) to = until;
    if (window.stride > 0.0) to = direction_ * std::min(direction_ * to, direction_ * from + 2.0 * window.stride);
    const auto box_until = [&](double end) { return swept_box(body(index), segment, from, end); };
    window.box = box_until(to);
    others = near(index, window.box, kFew);
    // more than it is among already, however short the window
    const std::size_t most = others ? kFew : near(index, box_until(from), world_.bodies.size())->size() + kFew;
    while (!others) {
      constexpr double kShortest = 1e-12;  // of the time: no shorter window meets less
      const double middle = from + 0.5 * (to - from);
      const bool is_shortest = std::abs(middle - from) <= kShortest * std::abs(from) || middle == from;
      if (!is_shortest) to = middle;
      window.box = box_until(to);
      others = near(index, window.box, is_shortest ? world_.bodies.size() : most);
    }
    window.stride = std::abs(to - from);
    boxes_.insert(index, window.box);
  } else {
    others.emplace();
    for (int other = 0; other < static_cast<int>(windows_.size()); ++other)
      if (other != index && this->window(other).is_open && world_.bodies_meet(index, other)) others->push_back(other);
  }
  window.from = from;
  window.to = to;
  window.is_open = true;
  std::erase_if(window.others, [&](int left) {
    const bool is_far = this->window(left).is_open && !ranges::binary_search(*others, left);
    if (is_far) part(index, left);
    return is_far;
  });
  for (const int other : *others) add_other(index, other);
  for (const int other : *others) {
    add_other(other, index);
    const Meeting::Id id = std::minmax(index, other);
    search(meetings_.try_emplace(id, Meeting{.id = id, .known_at = from}).first->second, from);
    changed_.push_back(other);
  }
}

std::optional<std::vector<int>> Meetings::near(int index, const Aabb& box, std::size_t most) const {
  std::vector<int> found;
  boxes_.visit_overlapping(box, [&](int other) {
    if (world_.bodies_meet(index, other)) found.push_back(other);
    return found.size() <= most;
  });
  if (found.size() > most) return std::nullopt;
  ranges::sort(found);
  return found;
}

void Meetings::keep(Meeting& meeting, double t) {
  if (t == meeting.known_at) return;
  // what is on its way has not happened: they are on the side from which it would come
  const bool is_met = meeting.contact.status == ContactStatus::hit || meeting.contact.status == ContactStatus::graze;
  if (is_met) meeting.memory = {.side = meeting.contact.side_before};
  if (meeting.contact.status == ContactStatus::separated) meeting.memory = meeting.contact.memory;
  meeting.known_at = t;
}

void Meetings::search(Meeting& meeting, double from) {
  keep(meeting, from);
  const auto [first, second] = meeting.id;
  const double to = direction_ * std::min(direction_ * window(first).to, direction_ * window(second).to);
  ++searches_;
  const Segment<>&a = course_of(first).segment(), &b = course_of(second).segment();
  const bool are_round = is_round(body(first).solid) && is_round(body(second).solid);
  meeting.contact =
      are_round ? first_contact_of_balls(body(first), a, body(second), b, {from, to}, world_.locate, meeting.memory)
                : solids_.first_contact_of_bodies(first, a, second, b, from, to, meeting.memory);
}

void Meetings::add_other(int index, int other) {
  std::vector<int>& others = window(index).others;
  const auto place = ranges::lower_bound(others, other);
  if (place == others.end() || *place != other) others.insert(place, other);
}

void Meetings::part(int index, int other) {
  std::erase(window(other).others, index);
  meetings_.erase(std::minmax(index, other));
}

void Meetings::close(int index) {
  Window& window = this->window(index);
  if (window.is_open && has_windows_) boxes_.remove(index, window.box);
  window.is_open = false;
}

std::optional<double> Meetings::looked_to(int index) const {
  const Window& window = this->window(index);
  if (!window.is_open || window.to == course_of(index).segment().t1()) return std::nullopt;
  return window.to;
}

void Meetings::leave(int index, double t) {
  close(index);
  for (const int other : window(index).others) {
    Meeting& meeting = meetings_.find(std::minmax(index, other))->second;
    keep(meeting, t);
    meeting.contact = {.memory = meeting.memory};
    changed_.push_back(other);
  }
}

void Meetings::forget(int index) {
  for (const int other : window(index).others) {
    Meeting& meeting = meetings_.find(std::minmax(index, other))->second;
    meeting.memory = {};
    meeting.contact = {};
  }
}

const Meeting* Meetings::first(int index) const {
  const Meeting* first = nullptr;
  for (const int other : window(index).others) {
    const Meeting& meeting = meetings_.find(std::minmax(index, other))->second;
    if (meeting.contact.status == ContactStatus::separated) continue;
    if (first == nullptr || direction_ * (meeting.contact.time - first->contact.time) < 0.0) first = &meeting;
  }
  return first;
}

std::vector<Meeting::Id> Meetings::met_at_once(const Meeting& meeting) const {
  std::vector<Meeting::Id> met;
  for (const int index : {meeting.id.first, meeting.id.second})
    for (const int other : window(index).others) {
      const Meeting& each = meetings_.find(std::minmax(index, other))->second;
      if (each.id == meeting.id || each.contact.status != ContactStatus::hit) continue;
      const double resolution = meeting.contact.time_resolution + each.contact.time_resolution;
      if (std::abs(each.contact.time - meeting.contact.time) <= resolution) met.push_back(each.id);
    }
  return met;
}

std::vector<int> Meetings::take_changed() {
  std::vector<int> groups;
  for (const int index : changed_) groups.push_back(body(index).group);
  changed_.clear();
  ranges::sort(groups);
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  return groups;
}

void Meetings::pass(const Meeting::Id& id) {
  Meeting& meeting = meetings_.find(id)->second;
  meeting.memory = meeting.contact.memory;
  meeting.known_at = meeting.contact.time;
  search(meeting, meeting.known_at);
  changed_.insert(changed_.end(), {id.first, id.second});
}

void Meetings::remember(const Meeting::Id& id, const ContactMemory& memory) {
  meetings_.find(id)->second.memory = memory;
}

bool Meetings::stay_in_contact(const Meeting::Id& id, double height) {
  Meeting& meeting = meetings_.find(id)->second;
  const std::optional<ContactMemory> memory = memory_of_last_contact(meeting.contact, meeting.memory, height);
  if (memory) go_on(meeting, *memory);
  return memory.has_value();
}

bool Meetings::stay_in_touch(const Meeting::Id& id, double tolerance) {
  Meeting& meeting = meetings_.find(id)->second;
  ContactMemory memory = rebounded(meeting.contact.memory);
  memory.contact_time = meeting.contact.time;
  memory.tolerance = std::max(memory.tolerance, tolerance);
  if (meeting.memory.contact_time == memory.contact_time && meeting.memory.tolerance >= memory.tolerance) return false;
  go_on(meeting, memory);
  return true;
}

void Meetings::go_on(Meeting& meeting, const ContactMemory& memory) {
  const double time = meeting.contact.time;
  meeting.memory = memory;
  meeting.known_at = time;
  search(meeting, time);
  changed_.insert(changed_.end(), {meeting.id.first, meeting.id.second});
}

}  // namespace trajet
