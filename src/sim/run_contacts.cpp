#include <cmath>
#include <utility>

#include "extended_bounce.hpp"
#include "impact_record.hpp"
#include "jump_derivative.hpp"
#include "plastic_bounce.hpp"
#include "run_loop.hpp"
#include "solid_bounce.hpp"
#include "ties.hpp"
#include "trajet/collide/respond/restitution.hpp"
#include "trajet/collide/sustain/rest.hpp"
#include "trajet/geom/flat_faces.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/scene/law_name.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {
namespace {

/// So many impacts of one body at one instant are a body that cannot get away, not a motion.
constexpr int kMaxImpactsAtOnce = 1000;

/// kg; 1 where the body has none: impulses are per mass then.
double mass_of(const World::Body& body, double t, const Eigen::VectorXd& q) {
  double value = 1.0;
  if (!body.mass) return value;
  Evaluator<double> mass(*body.mass);
  mass(t, q.data(), &value);
  return value;
}

/// Why the restitution of an obstacle does not tell what becomes of an impact.
std::string describe_restitution(const World::Obstacle& obstacle, double restitution, double speed) {
  const std::string place = place_text(obstacle.restitution_where);
  return "restitution of obstacle '" + obstacle.name + "' is " + shortest_text(restitution) +
         " at a speed of approach of " + shortest_text(speed) + " m/s, not within 0 and 1" +
         (place.empty() ? "" : " (" + place + ")");
}

}  // namespace

void RunLoop::handle_contact(int index, const Pair& met) {
  Course& moving = course(index);
  // what goes on from the face on which the body slides is nothing to hit, whatever else it meets at this instant
  if (goes_on_sliding(index, met)) return;
  const Pair& pair = encounters_.pair(first_to_handle(world_, encounters_, met));
  const World::Body& body = body_of(pair);
  const World::Obstacle& obstacle = obstacle_of(pair);
  const double time = met.contact.time;
  const std::string names = "'" + body.name + "' with '" + obstacle.name + "'";
  if (pair.contact.status == ContactStatus::overlapping_at_start) {
    if (obstacle.on_hit == OnHit::pass) {
      // it starts inside: the first that happens is that it comes out
      encounters_.pass(pair.id, moving);
      for (const int each : moving.group().bodies) encounters_.search(each, moving, moving.next().time);
      return enqueue(index);
    }
    if (time == 0.0)
      throw InputError(body.where, "body '" + body.name + "' starts inside obstacle '" + obstacle.name + "'");
    return fail(time, "body '" + body.name + "' is inside obstacle '" + obstacle.name + "'");
  }
  if (pair.contact.status == ContactStatus::unresolved) return fail(time, "contact of " + names + " is unresolved");
  if (last_impacts_[static_cast<std::size_t>(pair.id.body)].count_at(time) > kMaxImpactsAtOnce)
    return fail(time, "body '" + body.name + "' has impact after impact with '" + obstacle.name + "' at one instant");

  if (const std::string doubt = describe_doubt(moving, pair); !doubt.empty())
    return fail(time, "contact of " + names + " is unresolved: " + doubt);
  for (const int each : moving.group().bodies) encounters_.bound_times(each, moving);
  Impact impact = describe(world_, pair, moving.state(time));
  impact.elapsed = time;
  if (!is_round(body.solid) && is_hit(pair.contact) && obstacle.on_hit == OnHit::bounce)
    return bounce_off(index, pair, impact);
  if (is_hit(pair.contact) && obstacle.on_hit == OnHit::bounce) {
    if (goes_on_sliding(index, pair)) return;
    if (goes_on_from_contact(index, pair, impact)) return enqueue(index);
    return bounce(index, pair, impact);
  }
  recorder_.sample(time, pair.id.body, SamplePhase::before);
  if (is_hit(pair.contact) && obstacle.on_hit == OnHit::stop) {
    recorder_.sample(time);
    recorder_.impact(impact);
    warn_of_hidden_ties(world_, encounters_, pair, impact, moving, recorder_);
    return stop();
  }
  recorder_.sample(time, pair.id.body, SamplePhase::after);
  recorder_.impact(impact);
  encounters_.pass(pair.id, moving);
  for (const int each : moving.group().bodies) encounters_.search(each, moving, moving.next().time);
  enqueue(index);
}

bool RunLoop::goes_on_sliding(int index, const Pair& pair) {
  Course& moving = course(index);
  const bool is_met = pair.contact.status == ContactStatus::hit || pair.contact.status == ContactStatus::graze;
  if (!is_met || obstacle_of(pair).on_hit != OnHit::bounce) return false;
  if (!lasting_contacts_.slides_onto(pair.id, moving, moving.state(pair.contact.time))) return false;
  const int body = pair.id.body;
  encounters_.pass(pair.id, moving);
  encounters_.search(body, moving, moving.next().time);
  enqueue(index);
  return true;
}

std::string RunLoop::describe_doubt(Course& moving, const Pair& pair) {
  const int offset = body_of(pair).offset;
  const double time = pair.contact.time;
  if (!is_hit(pair.contact) || !is_round(body_of(pair).solid)) return {};
  const Eigen::VectorXd q = moving.state(time);
  const RelativeMotion motion = encounters_.relative_motion(pair.id, time, q, moving.rate(time, q));
  const double speed = -pair.contact.normal.dot(motion.velocity);
  const double pull = -pair.contact.normal.dot(motion.acceleration);
  if (speed <= 0.0 || is_lying(speed, std::max(0.0, pull), pair.contact.memory.tolerance)) return {};
  Eigen::VectorXd along = Eigen::VectorXd::Zero(q.size());
  along.segment<3>(offset + 3) = pair.contact.normal;
  const double error = moving.velocity_error(along, time);
  if (!(error >= speed)) return {};
  return "they approach with " + shortest_text(speed) + " m/s, and the velocity may be off by " + shortest_text(error) +
         " m/s: choose a finer tolerance or step";
}

bool RunLoop::goes_on_from_contact(int index, const Pair& pair, const Impact& impact) {
  Course& moving = course(index);
  const int offset = body_of(pair).offset;
  const Eigen::VectorXd q = moving.state(impact.elapsed);
  const RelativeMotion motion = encounters_.relative_motion(pair.id, impact.elapsed, q, moving.rate(impact.elapsed, q));
  const double speed = impact.normal.dot(motion.velocity);
  const double pull = -impact.normal.dot(motion.acceleration);
  const bool has_left = pull < 0.0 && pair.memory.contact_time == impact.elapsed;
  if (speed <= 0.0 && !has_left) return false;
  double height = 0.0;
  if (speed > 0.0) {
    // of the flight: u^2 / (2 g), or where nothing pulls back, that on the Segment
    const double on_segment = speed * std::abs(moving.segment().t1() - impact.elapsed);
    height = pull > 0.0 ? speed * speed / (2.0 * pull) : on_segment;
  } else {
    // What the law carries away from the contact that it has just left has not hit: the Segment goes astray.
    constexpr double kRoundings = 4.0;
    const double astray = impact.normal.cwiseAbs().dot(moving.segment().error_bound().segment<3>(offset)) +
                          kRoundings * kUnitRoundoff * impact.position.norm();
    if (speed * speed > -2.0 * pull * astray) return false;
    height = 2.0 * astray;
  }
  if (!encounters_.stay_in_contact(pair.id, moving, height)) return false;
  encounters_.search(pair.id.body, moving, moving.next().time);
  return true;
}

void RunLoop::bounce(int index, Pair pair, Impact impact) {
  Course& moving = course(index);
  const World::Body& body = body_of(pair);
  const double t = impact.elapsed;
  recorder_.sample(t, pair.id.body, SamplePhase::before);

  Instant instant(moving, t);
  auto velocity = instant.q.segment<3>(body.offset + 3);
  // the velocity of the centre is dr/dt, which a position_rate may set apart from v
  const RelativeMotion motion = encounters_.relative_motion(pair.id, t, instant.before(), instant.rate());
  const Vector3& approach = motion.velocity;
  const double speed_before = std::max(0.0, -approach.dot(impact.normal));
  const double restitution = obstacle_of(pair).restitution.at(speed_before);
  if (!(restitution >= 0.0 && restitution <= 1.0))
    return fail(t, describe_restitution(obstacle_of(pair), restitution, speed_before));
  const double mass = mass_of(body, t, instant.q);
  const std::vector<Impact> group = bounce_plastic(world_, encounters_, pair, impact, mass, instant);
  if (group.empty()) {
    velocity += rebound(approach, impact.normal, restitution).impulse_per_mass;
    const std::optional<FrameMotion> surface = encounters_.frame(pair.id.obstacle, t);
    if (world_.extended && !surface && approach == Vector3(impact.velocity_before))
      bounce_extended(world_, pair, instant);
    instant.derivative = derivative_of_bounce(world_, pair, surface, instant, moving.rate(t, instant.before()));
    impact.velocity_after = velocity;
    impact.impulse = mass * (impact.velocity_after - impact.velocity_before);
  }
  // else it lies there, or its flight is so low that the Segment does not show it
  const double pull = -impact.normal.dot(motion.acceleration);
  const double speed = -approach.dot(impact.normal);
  const double no_time = kUnitRoundoff * world_.duration;
  const double lowest_fall = std::max(pair.contact.memory.tolerance, std::abs(pull) * no_time * no_time);
  const bool is_hit = speed > 0.0 && !is_lying(speed, std::max(0.0, pull), lowest_fall);
  if (!group.empty()) {
    recorder_.impacts(group);
  } else if (is_hit) {
    recorder_.impact(impact);
    warn_of_hidden_ties(world_, encounters_, pair, impact, moving, recorder_);
  }

  lasting_contacts_.release_by_speed(instant, pair.id.body);
  if (!rest(instant, pair, impact, restitution, !is_hit)) return;
  const bool stops = settle_other_contacts(world_, encounters_, pair, impact, instant, recorder_);
  ContactMemory memory = rebounded(pair.contact.memory);
  memory.contact_time = t;
  instant.memories.insert(instant.memories.begin(), {pair.id, memory});
  go_on(index, instant);
  recorder_.sample(t, pair.id.body, SamplePhase::after);
  lasting_contacts_.record_until(t);
  if (stops) return stop();
  advance(index);
}

void RunLoop::bounce_off(int index, Pair pair, Impact impact) {
  Course& moving = course(index);
  const World::Body& body = body_of(pair);
  const World::Obstacle& obstacle = obstacle_of(pair);
  const double t = impact.elapsed;
  const std::optional<FrameMotion> surface = encounters_.frame(pair.id.obstacle, t);
  const Eigen::VectorXd q = moving.state(t);
  const NormalMotion before = normal_motion(world_, pair, surface, q, moving.rate(t, q));
  if (before.speed > 0.0 && pair.memory.contact_time == t) {
    // what moves away from the contact that it has just left has not hit
    const double height = before.speed * std::abs(moving.segment().t1() - t);
    if (encounters_.stay_in_contact(pair.id, moving, height)) {
      encounters_.search(pair.id.body, moving, moving.next().time);
      return enqueue(index);
    }
  }
  const auto rests = [&] {
    fail(t, "body '" + body.name + "' comes to rest on obstacle '" + obstacle.name +
                "': contact that lasts is not computed yet for solids that are no points or balls");
  };
  Bounce& last = last_bounces_[static_cast<std::size_t>(pair.id.body)];
  const Bounce flight = std::exchange(last, Bounce{pair.id.obstacle, t, pair.contact.point});
  recorder_.sample(t, pair.id.body, SamplePhase::before);
  const auto end = [&](const std::string& reason) {
    recorder_.impact(impact);
    fail(t, reason);
  };
  if (const std::string reason = why_it_cannot_bounce(body); !reason.empty()) return end(reason);
  Instant instant(moving, t);
  const double speed = std::max(0.0, -before.speed);
  const double restitution = obstacle.restitution.at(speed);
  if (!(restitution >= 0.0 && restitution <= 1.0)) return fail(t, describe_restitution(obstacle, restitution, speed));
  // how curved surfaces are pulled together shows in how long the last flight from here was: u/g = dt/2
  constexpr double kSamePlace = 1e-3;  // of the size
  const double tolerance = pair.contact.memory.tolerance, duration = t - flight.time;
  const double moved = (pair.contact.point - flight.point).norm();
  const bool is_again =
      flight.obstacle == pair.id.obstacle &&
      moved <= kSamePlace * bounding_radius(body.solid) + 2.0 * std::abs(duration) * impact.velocity_before.norm();
  const double pull = before.speed > 0.0 ? std::abs(pair.contact.gap_curvature) : 2.0 * speed / std::abs(duration);
  const bool is_low = restitution < 1.0 ? is_below_flight(std::abs(before.speed), pull, tolerance)
                                        : is_lying(std::abs(before.speed), pull, tolerance);
  if (is_again && is_low) return rests();
  bounce_solid(world_, pair, surface, restitution, mass_of(body, t, instant.q), instant, impact);
  recorder_.impact(impact);
  warn_of_hidden_ties(world_, encounters_, pair, impact, moving, recorder_);
  const NormalMotion after = normal_motion(world_, pair, surface, instant.q, instant.rate());
  if (after.acceleration <= 0.0 &&
      is_below_flight(std::max(0.0, after.speed), -after.acceleration, pair.contact.memory.tolerance))
    return rests();
  instant.memories.insert(instant.memories.begin(), {pair.id, rebounded(pair.contact.memory)});
  go_on(index, instant);
  recorder_.sample(t, pair.id.body, SamplePhase::after);
  advance(index);
}

bool RunLoop::rest(Instant& instant, const Pair& pair, const Impact& impact, double restitution, bool is_hidden) {
  const World::Body& body = body_of(pair);
  const World::Obstacle& obstacle = obstacle_of(pair);
  const double t = instant.time();
  const RelativeMotion motion = encounters_.relative_motion(pair.id, t, instant.q, instant.rate());
  const double speed = std::max(0.0, impact.normal.dot(motion.velocity));
  const double pull = -impact.normal.dot(motion.acceleration);
  const double tolerance = pair.contact.memory.tolerance;
  const bool is_low =
      restitution < 1.0 ? is_hidden || is_below_flight(speed, pull, tolerance) : is_lying(speed, pull, tolerance);
  if (pull <= 0.0 || !is_low) return true;
  if (obstacle.drive) {
    fail(t, "body '" + body.name + "' comes to rest on obstacle '" + obstacle.name +
                "', which moves: trajet cannot follow it there yet");
    return false;
  }
  if (!is_flat_at(obstacle.shape, impact.point, impact.normal)) {
    fail(t, "body '" + body.name + "' comes to rest on the curved or sharp part of obstacle '" + obstacle.name +
                "', where trajet cannot follow it");
    return false;
  }
  PairId on = pair.id;
  // a velocity so much smaller than it was is what rounding leaves of one that was stopped
  constexpr double kStopped = 1e-12;
  Vector3 along = instant.q.segment<3>(body.offset + 3);
  along -= along.dot(impact.normal) * impact.normal;
  const bool is_stopped = along.norm() <= kStopped * impact.velocity_before.norm();
  if (bounding_radius(body.solid) > 0.0 && !is_stopped &&
      moves_off(face_outline(obstacle.shape, impact.point, impact.normal), impact.position, along)) {
    const RestingContact here{pair.id.body, pair.id.obstacle, body.offset, impact.normal, impact.point, impact.normal};
    const std::optional<PairId> next = lasting_contacts_.continuation(here, instant.q);
    if (!next) {
      fail(t, "body '" + body.name + "' slides over an edge of obstacle '" + obstacle.name +
                  "' too slowly to leave it, where trajet cannot follow it");
      return false;
    }
    on = *next;
  }
  lasting_contacts_.begin(instant, on, impact, t + bouncing_time(speed, pull, restitution));
  lasting_contacts_.release_by_force(instant, pair.id.body);
  return true;
}

}  // namespace trajet
