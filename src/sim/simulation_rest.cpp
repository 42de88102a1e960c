#include <algorithm>
#include <cmath>
#include <variant>

#include "body_state.hpp"
#include "simulation.hpp"
#include "trajet/collide/respond/restitution.hpp"
#include "trajet/geom/distance.hpp"
#include "trajet/geom/flat_faces.hpp"

namespace trajet {
namespace {

/// Whether a body that moves away with `speed` from an obstacle towards which it is accelerated with `pull` is in
/// contact still. A flight this much higher than the gap that can be told from contact is a flight: u^2 / (2 g) against
/// the gap.
bool is_below_flight(double speed, double pull, double tolerance) {
  constexpr double kLowestFlight = 1e5;
  return speed * speed <= 2.0 * pull * kLowestFlight * tolerance;
}

}  // namespace

bool Simulation::goes_on_from_contact(int index, const Incident& incident, const Impact& impact) {
  Motion& moving = motion(index);
  const int offset = body_of(moving.pair(incident.index)).offset;
  const Eigen::VectorXd rate = moving.rate(incident.time, moving.state(incident.time));
  const double speed = impact.normal.dot(rate.segment<3>(offset));
  const double pull = -impact.normal.dot(rate.segment<3>(offset + 3));
  if (speed <= 0.0) return false;
  // of the flight: u^2 / (2 g), or where nothing pulls back, that on the Segment
  const double on_segment = speed * std::abs(moving.segment().t1() - incident.time);
  const double height = pull > 0.0 ? speed * speed / (2.0 * pull) : on_segment;
  return moving.stay_in_contact(incident.index, height);
}

void Simulation::bounce(int index, const Incident& incident, Impact impact) {
  Motion& moving = motion(index);
  const Motion::Pair pair = moving.pair(incident.index);
  const World::Body& body = body_of(pair);
  const World::Obstacle& obstacle = obstacle_of(pair);
  const double t = incident.time;
  write_sample(t);

  const Eigen::VectorXd before = moving.state(t);
  Eigen::VectorXd q = before;
  auto velocity = q.segment<3>(body.offset + 3);
  // the velocity of the centre is dr/dt, which a position_rate may set apart from v
  const Vector3 approach = moving.rate(t, q).segment<3>(body.offset);
  velocity += trajet::rebound(approach, impact.normal, obstacle.restitution).impulse_per_mass;
  impact.velocity_after = velocity;
  impact.impulse = mass(body, t, q) * (impact.velocity_after - impact.velocity_before);
  // else a flight so low that the Segment does not show it
  const bool is_hit = approach.dot(impact.normal) <= 0.0;
  if (is_hit) {
    record(impact);
    warn_of_hidden_ties(moving, moving.pair(incident.index), impact);
  }

  std::vector<Released> released = release_by_speed(moving, body, t, q);
  const RestingTime rest = resting_time(moving, pair, impact, q, !is_hit);
  if (rest.rests) {
    if (!is_flat_at(obstacle.shape, impact.point, impact.normal)) {
      fail(t, "body '" + body.name + "' comes to rest on the curved or sharp part of obstacle '" + obstacle.name +
                  "', where trajet cannot follow it");
      return;
    }
    if (bounding_radius(body.solid) > 0.0 &&
        moves_off(face_outline(obstacle.shape, impact.point, impact.normal), impact.position, velocity)) {
      fail(t, "body '" + body.name + "' slides over an edge of obstacle '" + obstacle.name +
                  "' too slowly to leave it, where trajet cannot follow it");
      return;
    }
    moving.begin_rest(incident.index, impact.normal, impact.point);
    for (const Vector3& direction : moving.support(body.offset).blocked)
      velocity -= velocity.dot(direction) * direction;
    coming_rests_.push_back({t + rest.duration, &moving, incident.index, impact.time_error_bound});
    release_by_force(moving, body, t, q, released);
  }
  const bool stops = take_turned_away(moving, incident.index, impact, before, moving.rate(t, q), released);
  moving.restart(t, q);
  ContactMemory memory = trajet::rebounded(pair.contact.memory);
  memory.contact_time = t;
  moving.rebound(incident.index, memory);
  for (const Released& each : released) moving.rebound(each.pair, each.memory);
  write_sample(t);
  record_rests_until(t);
  if (stops) {
    result_.status = RunStatus::stopped;
    running_ = false;
  } else {
    advance(index);
  }
}

Simulation::RestingTime Simulation::resting_time(const Motion& moving, const Motion::Pair& pair, const Impact& impact,
                                                 const Eigen::VectorXd& q, bool is_hidden) const {
  const World::Body& body = body_of(pair);
  const double e = obstacle_of(pair).restitution;
  const Eigen::VectorXd rate = moving.rate(impact.time, q);
  const double speed = std::max(0.0, impact.normal.dot(rate.segment<3>(body.offset)));
  const double pull = -impact.normal.dot(rate.segment<3>(body.offset + 3));
  if (pull <= 0.0 || e >= 1.0 || !(is_hidden || is_below_flight(speed, pull, pair.contact.memory.tolerance))) return {};
  // all flights to come: 2 u/g (1 + e + e^2 + ...)
  return {true, 2.0 * speed / (pull * (1.0 - e))};
}

std::vector<Simulation::Released> Simulation::release_by_speed(Motion& moving, const World::Body& body, double t,
                                                               Eigen::VectorXd& q) {
  std::vector<Released> released;
  auto velocity = q.segment<3>(body.offset + 3);
  const double pull = moving.free_acceleration(body.offset, t, q).norm();
  for (std::size_t i = 0; i < moving.resting().size();) {
    const RestingContact contact = moving.resting()[i];
    const double speed = velocity.dot(contact.normal);
    if (contact.offset != body.offset || is_below_flight(speed, pull, moving.pair(contact.pair).memory.tolerance)) {
      ++i;
      continue;
    }
    if (speed > 0.0) record_leave(moving, contact, t, q);
    released.push_back(release(moving, static_cast<int>(i), t, q));
  }
  for (const Vector3& direction : moving.support(body.offset).blocked) velocity -= velocity.dot(direction) * direction;
  return released;
}

void Simulation::release_by_force(Motion& moving, const World::Body& body, double t, const Eigen::VectorXd& q,
                                  std::vector<Released>& released) {
  const Vector3 acceleration = moving.free_acceleration(body.offset, t, q);
  for (std::size_t i = 0; i < moving.resting().size();) {
    const RestingContact contact = moving.resting()[i];
    if (contact.offset != body.offset || contact.release.dot(acceleration) <= 0.0) {
      ++i;
      continue;
    }
    record_leave(moving, contact, t, q);
    released.push_back(release(moving, static_cast<int>(i), t, q));
    i = 0;  // the contacts that are left share the load anew
  }
}

std::vector<Simulation::Released> Simulation::release_after_set(Motion& moving, double t, const Eigen::VectorXd& before,
                                                                Eigen::VectorXd& q) {
  std::vector<Released> released;
  for (const int index : moving.group().bodies) {
    const World::Body& body = world_.bodies[static_cast<std::size_t>(index)];
    const auto is_of_body = [&](const RestingContact& contact) { return contact.offset == body.offset; };
    if (std::ranges::none_of(moving.resting(), is_of_body)) continue;
    if (q.segment<3>(body.offset) == before.segment<3>(body.offset)) {
      const std::vector<Released> by_speed = release_by_speed(moving, body, t, q);
      released.insert(released.end(), by_speed.begin(), by_speed.end());
      release_by_force(moving, body, t, q, released);
      continue;
    }
    for (auto contact = std::ranges::find_if(moving.resting(), is_of_body); contact != moving.resting().end();
         contact = std::ranges::find_if(moving.resting(), is_of_body)) {
      record_leave(moving, *contact, t, before);
      end_rest(moving, static_cast<int>(contact - moving.resting().begin()), t);
    }
  }
  return released;
}

Simulation::Released Simulation::release(Motion& moving, int resting, double t, const Eigen::VectorXd& q) {
  const RestingContact contact = moving.resting()[static_cast<std::size_t>(resting)];
  const Motion::Pair& pair = moving.pair(contact.pair);
  ContactMemory memory = pair.memory;
  memory.contact_time = t;
  // what the body has drifted off the surface while it rested is still contact
  const Vector3 position = q.segment<3>(contact.offset);
  const Vector3 point = position - bounding_radius(body_of(pair).solid) * contact.normal;
  const Vector3 surface =
      std::visit([&](const auto& shape) { return closest_point(shape, position); }, obstacle_of(pair).shape);
  memory.tolerance = std::max(memory.tolerance, 2.0 * (surface - point).norm());
  end_rest(moving, resting, t);
  return {contact.pair, memory};
}

void Simulation::end_rest(Motion& moving, int resting, double t) {
  const int pair = moving.end_rest(resting, t);
  std::erase_if(coming_rests_, [&](const ComingRest& rest) { return rest.motion == &moving && rest.pair == pair; });
}

void Simulation::record_rests_until(double time) {
  while (true) {
    const auto next = std::ranges::min_element(coming_rests_, {}, &ComingRest::time);
    if (next == coming_rests_.end() || next->time > time) return;
    const ComingRest rest = *next;
    coming_rests_.erase(next);
    const auto contact = std::ranges::find(rest.motion->resting(), rest.pair, &RestingContact::pair);
    Impact impact = steady_contact(*rest.motion, *contact, ImpactKind::rest, rest.time, rest.motion->state(rest.time));
    impact.time_error_bound = rest.time_error_bound;
    record(impact);
  }
}

void Simulation::record_leave(const Motion& moving, const RestingContact& contact, double t, const Eigen::VectorXd& q) {
  record(steady_contact(moving, contact, ImpactKind::leave, t, q));
}

Impact Simulation::steady_contact(const Motion& moving, const RestingContact& contact, ImpactKind kind, double t,
                                  const Eigen::VectorXd& q) const {
  const Motion::Pair& pair = moving.pair(contact.pair);
  Impact impact;
  impact.time = t;
  impact.body = body_of(pair).name;
  impact.with = obstacle_of(pair).name;
  impact.kind = kind;
  impact.normal = contact.normal;
  impact.position = q.segment<3>(contact.offset);
  impact.point = impact.position - bounding_radius(body_of(pair).solid) * contact.normal;
  impact.velocity_before = impact.velocity_after = q.segment<3>(contact.offset + 3);
  impact.angular_velocity_before = impact.angular_velocity_after = angular_velocity(body_of(pair), q);
  impact.impulse = Vector3::Zero();
  return impact;
}

std::optional<Simulation::Released> Simulation::rest_on_continuation(Motion& moving, const RestingContact& contact,
                                                                     double t, const Eigen::VectorXd& q) {
  const World::Body& body = body_of(moving.pair(contact.pair));
  const Vector3 position = q.segment<3>(contact.offset);
  const Vector3 velocity = q.segment<3>(contact.offset + 3);
  const double radius = bounding_radius(body.solid);
  const Vector3 foot = position - radius * contact.normal;
  const double size = position.norm() + radius;
  const auto continues = [&](const Motion::Pair& pair) {
    const World::Obstacle& obstacle = obstacle_of(pair);
    if (&body_of(pair) != &body || pair.resting || obstacle.on_hit != OnHit::bounce) return false;
    if (!is_flat_at(obstacle.shape, foot, contact.normal)) return false;
    const Vector3 above = foot + size * contact.normal;
    const Vector3 surface = std::visit([&](const auto& shape) { return closest_point(shape, above); }, obstacle.shape);
    constexpr double kRounding = 1e-12;  // a step this high, of the place and the size, is none
    return (surface - foot).norm() <= kRounding * size &&
           !moves_off(face_outline(obstacle.shape, foot, contact.normal), position, velocity);
  };
  const auto found = std::ranges::find_if(moving.pairs(), continues);
  if (found == moving.pairs().end()) return std::nullopt;
  RestingContact next = contact;
  next.pair = static_cast<int>(found - moving.pairs().begin());
  next.point = foot;
  record(steady_contact(moving, next, ImpactKind::rest, t, q));
  moving.begin_rest(next.pair, next.normal, next.point);
  const bool is_behind = radius == 0.0 && looks_down(obstacle_of(*found).shape, contact.normal);
  return Released{next.pair, {is_behind ? -1 : 1, t}};
}

void Simulation::handle_leave(int index, const Incident& incident) {
  Motion& moving = motion(index);
  const RestingContact contact = moving.resting()[static_cast<std::size_t>(incident.index)];
  const World::Body& body = body_of(moving.pair(contact.pair));
  const Eigen::VectorXd q = moving.state(incident.time);
  write_sample(incident.time);
  write_sample(incident.time);
  record_leave(moving, contact, incident.time, q);
  std::vector<Released> released = {release(moving, incident.index, incident.time, q)};
  if (incident.kind == Incident::Kind::past_edge) {
    // beside a thin surface a point takes the side to which it falls: it does not go through
    if (is_thin(obstacle_of(moving.pair(contact.pair)).shape) && bounding_radius(body.solid) == 0.0)
      released.front().memory.side = 0;
    if (const std::optional<Released> next = rest_on_continuation(moving, contact, incident.time, q))
      released.push_back(*next);
  }
  release_by_force(moving, body, incident.time, q, released);
  moving.restart(incident.time, q);
  for (const Released& each : released) moving.rebound(each.pair, each.memory);
  advance(index);
}

}  // namespace trajet
