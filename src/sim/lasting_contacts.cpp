#include "lasting_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "body_state.hpp"
#include "impact_record.hpp"
#include "impact_sides.hpp"
#include "round_contact.hpp"
#include "solid_contact.hpp"
#include "sustained.hpp"
#include "trajet/collide/sustain/rest.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/geom/distance.hpp"
#include "trajet/geom/flat_faces.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// A step this high, of the place and the size, is none.
constexpr double kStep = 1e-12;

/// Of a velocity, a part so small is none: far above rounding.
constexpr double kNone = 1e-12;

Vector3 closest_point_of(const Shape& shape, const Vector3& p) {
  return std::visit([&](const auto& s) { return closest_point(s, p); }, shape);
}

}  // namespace

std::optional<RestingContact> LastingContacts::contact_at(const Instant& instant, PairId id, const Vector3& point,
                                                          const Vector3& normal) const {
  const std::optional<FrameMotion> frame = encounters_.frame(id.obstacle, instant.time());
  return is_round(body(id.body).solid) ? round_contact(world_, id, frame, point, normal, instant.q)
                                       : solid_contact(world_, id, frame, point, normal, instant.q);
}

double LastingContacts::pull_on(const Instant& instant, const RestingContact& contact) const {
  const auto terms =
      contact_terms(world_, instant.course().group().law, {contact}, contact.body, instant.time(), instant.q);
  if (!terms) return 0.0;
  const ContactTerms<double>& at = terms->points[0];
  return -(at.normal.dot(at.slip_rate) + at.normal_rate.dot(at.slip));
}

std::string LastingContacts::begin(Instant& instant, RestingContact contact, const Impact& impact, double rest_time) {
  const PairId id{contact.body, contact.obstacle};
  instant.contacts.push_back(std::move(contact));
  keep_kind(id, ImpactKind::rest);
  if (are_plain(instant.contacts, id.body)) instant.stop_blocked_velocity(body(id.body).offset);
  coming_.insert({rest_time, id, impact.time_error_bound});
  return release_by_force(instant, id.body);
}

void LastingContacts::keep_kind(PairId id, ImpactKind kind) { kinds_[{id.body, id.obstacle}] = kind; }

void LastingContacts::release_moving(Instant& instant, int moved) {
  const int offset = body(moved).offset;
  const double rounding =
      64.0 * kUnitRoundoff * (instant.q.segment<3>(offset + 3).norm() + instant.before().segment<3>(offset + 3).norm());
  const std::optional<BodyTerms<double>> terms = ContactSettling(world_, encounters_, instant, moved).look();
  if (!terms) return;
  std::size_t number = terms->points.size(), count = terms->contacts.size();
  for (std::size_t i = instant.contacts.size(); i-- > 0;) {
    const RestingContact contact = instant.contacts[i];
    if (contact.body != moved) continue;
    number -= terms->contacts[static_cast<std::size_t>(--count)].points.size();
    const ContactTerms<double>& at = terms->points[number];
    if (contact.core) continue;  // its corners are looked at one by one
    const double speed = at.normal.dot(at.slip);
    const double pull = -(at.normal.dot(at.slip_rate) + at.normal_rate.dot(at.slip));
    const double tolerance = encounters_.pair({contact.body, contact.obstacle}).memory.tolerance;
    if (std::abs(speed) <= rounding || is_below_flight(speed, std::max(0.0, pull), tolerance)) continue;
    if (speed > 0.0) record(contact, ImpactKind::leave, instant.time(), instant.q);
    release(instant, static_cast<int>(i));
  }
}

std::string LastingContacts::release_by_speed(Instant& instant, int moved) {
  if (sticking_contact(instant.contacts, moved) != nullptr) return "";
  if (!are_plain(instant.contacts, moved)) {
    release_moving(instant, moved);
    return release_by_force(instant, moved);
  }
  const int offset = body(moved).offset;
  const double pull = instant.free_acceleration(offset).norm();
  // of the products of speeds and normals by which the velocity came about, one impact after the other
  const double rounding =
      64.0 * kUnitRoundoff * (instant.q.segment<3>(offset + 3).norm() + instant.before().segment<3>(offset + 3).norm());
  for (std::size_t i = 0; i < instant.contacts.size();) {
    const RestingContact contact = instant.contacts[i];
    const double speed = instant.q.segment<3>(offset + 3).dot(contact.normal);
    const double tolerance = encounters_.pair({contact.body, contact.obstacle}).memory.tolerance;
    if (contact.body != moved || std::abs(speed) <= rounding || is_below_flight(speed, pull, tolerance)) {
      ++i;
      continue;
    }
    if (speed > 0.0) record(contact, ImpactKind::leave, instant.time(), instant.q);
    release(instant, static_cast<int>(i));
  }
  instant.stop_blocked_velocity(offset);
  return "";
}

void LastingContacts::keep_kinds(const ContactSettling& settling, const Instant& instant) {
  for (const auto& [id, kind] : settling.kinds()) {
    const ImpactKind was = kinds_[{id.body, id.obstacle}];
    keep_kind(id, kind);
    const bool is_to_come = ranges::any_of(coming_, [&, id = id](const Coming& each) { return each.id == id; });
    if (kind == was || is_to_come) continue;
    const auto contact = ranges::find_if(instant.contacts, [&, id = id](const RestingContact& each) {
      return PairId{each.body, each.obstacle} == id;
    });
    record(*contact, kind, instant.time(), instant.q);
  }
}

std::string LastingContacts::release_by_force(Instant& instant, int held, const std::vector<EndedMode>& ended) {
  if (sticking_contact(instant.contacts, held) != nullptr) return "";
  if (!are_plain(instant.contacts, held)) {
    ContactSettling settling(world_, encounters_, instant, held);
    const std::string failure = settling.settle(ended, [&](int index) {
      const RestingContact contact = instant.contacts[static_cast<std::size_t>(index)];
      record(contact, ImpactKind::leave, instant.time(), instant.q);
      release(instant, index);
    });
    keep_kinds(settling, instant);
    return failure;
  }
  const int offset = body(held).offset;
  const Vector3 acceleration = instant.free_acceleration(offset);
  while (true) {
    const std::vector<Vector3> release_directions = instant.support(offset).release;
    // the contacts that are left share the load anew
    auto direction = release_directions.begin();
    const auto pulls = ranges::find_if(instant.contacts, [&](const RestingContact& contact) {
      return contact.body == held && (direction++)->dot(acceleration) > 0.0;
    });
    if (pulls == instant.contacts.end()) return "";
    record(*pulls, ImpactKind::leave, instant.time(), instant.q);
    release(instant, static_cast<int>(pulls - instant.contacts.begin()));
  }
}

std::string LastingContacts::release_after_set(Instant& instant) {
  const Eigen::VectorXd& before = instant.before();
  for (const int index : instant.course().group().bodies) {
    const auto is_of_body = [&](const RestingContact& contact) { return contact.body == index; };
    if (ranges::none_of(instant.contacts, is_of_body)) continue;
    if (const RestingContact* stuck = sticking_contact(instant.contacts, index)) {
      const BodySlice slice = body(index).slice();
      if (instant.q.segment(slice.first, slice.size()) != before.segment(slice.first, slice.size()))
        let_go(instant, *stuck);
      continue;
    }
    const int offset = body(index).offset;
    if (instant.q.segment<3>(offset) == before.segment<3>(offset)) {
      if (const std::string failure = release_by_speed(instant, index); !failure.empty()) return failure;
      if (const std::string failure = release_by_force(instant, index); !failure.empty()) return failure;
      continue;
    }
    for (auto contact = ranges::find_if(instant.contacts, is_of_body); contact != instant.contacts.end();
         contact = ranges::find_if(instant.contacts, is_of_body)) {
      record(*contact, ImpactKind::leave, instant.time(), before);
      end(instant, static_cast<int>(contact - instant.contacts.begin()));
    }
  }
  return "";
}

ContactMemory& LastingContacts::release(Instant& instant, int index) {
  const RestingContact contact = instant.contacts[static_cast<std::size_t>(index)];
  const PairId id{contact.body, contact.obstacle};
  ContactMemory memory = encounters_.pair(id).memory;
  memory.contact_time = instant.time();
  // what the body has drifted off the surface while it rested is still contact
  const std::optional<FrameMotion> frame = encounters_.frame(contact.obstacle, instant.time());
  if (contact.core) {
    end(instant, index);
    return instant.memories.emplace_back(id, memory_of_corners(world_, contact, frame, instant.q, memory)).second;
  }
  const Vector3 place = instant.q.segment<3>(contact.offset);
  const Vector3 position = frame ? frame->to_start(place) : place;
  const Vector3 normal = frame ? Vector3(frame->R.transpose() * contact.normal) : contact.normal;
  const Vector3 point = position - bounding_radius(body(contact.body).solid) * normal;
  const Vector3 surface = closest_point_of(obstacle(contact.obstacle).shape, position);
  memory.tolerance = std::max(memory.tolerance, 2.0 * (surface - point).norm());
  end(instant, index);
  return instant.memories.emplace_back(id, memory).second;
}

void LastingContacts::end(Instant& instant, int index) {
  const auto contact = instant.contacts.begin() + index;
  const PairId id{contact->body, contact->obstacle};
  std::erase_if(coming_, [&](const Coming& coming) { return coming.id == id; });
  recorder_.contact_ends(instant.time(), id);
  instant.contacts.erase(contact);
}

void LastingContacts::record_until(double time) {
  while (!coming_.empty() && coming_.begin()->time <= time) {
    const Coming rest = *coming_.begin();
    coming_.erase(coming_.begin());
    const Course& course = *courses_[static_cast<std::size_t>(body(rest.id.body).group)];
    const auto contact = ranges::find_if(course.held_law().contacts(), [&](const RestingContact& each) {
      return PairId{each.body, each.obstacle} == rest.id;
    });
    record(*contact, kinds_[{rest.id.body, rest.id.obstacle}], rest.time, course.state(rest.time),
           rest.time_error_bound);
  }
}

void LastingContacts::record(const RestingContact& contact, ImpactKind kind, double time, const Eigen::VectorXd& q,
                             double time_error_bound) {
  Impact impact = describe(world_, contact, kind, time, q);
  impact.time_error_bound = time_error_bound;
  recorder_.impact(impact);
  if (kind != ImpactKind::leave) recorder_.contact(time, {contact.body, contact.obstacle}, kind);
}

bool LastingContacts::goes_on(const RestingContact& contact, int next, const Eigen::VectorXd& q) const {
  const World::Obstacle& other = obstacle(next);
  if (other.drive) return false;
  const Vector3 position = q.segment<3>(contact.offset);
  const Vector3 velocity = q.segment<3>(contact.offset + 3);
  const double radius = bounding_radius(body(contact.body).solid);
  const Vector3 foot = position - radius * contact.normal;
  const Vector3 ahead = ahead_of(foot, velocity);
  if (world_.surface(contact.body, next).on_hit != OnHit::bounce || !is_flat_at(other.shape, ahead, contact.normal))
    return false;
  const double size = position.norm() + radius;
  const Vector3 above = foot + size * contact.normal;
  const Vector3 apart = closest_point_of(other.shape, above) - foot;
  const double step = kStep * size;
  // a ball touches an edge beside it from sqrt(2 r h) away on, h the step
  const double reach = step + std::sqrt(2.0 * radius * step);
  return std::abs(apart.dot(contact.normal)) <= step && apart.norm() <= reach &&
         !moves_off(face_outline(other.shape, ahead, contact.normal), position, velocity);
}

bool LastingContacts::slides_onto(PairId id, const Course& course, const Eigen::VectorXd& q) const {
  const auto rests = [&](const RestingContact& contact) {
    return contact.body == id.body && goes_on(contact, id.obstacle, q);
  };
  if (ranges::any_of(course.held_law().contacts(), rests)) return true;
  // without a force it slides along a face and does not rest there
  const std::optional<Vector3> up = plane_normal(obstacle(id.obstacle).shape);
  if (!up || obstacle(id.obstacle).drive) return false;
  const ContactResult& met = encounters_.pair(id).contact;
  const int offset = body(id.body).offset;
  const double radius = bounding_radius(body(id.body).solid);
  const Vector3 position = q.segment<3>(offset), velocity = q.segment<3>(offset + 3);
  const bool slides = radius == 0.0 ? met.memory.is_in_plane : std::abs(up->dot(velocity)) <= kNone * velocity.norm();
  if (!slides) return false;
  const Vector3 normal = radius > 0.0 && up->dot(met.normal) < 0.0 ? Vector3(-*up) : *up;
  const Vector3 place = position - radius * normal;
  return ranges::any_of(encounters_.pairs(id.body), [&](const Pair& pair) {
    const World::Obstacle& left = obstacle(pair.id.obstacle);
    if (pair.id == id || world_.surface(id.body, pair.id.obstacle).on_hit != OnHit::bounce ||
        !is_flat_at(left.shape, place, normal))
      return false;
    return (closest_point_of(left.shape, place) - place).norm() <= kStep * (position.norm() + radius) &&
           goes_on({id.body, pair.id.obstacle, offset, normal, place, normal}, id.obstacle, q);
  });
}

std::optional<PairId> LastingContacts::continuation(const RestingContact& left, const Eigen::VectorXd& q) const {
  const auto continues = [&](const Pair& pair) {
    // another face of the same obstacle may be next
    const bool is_taken = pair.is_lasting && pair.id.obstacle != left.obstacle;
    return !is_taken && goes_on(left, pair.id.obstacle, q);
  };
  const std::vector<Pair>& pairs = encounters_.pairs(left.body);
  const auto found = ranges::find_if(pairs, continues);
  return found != pairs.end() ? std::optional(found->id) : std::nullopt;
}

bool LastingContacts::rest_on_continuation(Instant& instant, const RestingContact& left) {
  const std::optional<PairId> found = continuation(left, instant.q);
  if (!found) return false;
  const double radius = bounding_radius(body(left.body).solid);
  const Vector3 foot = instant.q.segment<3>(left.offset) - radius * left.normal;
  std::optional<RestingContact> next = contact_at(instant, *found, foot, left.normal);
  if (!next) return false;
  next->mode = left.mode;
  keep_kind(*found, left.is_plain ? ImpactKind::rest : kinds_[{left.body, left.obstacle}]);
  record(*next, kinds_[{found->body, found->obstacle}], instant.time(), instant.q);
  const bool is_behind = radius == 0.0 && looks_down(obstacle(next->obstacle).shape, next->point, left.normal);
  instant.contacts.push_back(std::move(*next));
  instant.memories.emplace_back(*found, ContactMemory{.side = is_behind ? -1 : 1, .contact_time = instant.time()});
  return true;
}

std::optional<RestingContact> LastingContacts::next_patch(const Instant& instant, const RestingContact& left) const {
  return is_round(body(left.body).solid)
             ? next_round_contact(world_, left, encounters_.frame(left.obstacle, instant.time()), instant.q)
             : std::nullopt;
}

std::string LastingContacts::touch(Instant& instant, int index, double time_error_bound) {
  RestingContact& contact = instant.contacts[static_cast<std::size_t>(index)];
  const int held = contact.body;
  const PairId id{held, contact.obstacle};
  const auto frame = encounters_.frame(contact.obstacle, instant.time());
  contact.corners = touching_corners(world_, contact, frame, instant.q);
  const Eigen::VectorXd before = instant.q;
  const auto terms = ContactSettling(world_, encounters_, instant, held).look();
  if (!terms) return "the way in which a table enters a velocity has no derivative";
  double speed = 0.0, pull = 0.0;
  for (const ContactTerms<double>& at : terms->points) {
    speed = std::max(speed, -at.normal.dot(at.slip));
    pull = std::max(pull, std::abs(at.normal.dot(at.slip_rate)));
  }
  const double tolerance = encounters_.pair(id).memory.tolerance;
  const bool is_low = is_below_flight(speed, pull, tolerance);
  const Surface& surface = world_.surface(held, id.obstacle);
  const double restitution = is_low ? 0.0 : surface.restitution.at(speed);
  if (!(restitution >= 0.0 && restitution <= 1.0))
    return describe_impossible_restitution("obstacle '" + obstacle(id.obstacle).name + "'", surface, restitution,
                                           speed);
  Impact impact = describe(world_, contact, ImpactKind::hit, instant.time(), before);
  impact.time_error_bound = time_error_bound;
  ContactSettling settling(world_, encounters_, instant, held, restitution);
  std::vector<RestingContact> left;
  const std::string failure = settling.settle({}, [&](int released) {
    left.push_back(instant.contacts[static_cast<std::size_t>(released)]);
    release(instant, released);
  });
  const BodySlice slice = body(held).slice();
  impact.velocity_after = slice.velocity(instant.q);
  impact.angular_velocity_after = angular_velocity(body(held), instant.q);
  impact.impulse = mass_of(body(held), instant.time(), instant.q) * (impact.velocity_after - impact.velocity_before);
  if (!is_low) recorder_.impact(impact);
  for (const RestingContact& each : left) record(each, ImpactKind::leave, instant.time(), instant.q);
  keep_kinds(settling, instant);
  return failure;
}

std::string LastingContacts::handle_end(Instant& instant, int index, ContactEnd end, int detail,
                                        double time_error_bound) {
  if (!are_plain(instant.contacts, instant.contacts[static_cast<std::size_t>(index)].body))
    ContactSettling(world_, encounters_, instant, instant.contacts[static_cast<std::size_t>(index)].body).look();
  const RestingContact contact = instant.contacts[static_cast<std::size_t>(index)];
  if (end == ContactEnd::touches) return touch(instant, index, time_error_bound);
  if (end == ContactEnd::tips && contact.is_on_rim) return kTipsOverRim;
  if (end == ContactEnd::past_edge && contact.is_on_rim)
    return "the round face on which it lies flat comes over the edge of the surface, which is not computed yet";
  if (end == ContactEnd::tips) {
    const auto points = contact_points({sustained_contact(world_, contact)}).front();
    narrow(instant.contacts[static_cast<std::size_t>(index)], points.remaining[static_cast<std::size_t>(detail)]);
    return release_by_force(instant, contact.body, {{{contact.body, contact.obstacle}, end}});
  }
  if (end != ContactEnd::pull && end != ContactEnd::past_edge)
    return release_by_force(instant, contact.body, {{{contact.body, contact.obstacle}, end}});
  if (end == ContactEnd::past_edge && !continuation(contact, instant.q)) {
    if (std::optional<RestingContact> next = next_patch(instant, contact)) {
      instant.contacts[static_cast<std::size_t>(index)] = *next;
      return release_by_force(instant, contact.body);
    }
  }
  record(contact, ImpactKind::leave, instant.time(), instant.q, time_error_bound);
  release(instant, index);
  if (end == ContactEnd::past_edge) {
    // beside a thin surface a point takes the side to which it falls: it does not go through
    if (is_thin(obstacle(contact.obstacle).shape) && bounding_radius(body(contact.body).solid) == 0.0)
      instant.memories.back().second.side = 0;
    rest_on_continuation(instant, contact);
  }
  return release_by_force(instant, contact.body);
}

}  // namespace trajet
