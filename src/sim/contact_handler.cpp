#include "contact_handler.hpp"

#include <cmath>
#include <utility>

#include "ball_bounce.hpp"
#include "extended_bounce.hpp"
#include "group_handler.hpp"
#include "impact_record.hpp"
#include "impact_sides.hpp"
#include "jump_derivative.hpp"
#include "last_contact.hpp"
#include "solid_bounce.hpp"
#include "ties.hpp"
#include "trajet/collide/respond/restitution.hpp"
#include "trajet/collide/sustain/rest.hpp"
#include "trajet/geom/flat_faces.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {
namespace {

std::string describe_restitution(const World::Obstacle& obstacle, const Surface& surface, double restitution,
                                 double speed) {
  return describe_impossible_restitution("obstacle '" + obstacle.name + "'", surface, restitution, speed);
}

}  // namespace

ContactHandler::ContactHandler(const RunControl& control)
    : run_(control),
      last_impacts_(control.world().bodies.size()),
      last_changes_(control.world().bodies.size()),
      last_bounces_(control.world().bodies.size()) {}

void ContactHandler::handle(int index, const Pair& met) {
  Course& moving = run_.course(index);
  // what goes on from the face on which the body slides is nothing to hit, whatever else it meets at this instant
  if (goes_on_sliding(index, met)) return;
  const Pair& pair = run_.encounters().pair(first_to_handle(run_.world(), run_.encounters(), met));
  const World::Body& body = body_of(pair);
  const World::Obstacle& obstacle = obstacle_of(pair);
  const double time = met.contact.time;
  if (pair.contact.status == ContactStatus::overlapping_at_start) {
    if (surface_of(pair).on_hit == OnHit::pass) {
      // it starts inside: the first that happens is that it comes out
      run_.encounters().pass(pair.id, moving);
      return run_.pass_on(index);
    }
    if (time == 0.0)
      throw InputError(body.where, "body '" + body.name + "' starts inside obstacle '" + obstacle.name + "'");
    return run_.fail(time, "body '" + body.name + "' is inside obstacle '" + obstacle.name + "'");
  }
  if (pair.contact.status == ContactStatus::unresolved) return run_.fail_unresolved(time, body.name, obstacle.name, "");
  if (last_impacts_[static_cast<std::size_t>(pair.id.body)].count_at(time) > kMaxImpactsAtOnce)
    return run_.fail(time,
                     "body '" + body.name + "' has impact after impact with '" + obstacle.name + "' at one instant");

  if (const std::string doubt = describe_doubt(moving, pair); !doubt.empty())
    return run_.fail_unresolved(time, body.name, obstacle.name, doubt);
  for (const int each : moving.group().bodies) run_.encounters().bound_times(each, moving);
  Impact impact = describe(run_.world(), pair, run_.encounters().frame(pair.id.obstacle, time), moving.state(time));
  impact.elapsed = time;
  if (surface_of(pair).on_hit == OnHit::stick &&
      (is_hit(pair.contact) || (!is_round(body.solid) && is_pressed(moving, pair))))
    return stick(index, pair, impact);
  if (!is_round(body.solid) && surface_of(pair).on_hit == OnHit::bounce &&
      (is_hit(pair.contact) || is_pressed(moving, pair)))
    return bounce_off(index, pair, impact);
  if (is_hit(pair.contact) && surface_of(pair).on_hit == OnHit::bounce) {
    if (goes_on_sliding(index, pair)) return;
    if (goes_on_from_contact(index, pair, impact)) return run_.enqueue(index);
    return bounce(index, pair, impact);
  }
  run_.recorder().sample(time, pair.id.body, SamplePhase::before);
  if (is_hit(pair.contact) && surface_of(pair).on_hit == OnHit::stop) {
    run_.recorder().sample(time);
    run_.recorder().impact(impact);
    warn_of_hidden_ties(run_.world(), run_.encounters(), pair, impact, moving, run_.recorder());
    return run_.stop();
  }
  run_.recorder().sample(time, pair.id.body, SamplePhase::after);
  run_.recorder().impact(impact);
  run_.encounters().pass(pair.id, moving);
  run_.pass_on(index);
}

bool ContactHandler::goes_on_sliding(int index, const Pair& pair) {
  Course& moving = run_.course(index);
  const bool is_met = pair.contact.status == ContactStatus::hit || pair.contact.status == ContactStatus::graze;
  if (!is_met || surface_of(pair).on_hit != OnHit::bounce) return false;
  if (!run_.lasting_contacts().slides_onto(pair.id, moving, moving.state(pair.contact.time))) return false;
  const int body = pair.id.body;
  run_.encounters().pass(pair.id, moving);
  run_.encounters().search(body, moving, moving.next().time);
  run_.enqueue(index);
  return true;
}

bool ContactHandler::is_pressed(const Course& moving, const Pair& pair) const {
  const double t = pair.contact.time;
  const Eigen::VectorXd q = moving.state(t);
  const NormalMotion motion =
      normal_motion(run_.world(), pair, run_.encounters().frame(pair.id.obstacle, t), q, moving.rate(t, q));
  return is_lying(motion.speed, std::max(0.0, -motion.acceleration), pair.contact.memory.tolerance) &&
         motion.acceleration < 0.0;
}

std::string ContactHandler::describe_doubt(Course& moving, const Pair& pair) {
  const int offset = body_of(pair).offset;
  const double time = pair.contact.time;
  if (!is_hit(pair.contact) || !is_round(body_of(pair).solid)) return {};
  const Eigen::VectorXd q = moving.state(time);
  const RelativeMotion motion = run_.encounters().relative_motion(pair.id, time, q, moving.rate(time, q));
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

bool ContactHandler::goes_on_from_contact(int index, const Pair& pair, const Impact& impact) {
  Course& moving = run_.course(index);
  const int offset = body_of(pair).offset;
  const Eigen::VectorXd q = moving.state(impact.elapsed);
  const RelativeMotion motion =
      run_.encounters().relative_motion(pair.id, impact.elapsed, q, moving.rate(impact.elapsed, q));
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
  if (!run_.encounters().stay_in_contact(pair.id, moving, height)) return false;
  run_.encounters().search(pair.id.body, moving, moving.next().time);
  return true;
}

void ContactHandler::bounce(int index, Pair pair, Impact impact) {
  Course& moving = run_.course(index);
  const World::Body& body = body_of(pair);
  const double t = impact.elapsed;
  Instant instant(moving, t);
  auto velocity = instant.q.segment<3>(body.offset + 3);
  // the velocity of the centre is dr/dt, which a position_rate may set apart from v
  const RelativeMotion motion = run_.encounters().relative_motion(pair.id, t, instant.before(), instant.rate());
  const Vector3& approach = motion.velocity;
  const double speed_before = std::max(0.0, -approach.dot(impact.normal));
  const double restitution = surface_of(pair).restitution.at(speed_before);
  if (!(restitution >= 0.0 && restitution <= 1.0))
    return run_.fail(t, describe_restitution(obstacle_of(pair), surface_of(pair), restitution, speed_before));
  if (const std::string reason = why_it_cannot_bounce(body, surface_of(pair)); !reason.empty()) {
    run_.recorder().sample(t, pair.id.body, SamplePhase::before);
    run_.recorder().impact(impact);
    return run_.fail(t, reason);
  }
  const double mass = mass_of(body, t, instant.q);
  // else it lies there, or its flight is so low that the Segment does not show it
  const double pull = -impact.normal.dot(motion.acceleration);
  const double speed = -approach.dot(impact.normal);
  const double no_time = kUnitRoundoff * run_.world().duration;
  const double lowest_fall = std::max(pair.contact.memory.tolerance, std::abs(pull) * no_time * no_time);
  const bool is_hit = speed > 0.0 && !is_lying(speed, std::max(0.0, pull), lowest_fall);
  if (is_hit && run_.groups().handle(index, pair)) return;
  run_.recorder().sample(t, pair.id.body, SamplePhase::before);
  const std::optional<FrameMotion> surface = run_.encounters().frame(pair.id.obstacle, t);
  double gained = 0.0;
  if (friction_of(surface_of(pair)).acts()) {
    gained = bounce_ball(run_.world(), pair, surface, mass, moving.rate(t, instant.before()), instant, impact);
  } else {
    velocity += rebound(approach, impact.normal, restitution).impulse_per_mass;
    if (run_.world().extended && !surface && approach == Vector3(impact.velocity_before))
      bounce_extended(run_.world(), pair, instant);
    instant.derivative = derivative_of_bounce(run_.world(), pair, surface, instant, moving.rate(t, instant.before()));
    impact.velocity_after = velocity;
    impact.impulse = mass * (impact.velocity_after - impact.velocity_before);
  }
  if (is_hit) {
    run_.recorder().impact(impact);
    warn_of_hidden_ties(run_.world(), run_.encounters(), pair, impact, moving, run_.recorder());
    if (gained > 0.0) run_.recorder().warn_of_gain(impact, gained);
  }

  if (const std::string failure = run_.lasting_contacts().release_by_speed(instant, pair.id.body); !failure.empty())
    return run_.fail(t, describe_lasting(pair.id.body, failure));
  if (!rest(instant, pair, impact, restitution, !is_hit)) return;
  const bool stops = settle_other_contacts(run_.world(), run_.encounters(), pair, impact, instant, run_.recorder());
  go_on_from(index, pair, instant);
  if (stops) return run_.stop();
  run_.advance(index);
}

void ContactHandler::bounce_off(int index, Pair pair, Impact impact) {
  Course& moving = run_.course(index);
  const World::Body& body = body_of(pair);
  const World::Obstacle& obstacle = obstacle_of(pair);
  const double t = impact.elapsed;
  const std::optional<FrameMotion> surface = run_.encounters().frame(pair.id.obstacle, t);
  const Eigen::VectorXd q = moving.state(t);
  const NormalMotion before = normal_motion(run_.world(), pair, surface, q, moving.rate(t, q));
  if (before.speed > 0.0 && pair.memory.contact_time == t) {
    // what moves away from the contact that it has just left has not hit
    const double height = before.speed * std::abs(moving.segment().t1() - t);
    if (run_.encounters().stay_in_contact(pair.id, moving, height)) {
      run_.encounters().search(pair.id.body, moving, moving.next().time);
      return run_.enqueue(index);
    }
  }
  Bounce& last = last_bounces_[static_cast<std::size_t>(pair.id.body)];
  const Bounce flight = std::exchange(last, Bounce{pair.id.obstacle, t, pair.contact.point});
  const auto end = [&](const std::string& reason) {
    run_.recorder().sample(t, pair.id.body, SamplePhase::before);
    run_.recorder().impact(impact);
    run_.fail(t, reason);
  };
  if (const std::string reason = why_it_cannot_bounce(body, surface_of(pair)); !reason.empty()) return end(reason);
  Instant instant(moving, t);
  const double speed = std::max(0.0, -before.speed);
  const double restitution = surface_of(pair).restitution.at(speed);
  if (!(restitution >= 0.0 && restitution <= 1.0))
    return run_.fail(t, describe_restitution(obstacle, surface_of(pair), restitution, speed));
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
  const bool stays = is_again && is_low;
  if (!stays && before.speed < 0.0 && is_hit(pair.contact) && run_.groups().handle(index, pair)) return;
  run_.recorder().sample(t, pair.id.body, SamplePhase::before);
  if (stays) return stay(index, pair, impact, instant);
  const double gained =
      bounce_solid(run_.world(), pair, surface, restitution, mass_of(body, t, instant.q), instant, impact);
  // what lies there has not hit
  if (is_hit(pair.contact) && before.speed < 0.0) run_.recorder().impact(impact);
  if (gained > 0.0) run_.recorder().warn_of_gain(impact, gained);
  warn_of_hidden_ties(run_.world(), run_.encounters(), pair, impact, moving, run_.recorder());
  if (does_not_fly(instant, pair)) return stay(index, pair, impact, instant);
  if (const std::string failure = run_.lasting_contacts().release_by_speed(instant, pair.id.body); !failure.empty())
    return run_.fail(t, describe_lasting(pair.id.body, failure));
  instant.memories.insert(instant.memories.begin(), {pair.id, rebounded(pair.contact.memory)});
  run_.go_on(index, instant);
  run_.recorder().sample(t, pair.id.body, SamplePhase::after);
  run_.advance(index);
}

bool ContactHandler::does_not_fly(const Instant& instant, const Pair& pair) const {
  const std::optional<FrameMotion> surface = run_.encounters().frame(pair.id.obstacle, instant.time());
  const NormalMotion motion = normal_motion(run_.world(), pair, surface, instant.q, instant.rate());
  return motion.acceleration <= 0.0 &&
         is_below_flight(std::max(0.0, motion.speed), -motion.acceleration, pair.contact.memory.tolerance);
}

bool ContactHandler::begin_stay(Instant& instant, const Pair& pair, const Impact& impact) {
  const double t = instant.time();
  const World::Body& body = body_of(pair);
  const auto fail = [&](const std::string& why) {
    run_.fail(t, "body '" + body.name + "' comes to rest on obstacle '" + obstacle_of(pair).name + "', " + why);
    return false;
  };
  const auto contact = run_.lasting_contacts().contact_at(instant, pair.id, impact.point, impact.normal);
  if (!contact)
    return fail(
        "where trajet cannot follow it: contact that lasts is of corners, edges and faces of convex "
        "solids on flat faces");
  if (!body.inertia) return fail("and what becomes of that needs its inertia: give it a `mass` or a `density`");
  const double rest_time = t + run_.lasting_contacts().lay_flat(instant, *contact, pair);
  const std::string failure = run_.lasting_contacts().begin(instant, *contact, impact, rest_time);
  return failure.empty() || fail(failure);
}

void ContactHandler::stay(int index, const Pair& pair, const Impact& impact, Instant& instant) {
  if (!begin_stay(instant, pair, impact)) return;
  go_on_from(index, pair, instant);
  run_.advance(index);
}

bool ContactHandler::settle(Instant& instant, const Pair& pair, const Impact& impact, double restitution) {
  if (is_round(body_of(pair).solid)) return rest(instant, pair, impact, restitution, false);
  return !does_not_fly(instant, pair) || begin_stay(instant, pair, impact);
}

void ContactHandler::go_on_from(int index, const Pair& pair, Instant& instant) {
  ContactMemory memory = rebounded(pair.contact.memory);
  memory.contact_time = instant.time();
  instant.memories.insert(instant.memories.begin(), {pair.id, memory});
  run_.go_on(index, instant);
  run_.recorder().sample(instant.time(), pair.id.body, SamplePhase::after);
  run_.lasting_contacts().record_until(instant.time());
}

bool ContactHandler::rest(Instant& instant, const Pair& pair, const Impact& impact, double restitution,
                          bool is_hidden) {
  const World::Body& body = body_of(pair);
  const World::Obstacle& obstacle = obstacle_of(pair);
  const double t = instant.time();
  const RelativeMotion motion = run_.encounters().relative_motion(pair.id, t, instant.q, instant.rate());
  const double speed = std::max(0.0, impact.normal.dot(motion.velocity));
  std::optional<RestingContact> contact =
      run_.lasting_contacts().contact_at(instant, pair.id, impact.point, impact.normal);
  const bool is_flat = contact && contact->patch.is_flat() && !obstacle.drive;
  // what is curved presses by how fast the body moves along it
  const double pull = !contact || is_flat ? -impact.normal.dot(motion.acceleration)
                                          : run_.lasting_contacts().pull_on(instant, *contact);
  const double tolerance = pair.contact.memory.tolerance;
  const bool is_low =
      restitution < 1.0 ? is_hidden || is_below_flight(speed, pull, tolerance) : is_lying(speed, pull, tolerance);
  if (pull <= 0.0 || !is_low) return true;
  const auto fail = [&](const std::string& why) {
    run_.fail(t, "body '" + body.name + "' comes to rest on obstacle '" + obstacle.name + "', " + why);
    return false;
  };
  if (!contact) return fail("on a part of it where trajet cannot follow it");
  // a velocity so much smaller than it was is what rounding leaves of one that was stopped
  constexpr double kStopped = 1e-12;
  Vector3 along = instant.q.segment<3>(body.offset + 3);
  along -= along.dot(impact.normal) * impact.normal;
  const bool is_stopped = along.norm() <= kStopped * impact.velocity_before.norm();
  if (is_flat && bounding_radius(body.solid) > 0.0 && !is_stopped &&
      moves_off(face_outline(obstacle.shape, impact.point, impact.normal), impact.position, along)) {
    if (const auto next = run_.lasting_contacts().continuation(*contact, instant.q)) {
      contact = run_.lasting_contacts().contact_at(instant, *next, impact.point, impact.normal);
    } else {
      contact = run_.lasting_contacts().next_patch(instant, *contact);
    }
    if (!contact) return fail("at an edge over which trajet cannot follow it");
  }
  const std::string failure =
      run_.lasting_contacts().begin(instant, *contact, impact, t + bouncing_time(speed, pull, restitution));
  return failure.empty() || fail(failure);
}

std::string ContactHandler::describe_lasting(int body, const std::string& failure) const {
  return "body '" + run_.world().bodies[static_cast<std::size_t>(body)].name + "' in contact: " + failure;
}

double ContactHandler::end_of_pull(const Course& moving, const Crossing& crossing) const {
  const double direction = run_.world().direction();
  const double known = crossing.time + direction * 2.0 * crossing.error_bound;
  bool is_next = direction * (moving.segment().t1() - known) > 0.0;
  for (const int body : moving.group().bodies) {
    const Pair* pair = run_.encounters().first(body);
    const Meeting* meeting = run_.meetings().first(body);
    is_next = is_next && (pair == nullptr || direction * (pair->contact.time - known) > 0.0) &&
              (meeting == nullptr || direction * (meeting->contact.time - known) > 0.0);
  }
  return is_next ? known : crossing.time;
}

void ContactHandler::handle_end(int index) {
  Course& moving = run_.course(index);
  const Crossing crossing = moving.next();
  const double time = crossing.kind == Crossing::Kind::pull ? end_of_pull(moving, crossing) : crossing.time;
  Instant instant(moving, time);
  const int body = instant.contacts[static_cast<std::size_t>(crossing.index)].body;
  if (last_changes_[static_cast<std::size_t>(body)].count_at(time) > kMaxImpactsAtOnce)
    return run_.fail(time, describe_lasting(body, "how it goes on changes without an end at one instant"));
  run_.recorder().sample(time, body, SamplePhase::before);
  run_.recorder().sample(time, body, SamplePhase::after);
  const std::string failure = run_.lasting_contacts().handle_end(instant, crossing.index, crossing.end, crossing.detail,
                                                                 crossing.error_bound + std::abs(time - crossing.time));
  if (!failure.empty()) return run_.fail(time, describe_lasting(body, failure));
  run_.go_on(index, instant);
  run_.advance(index);
}

}  // namespace trajet
