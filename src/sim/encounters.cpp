#include "encounters.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "corner_search.hpp"
#include "last_contact.hpp"
#include "solid_bounce.hpp"
#include "swept_box.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/event/path.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// So many obstacles are searched one by one; a piece of a Segment is as long as it meets no more.
constexpr std::size_t kFew = 8;

}  // namespace

Encounters::Encounters(const World& world, SolidSearch& solids)
    : world_(world), bodies_(world.bodies.size()), solids_(solids), is_stuck_(world.bodies.size()) {
  // the course's 3.1 and 3.2 know whole steps only
  const bool walks = world.obstacles.size() > kFew && world.locate == Locator::polynomial;
  const auto box = [&](int index) {
    const World::Obstacle& obstacle = world.obstacles[static_cast<std::size_t>(index)];
    const bool is_still = walks && !obstacle.drive;
    return is_still ? bounds(obstacle.solid, obstacle.p_WB, rotation_matrix(obstacle.q_WB)) : unbounded_box();
  };
  for (int i = 0; i < static_cast<int>(world.obstacles.size()); ++i) {
    const World::Obstacle& obstacle = world.obstacles[static_cast<std::size_t>(i)];
    if (obstacle.drive) driven_.try_emplace(i, obstacle);
    (is_bounded(box(i)) ? in_tree_ : always_).push_back(i);
  }
  if (!in_tree_.empty())
    tree_.emplace(static_cast<int>(in_tree_.size()), [&](int i) { return box(in_tree_[static_cast<std::size_t>(i)]); });
}

Pair& Encounters::pair(PairId id) { return *ranges::find(around(id.body).pairs, id, &Pair::id); }

Pair& Encounters::find_or_add(int body, int obstacle, double t) {
  std::vector<Pair>& pairs = around(body).pairs;
  const PairId id{body, obstacle};
  const auto found = ranges::find(pairs, id, &Pair::id);
  return found != pairs.end() ? *found : pairs.emplace_back(Pair{.id = id, .known_at = t, .searched_to = t});
}

ContactResult Encounters::first_contact_until(const Pair& pair, const ContactMemory& memory, const Course& course,
                                              double from, double to) {
  if (pair.is_lasting) return {};
  if (is_stuck_[static_cast<std::size_t>(pair.id.body)]) {
    const OnHit on_hit = world_.surface(pair.id.body, pair.id.obstacle).on_hit;
    if (on_hit == OnHit::bounce || on_hit == OnHit::stick) return {};
  }
  ++searches_;
  const World::Body& body = world_.bodies[static_cast<std::size_t>(pair.id.body)];
  const World::Obstacle& obstacle = world_.obstacles[static_cast<std::size_t>(pair.id.obstacle)];
  const auto driven = driven_.find(pair.id.obstacle);
  if (world_.locate != Locator::polynomial && driven == driven_.end() && has_corners(body.solid))
    return first_corner_contact(body, obstacle, course.segment(), from, to, world_.locate, memory);
  if (!is_round(body.solid))
    return solids_.first_contact(pair.id.body, pair.id.obstacle, course.segment(),
                                 driven != driven_.end() ? &driven->second : nullptr, from, to, memory);
  if (driven != driven_.end())
    return driven->second.first_contact(course.segment(), body.offset, bounding_radius(body.solid), from, to,
                                        world_.locate, memory);
  const PointPath path(course.segment(), body.offset);
  return first_contact(obstacle.shape, {path, bounding_radius(body.solid), from, to, world_.locate}, memory);
}

void Encounters::search_whole(Pair& pair, const Course& course) {
  const double end = course.segment().t1();
  pair.contact = first_contact_until(pair, pair.memory, course, pair.known_at, end);
  pair.ahead = pair.contact.memory;
  pair.searched_to = end;
}

std::optional<std::vector<int>> Encounters::near(const Aabb& swept, std::size_t most) const {
  std::vector<int> found;
  const bool are_few = tree_->visit_overlapping(swept, [&](int index) {
    found.push_back(in_tree_[static_cast<std::size_t>(index)]);
    return found.size() <= most;
  });
  if (!are_few) return std::nullopt;
  return found;
}

std::size_t Encounters::count_near(const Aabb& swept) const {
  std::size_t count = 0;
  tree_->visit_overlapping(swept, [&count](int) {
    ++count;
    return true;
  });
  return count;
}

void Encounters::follow(int body, const Course& course, double until) {
  Around& around = this->around(body);
  const double start = course.segment().t0();
  around.searched_to = start;
  for (Pair& pair : around.pairs) {
    pair.contact = {};
    pair.ahead = pair.memory;
    pair.searched_to = start;
  }
  for (const int obstacle : always_)
    if (world_.meets_obstacle(body, obstacle)) search_whole(find_or_add(body, obstacle, start), course);
  search(body, course, until);
}

void Encounters::search(int body, const Course& course, double until) {
  if (!tree_) return;
  const World::Body& moving = world_.bodies[static_cast<std::size_t>(body)];
  Around& around = this->around(body);
  while (around.searched_to < until) {
    const double from = around.searched_to;
    double to = course.segment().t1();
    if (const Pair* met = first(body)) {
      // what meets the body at the same time to rounding belongs to the same instant
      constexpr double kResolutions = 16.0;
      const double last = met->contact.time + kResolutions * met->contact.time_resolution;
      if (from >= last) return;
      to = std::min(to, last);
    }
    if (around.stride > 0.0) to = std::min(to, from + 2.0 * around.stride);
    std::optional<std::vector<int>> candidates = near(swept_box(moving, course.segment(), from, to), kFew);
    // in boxes where it is already, however short the piece
    const std::size_t start_count = candidates ? 0 : count_near(swept_box(moving, course.segment(), from, from));
    const std::size_t most = start_count > kFew ? start_count + kFew : kFew;
    if (most > kFew) candidates = near(swept_box(moving, course.segment(), from, to), most);
    while (!candidates) {
      const double middle = from + 0.5 * (to - from);
      constexpr double kShortest = 1e-12;  // of the time: no shorter piece meets less
      const bool is_shortest = middle - from <= kShortest * std::abs(from) || middle == from;
      if (!is_shortest) to = middle;
      candidates = near(swept_box(moving, course.segment(), from, to), is_shortest ? in_tree_.size() : most);
    }
    around.stride = to - from;
    ranges::sort(*candidates);
    std::erase_if(*candidates, [&](int obstacle) { return !world_.meets_obstacle(body, obstacle); });
    // what is far away now is not known of when it is met again
    std::erase_if(around.pairs, [&](const Pair& pair) {
      return !pair.is_lasting && !ranges::binary_search(*candidates, pair.id.obstacle) &&
             ranges::binary_search(in_tree_, pair.id.obstacle);
    });
    for (const int obstacle : *candidates) {
      Pair& pair = find_or_add(body, obstacle, from);
      pair.contact = first_contact_until(pair, pair.ahead, course, from, to);
      pair.ahead = pair.contact.memory;
      pair.searched_to = to;
    }
    around.searched_to = to;
  }
}

void Encounters::keep(int body, const Course& course, double t) {
  std::vector<Pair>& pairs = around(body).pairs;
  std::erase_if(pairs, [&](const Pair& pair) { return pair.known_at > t; });
  for (Pair& pair : pairs) {
    if (pair.known_at == t) continue;
    const bool is_known = t == pair.searched_to || (t > pair.searched_to && !pair.is_lasting);
    const ContactResult contact =
        is_known ? pair.contact : first_contact_until(pair, pair.memory, course, pair.known_at, t);
    const bool is_met = contact.status == ContactStatus::hit || contact.status == ContactStatus::graze;
    if (contact.status == ContactStatus::separated && !pair.is_lasting) pair.memory = contact.memory;
    // a contact right at t, where another pair's was handled first, is still to come
    if (is_met) pair.memory = {.side = contact.side_before, .is_in_plane = contact.memory.is_in_plane};
    pair.known_at = t;
  }
}

void Encounters::bound_times(int body, Course& course) {
  const int offset = world_.bodies[static_cast<std::size_t>(body)].offset;
  for (Pair& pair : around(body).pairs) {
    ContactResult& contact = pair.contact;
    if (contact.status != ContactStatus::hit && contact.status != ContactStatus::graze) continue;
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(course.segment().dimension());
    direction.segment<3>(offset) = contact.normal;
    if (contact.touched) direction = gap_gradient(world_, pair, course.state(contact.time));
    contact.time_error_bound =
        contact.time_resolution + contact.time_error(course.error_bound_along(direction, contact.time));
  }
}

const Pair* Encounters::first(int body) const {
  const Pair* first = nullptr;
  for (const Pair& pair : pairs(body)) {
    if (pair.contact.status == ContactStatus::separated) continue;
    if (first == nullptr || pair.contact.time < first->contact.time) first = &pair;
  }
  return first;
}

std::vector<PairId> Encounters::met_at_once(const Pair& handled) const {
  std::vector<PairId> met;
  for (const Pair& other : pairs(handled.id.body)) {
    if (other.id == handled.id || other.contact.status != ContactStatus::hit) continue;
    const double resolution = handled.contact.time_resolution + other.contact.time_resolution;
    if (std::abs(other.contact.time - handled.contact.time) <= resolution) met.push_back(other.id);
  }
  return met;
}

void Encounters::pass(PairId id, const Course& course) {
  Pair& passed = pair(id);
  const double end = passed.searched_to;
  passed.memory = passed.contact.memory;
  passed.known_at = passed.contact.time;
  passed.contact = first_contact_until(passed, passed.memory, course, passed.known_at, end);
  passed.ahead = passed.contact.memory;
}

bool Encounters::stay_in_contact(PairId id, const Course& course, double height) {
  Pair& touched = pair(id);
  const double time = touched.contact.time;
  const std::optional<ContactMemory> memory = memory_of_last_contact(touched.contact, touched.memory, height);
  if (!memory) return false;
  touched.memory = *memory;
  touched.known_at = time;
  touched.contact = first_contact_until(touched, *memory, course, time, touched.searched_to);
  touched.ahead = touched.contact.memory;
  return true;
}

void Encounters::take(const Instant& instant) {
  for (const int body : instant.course().group().bodies) {
    is_stuck_[static_cast<std::size_t>(body)] = sticking_contact(instant.contacts, body) != nullptr;
    for (Pair& pair : around(body).pairs) {
      pair.is_lasting = false;
      pair.contact = {};
    }
  }
  for (const RestingContact& contact : instant.contacts)
    find_or_add(contact.body, contact.obstacle, instant.time()).is_lasting = true;
  for (const auto& [id, memory] : instant.memories) find_or_add(id.body, id.obstacle, instant.time()).memory = memory;
}

std::optional<FrameMotion> Encounters::frame(int obstacle, double t) {
  const auto driven = driven_.find(obstacle);
  if (driven == driven_.end()) return std::nullopt;
  return driven->second.at(t);
}

RelativeMotion Encounters::relative_motion(PairId id, double t, const Eigen::VectorXd& q, const Eigen::VectorXd& rate) {
  const int offset = world_.bodies[static_cast<std::size_t>(id.body)].offset;
  RelativeMotion motion{rate.segment<3>(offset), rate.segment<3>(offset + 3)};
  const std::optional<FrameMotion> surface = frame(id.obstacle, t);
  if (!surface) return motion;
  // in a frame that turns: a - a_o - w' x r - w x (w x r) - 2 w x v
  const Vector3 arm = q.segment<3>(offset) - surface->p;
  const Vector3& w = surface->w;
  motion.velocity -= surface->velocity_at(q.segment<3>(offset));
  motion.acceleration -=
      surface->acceleration + surface->w_rate.cross(arm) + w.cross(w.cross(arm)) + 2.0 * w.cross(motion.velocity);
  return motion;
}

void Encounters::move(int body, double t, const Vector3& jump_from, const Vector3& jump_to) {
  for (Pair& pair : around(body).pairs) {
    const Shape& shape = world_.obstacles[static_cast<std::size_t>(pair.id.obstacle)].shape;
    const std::optional<FrameMotion> driven = frame(pair.id.obstacle, t);
    const Vector3 from = driven ? driven->to_start(jump_from) : jump_from;
    const Vector3 to = driven ? driven->to_start(jump_to) : jump_to;
    const Vector3 closest = std::visit([&](const auto& s) { return closest_point(s, from); }, shape);
    const Vector3 closest_behind = std::visit([&](const auto& s) { return closest_point(s, to); }, shape);
    // along a flat face: it is where it was, a contact that is to come still comes
    const double rounding = 16.0 * kUnitRoundoff * (from.norm() + to.norm() + closest.norm() + closest_behind.norm());
    if (((to - closest_behind) - (from - closest)).norm() > rounding) pair.memory = {};
  }
}

}  // namespace trajet
