#include "contact_group.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>
#include <tuple>
#include <variant>

#include "body_bounce.hpp"
#include "impact_sides.hpp"
#include "solid_contact.hpp"
#include "ties.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// So near, of the size of what meets, a contact is at the instant of another if its bounds let it be.
constexpr double kNear = 1e-9;
/// Bodies touch whose distance is not more than so many roundings of their places.
constexpr double kTouching = 64.0;

class Collector {
 public:
  Collector(const RunControl& run, const GroupedContact& seed) : run_(run), seed_(seed), t_(seed.contact.time) {
    add(seed);
  }

  std::vector<GroupedContact> run() {
    while (!waiting_.empty()) {
      const int body = waiting_.front();
      waiting_.pop_front();
      add_obstacles(body);
      for (const int other : run_.meetings().others(body)) add_body(std::minmax(body, other));
    }
    return std::move(found_);
  }

 private:
  using Key = std::tuple<int, int, int>;

  const World& world() const { return run_.world(); }
  const World::Body& body(int index) const { return world().bodies[static_cast<std::size_t>(index)]; }
  Vector3 position(int index) const {
    return body(index).slice().position(run_.course(run_.course_of(index)).state(t_));
  }
  bool sticks(int index) const {
    return sticking_contact(run_.course(run_.course_of(index)).held_law().contacts(), index) != nullptr;
  }
  double size(int index) const { return bounding_radius(body(index).solid); }

  void add(const GroupedContact& contact) {
    if (!known_.insert(Key{contact.first, contact.second, contact.obstacle}).second) return;
    found_.push_back(contact);
    const bool is_of_round =
        is_round(body(contact.first).solid) && (contact.second < 0 || is_round(body(contact.second).solid));
    if (const auto& touched = contact.contact.touched; touched && !is_of_round)
      found_.back().points = touched->points.empty() ? std::vector{contact.contact.point} : touched->points;
    for (const int each : {contact.first, contact.second})
      if (each >= 0 && reached_.insert(each).second) waiting_.push_back(each);
  }

  /// A point at the origin has no size: what its times cannot be told apart by is near too.
  bool is_near(const ContactResult& contact, double extent) const {
    const double apart = std::abs(contact.time - t_);
    return apart * std::abs(contact.gap_rate) <= kNear * extent ||
           apart <= contact.time_resolution + seed_.contact.time_resolution;
  }
  bool is_at_once(const ContactResult& contact) const {
    return std::abs(contact.time - t_) <= contact.time_error_bound + seed_.contact.time_error_bound;
  }

  void add_obstacles(int index) {
    const World::Body& one = body(index);
    Course& course = run_.course(run_.course_of(index));
    if (sticks(index)) return;
    for (const Pair& pair : run_.encounters().pairs(index)) {
      const Surface& surface = world().surface(index, pair.id.obstacle);
      if (surface.on_hit != OnHit::bounce || !why_it_cannot_bounce(one, surface).empty()) continue;
      if (is_hit(pair.contact) && is_near(pair.contact, size(index) + position(index).norm())) {
        run_.encounters().bound_times(index, course);
        if (is_at_once(pair.contact)) {
          add({.first = index,
               .obstacle = pair.id.obstacle,
               .contact = pair.contact,
               .surface = surface,
               .is_met = true});
          continue;
        }
      }
      if (is_round(one.solid)) add_touching(pair, surface);
    }
    for (const RestingContact& resting : course.held_law().contacts()) {
      if (resting.body != index) continue;
      GroupedContact lasting{.first = index,
                             .obstacle = resting.obstacle,
                             .surface = world().surface(index, resting.obstacle),
                             .is_lasting = true};
      lasting.contact = touching(resting.normal, position(index) - size(index) * resting.normal, position(index));
      if (resting.core) {
        lasting.contact.point = resting.point;
        lasting.contact.touched = {Feature::vertex, Feature::face, {}};
        const Eigen::VectorXd q = course.state(t_);
        const std::vector<Vector3> places =
            places_of_corners(world(), resting, run_.encounters().frame(resting.obstacle, t_), q);
        for (const int corner : resting.corners)
          lasting.contact.touched->points.push_back(places[static_cast<std::size_t>(corner)]);
      }
      add(lasting);
    }
  }

  void add_touching(const Pair& pair, const Surface& surface) {
    const double radius = size(pair.id.body);
    if (pair.is_lasting || radius == 0.0) return;
    const World::Obstacle& obstacle = world().obstacles[static_cast<std::size_t>(pair.id.obstacle)];
    const std::optional<FrameMotion> frame = run_.encounters().frame(pair.id.obstacle, t_);
    const Vector3 center = position(pair.id.body);
    const Vector3 place = frame ? frame->to_start(center) : center;
    const Vector3 closest = std::visit([&](const auto& shape) { return closest_point(shape, place); }, obstacle.shape);
    const Vector3 arm = frame ? Vector3(frame->R * (place - closest)) : Vector3(place - closest);
    const double rounding = kTouching * kUnitRoundoff * (place.norm() + closest.norm() + radius);
    if (std::abs(arm.norm() - radius) > rounding) return;
    const Vector3 normal = arm.stableNormalized();
    GroupedContact contact{.first = pair.id.body, .obstacle = pair.id.obstacle, .surface = surface};
    contact.contact = touching(normal, center - radius * normal, center);
    contact.contact.memory.tolerance = rounding;
    if (pair.memory.side != 0) contact.contact.side_before = pair.memory.side;
    contact.contact.memory.side = -contact.contact.side_before;
    add(contact);
  }

  /// A contact that is there now, whatever follows.
  ContactResult touching(const Vector3& normal, const Vector3& point, const Vector3& center) const {
    ContactResult contact;
    contact.status = ContactStatus::hit;
    contact.time = t_;
    contact.point = point;
    contact.normal = normal;
    contact.time_error_bound = seed_.contact.time_error_bound;
    contact.position = center;
    contact.side_before = 1;
    contact.memory.side = -1;
    contact.memory.contact_time = t_;
    return contact;
  }

  void add_body(const Meeting::Id& id) {
    const World::Body &a = body(id.first), &b = body(id.second);
    const Surface surface = world().surface_of_bodies(id.first, id.second);
    const auto can_bounce = [&](int index) {
      return sticks(index) || (body(index).mass && why_it_cannot_bounce(body(index), surface).empty());
    };
    if (surface.on_hit != OnHit::bounce || !can_bounce(id.first) || !can_bounce(id.second) ||
        (sticks(id.first) && sticks(id.second)))
      return;
    Meeting meeting = run_.meetings().meeting(id);
    ContactResult& contact = meeting.contact;
    const bool is_hit = contact.status == ContactStatus::hit && contact.direction != ContactDirection::leaving;
    if (is_hit && is_near(contact, size(id.first) + size(id.second))) {
      Course &first = run_.course(run_.course_of(id.first)), &second = run_.course(run_.course_of(id.second));
      contact.time_error_bound =
          contact.time_resolution + contact.time_error(gap_error(world(), meeting, first, second));
      if (is_at_once(contact))
        return add({.first = id.first, .second = id.second, .contact = contact, .surface = surface, .is_met = true});
    }
    if (!is_round(a.solid) || !is_round(b.solid)) return;
    const Vector3 from = position(id.second), to = position(id.first);
    const double apart = size(id.first) + size(id.second);
    const double rounding = kTouching * kUnitRoundoff * (from.norm() + to.norm() + apart);
    if (std::abs((to - from).norm() - apart) > rounding) return;
    const Vector3 normal = (to - from).stableNormalized();
    GroupedContact touched{.first = id.first, .second = id.second, .surface = surface};
    touched.contact = touching(normal, from + size(id.second) * normal, to);
    touched.contact.memory.tolerance = rounding;
    add(touched);
  }

  const RunControl& run_;
  const GroupedContact& seed_;
  double t_;
  std::vector<GroupedContact> found_;
  std::set<Key> known_;
  std::set<int> reached_;
  std::deque<int> waiting_;  // bodies
};

}  // namespace

std::vector<GroupedContact> contacts_at_once(const RunControl& run, const GroupedContact& seed) {
  std::vector<GroupedContact> found = Collector(run, seed).run();
  std::sort(found.begin() + 1, found.end(), [](const GroupedContact& a, const GroupedContact& b) {
    return std::tie(a.first, a.second, a.obstacle) < std::tie(b.first, b.second, b.obstacle);
  });
  return found;
}

}  // namespace trajet
