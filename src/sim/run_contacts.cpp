#include <cmath>

#include "extended_bounce.hpp"
#include "impact_record.hpp"
#include "jump_derivative.hpp"
#include "plastic_bounce.hpp"
#include "run_loop.hpp"
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
  const Pair& pair = encounters_.pair(first_to_handle(world_, encounters_, met));
  const World::Body& body = body_of(pair);
  const World::Obstacle& obstacle = obstacle_of(pair);
  const double time = met.contact.time;
  const std::string names = "'" + body.name + "' with '" + obstacle.name + "'";
  if (!is_round(body.solid))
    return fail(time, "contact unresolved: body '" + body.name + "' comes within " +
                          "the reach of its farthest point from obstacle '" + obstacle.name +
                          "'; impacts of solids other than points and spheres are not supported yet");
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
  if (is_hit(pair.contact) && obstacle.on_hit == OnHit::bounce) {
    if (lasting_contacts_.slides_onto(pair.id, moving, moving.state(time))) {
      encounters_.pass(pair.id, moving);
      encounters_.search(pair.id.body, moving, moving.next().time);
      return enqueue(index);
    }
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

std::string RunLoop::describe_doubt(Course& moving, const Pair& pair) const {
  const int offset = body_of(pair).offset;
  const double time = pair.contact.time;
  if (!is_hit(pair.contact)) return {};
  const Eigen::VectorXd rate = moving.rate(time, moving.state(time));
  const double speed = -pair.contact.normal.dot(rate.segment<3>(offset));
  const double pull = -pair.contact.normal.dot(rate.segment<3>(offset + 3));
  if (speed <= 0.0 || is_lying(speed, std::max(0.0, pull), pair.contact.memory.tolerance)) return {};
  Eigen::VectorXd along = Eigen::VectorXd::Zero(rate.size());
  along.segment<3>(offset + 3) = pair.contact.normal;
  const double error = moving.velocity_error(along, time);
  if (!(error >= speed)) return {};
  return "they approach with " + shortest_text(speed) + " m/s, and the velocity may be off by " + shortest_text(error) +
         " m/s: choose a finer tolerance or step";
}

bool RunLoop::goes_on_from_contact(int index, const Pair& pair, const Impact& impact) {
  Course& moving = course(index);
  const int offset = body_of(pair).offset;
  const Eigen::VectorXd rate = moving.rate(impact.elapsed, moving.state(impact.elapsed));
  const double speed = impact.normal.dot(rate.segment<3>(offset));
  const double pull = -impact.normal.dot(rate.segment<3>(offset + 3));
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
  const Eigen::VectorXd rate_before = instant.rate();
  const Vector3 approach = rate_before.segment<3>(body.offset);
  const double speed_before = std::max(0.0, -approach.dot(impact.normal));
  const double restitution = obstacle_of(pair).restitution.at(speed_before);
  if (!(restitution >= 0.0 && restitution <= 1.0))
    return fail(t, describe_restitution(obstacle_of(pair), restitution, speed_before));
  const double mass = mass_of(body, t, instant.q);
  const std::vector<Impact> group = bounce_plastic(world_, encounters_, pair, impact, mass, instant);
  if (group.empty()) {
    velocity += rebound(approach, impact.normal, restitution).impulse_per_mass;
    if (world_.extended && approach == Vector3(impact.velocity_before)) bounce_extended(world_, pair, instant);
    instant.derivative = derivative_of_bounce(world_, pair, instant, moving.rate(t, instant.before()));
    impact.velocity_after = velocity;
    impact.impulse = mass * (impact.velocity_after - impact.velocity_before);
  }
  // else it lies there, or its flight is so low that the Segment does not show it
  const double pull = -impact.normal.dot(rate_before.segment<3>(body.offset + 3));
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

bool RunLoop::rest(Instant& instant, const Pair& pair, const Impact& impact, double restitution, bool is_hidden) {
  const World::Body& body = body_of(pair);
  const World::Obstacle& obstacle = obstacle_of(pair);
  const double t = instant.time();
  const Eigen::VectorXd rate = instant.rate();
  const double speed = std::max(0.0, impact.normal.dot(rate.segment<3>(body.offset)));
  const double pull = -impact.normal.dot(rate.segment<3>(body.offset + 3));
  const double tolerance = pair.contact.memory.tolerance;
  const bool is_low =
      restitution < 1.0 ? is_hidden || is_below_flight(speed, pull, tolerance) : is_lying(speed, pull, tolerance);
  if (pull <= 0.0 || !is_low) return true;
  if (!is_flat_at(obstacle.shape, impact.point, impact.normal)) {
    fail(t, "body '" + body.name + "' comes to rest on the curved or sharp part of obstacle '" + obstacle.name +
                "', where trajet cannot follow it");
    return false;
  }
  PairId on = pair.id;
  if (bounding_radius(body.solid) > 0.0 && moves_off(face_outline(obstacle.shape, impact.point, impact.normal),
                                                     impact.position, instant.q.segment<3>(body.offset + 3))) {
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
