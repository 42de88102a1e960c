#include "meeting_handler.hpp"

#include <cmath>

#include "body_bounce.hpp"
#include "body_state.hpp"
#include "group_handler.hpp"
#include "impact_record.hpp"
#include "impact_sides.hpp"
#include "last_contact.hpp"
#include "trajet/collide/sustain/rest.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {
namespace {

/// How the gap changes where the courses are at the contact.
GapMotion gap_motion_of(const World& world, const Meeting& meeting, const Course& first, const Course& second) {
  const double t = meeting.contact.time;
  const Eigen::VectorXd a = first.state(t), b = second.state(t);
  return gap_motion(world, meeting, a, first.rate(t, a), b, second.rate(t, b));
}

}  // namespace

MeetingHandler::MeetingHandler(const RunControl& control)
    : run_(control), last_impacts_(control.world().bodies.size()) {}

std::string MeetingHandler::names(const Meeting& meeting) const {
  return "'" + body(meeting.id.first).name + "' with '" + body(meeting.id.second).name + "'";
}

void MeetingHandler::handle(int course, const Meeting& met) {
  const Meeting found = met;
  const double time = found.contact.time;
  // at one instant, events come first, those of the other course too
  const int other =
      run_.course_of(found.id.first) == course ? run_.course_of(found.id.second) : run_.course_of(found.id.first);
  if (run_.has_event_at(other, time)) {
    run_.enqueue(course);
    return run_.handle_event(other, time);
  }
  const World& world = run_.world();
  const Surface surface = world.surface_of_bodies(found.id.first, found.id.second);
  if (found.contact.status == ContactStatus::overlapping_at_start) {
    if (surface.on_hit == OnHit::pass) {
      run_.meetings().pass(found.id);
      return pass_on(found);
    }
    const std::string bodies = "bodies '" + body(found.id.first).name + "' and '" + body(found.id.second).name + "'";
    if (time == 0.0) throw InputError(body(found.id.second).where, bodies + " overlap at the start");
    return run_.fail(time, bodies + " overlap");
  }
  if (found.contact.status == ContactStatus::unresolved)
    return run_.fail_unresolved(time, body(found.id.first).name, body(found.id.second).name, "");
  for (const int each : {found.id.first, found.id.second})
    if (last_impacts_[static_cast<std::size_t>(each)].count_at(time) > kMaxImpactsAtOnce)
      return run_.fail(time,
                       "body '" + body(each).name + "' has impact after impact at one instant, here " + names(found));
  if (world.direction() < 0.0) return run_.fail(time, names(found) + ": impacts have no meaning backward in time");
  if (moves_on_alike(found)) return pass_on(found);
  if (const std::string doubt = describe_doubt(found); !doubt.empty())
    return run_.fail_unresolved(time, body(found.id.first).name, body(found.id.second).name, doubt);

  Meeting meeting = found;
  ContactResult& contact = meeting.contact;
  Course &first = first_course(meeting), &second = second_course(meeting);
  contact.time_error_bound = contact.time_resolution + contact.time_error(gap_error(world, meeting, first, second));
  const Impact impact = describe(world, meeting, first.state(time), second.state(time));
  const bool is_hit = contact.status == ContactStatus::hit && contact.direction != ContactDirection::leaving;
  if (is_hit && surface.on_hit == OnHit::bounce) {
    if (goes_on_from_contact(meeting)) return pass_on(meeting);
    if (!sticks(meeting.id.first) || !sticks(meeting.id.second)) return bounce(meeting, surface, impact);
    // obstacles, to which they stick, go through each other
    run_.meetings().pass(meeting.id);
    return pass_on(meeting);
  }
  if (is_hit && surface.on_hit == OnHit::stop) {
    sample(meeting, SamplePhase::before);
    run_.recorder().sample(time);
    run_.recorder().impact(impact);
    return run_.stop();
  }
  record(meeting, impact);
  run_.meetings().pass(meeting.id);
  pass_on(meeting);
}

bool MeetingHandler::sticks(int body) const {
  return sticking_contact(run_.course(run_.course_of(body)).held_law().contacts(), body) != nullptr;
}

void MeetingHandler::pass_on(const Meeting& meeting) {
  const int first = run_.course_of(meeting.id.first), second = run_.course_of(meeting.id.second);
  run_.pass_on(first);
  if (second != first) run_.pass_on(second);
}

void MeetingHandler::sample(const Meeting& meeting, SamplePhase phase) {
  run_.recorder().sample(meeting.contact.time, meeting.id.first, phase);
  run_.recorder().sample(meeting.contact.time, meeting.id.second, phase);
}

void MeetingHandler::record(const Meeting& meeting, const Impact& impact) {
  sample(meeting, SamplePhase::before);
  sample(meeting, SamplePhase::after);
  run_.recorder().impact(impact);
}

std::string MeetingHandler::describe_doubt(const Meeting& meeting) {
  if (meeting.contact.status != ContactStatus::hit) return {};
  const World::Body &a = body(meeting.id.first), &b = body(meeting.id.second);
  Course &first = first_course(meeting), &second = second_course(meeting);
  const double time = meeting.contact.time;
  const GapMotion gap = gap_motion_of(run_.world(), meeting, first, second);
  if (gap.speed >= 0.0 || is_lying(-gap.speed, std::max(0.0, -gap.acceleration), meeting.contact.memory.tolerance))
    return {};
  const auto error_of = [&](Course& course, const World::Body& each) {
    Eigen::VectorXd along = Eigen::VectorXd::Zero(course.segment().dimension());
    along.segment<3>(each.slice().velocity_index()) = meeting.contact.normal;
    return course.velocity_error(along, time);
  };
  const double error = error_of(first, a) + error_of(second, b);
  if (!(error >= -gap.speed)) return {};
  return "they approach with " + shortest_text(-gap.speed) + " m/s, and the velocities may be off by " +
         shortest_text(error) + " m/s: choose a finer tolerance or step";
}

bool MeetingHandler::moves_on_alike(const Meeting& meeting) {
  const World& world = run_.world();
  if (meeting.contact.status != ContactStatus::hit ||
      world.surface_of_bodies(meeting.id.first, meeting.id.second).on_hit != OnHit::bounce)
    return false;
  const double time = meeting.contact.time;
  double speed = 0.0, acceleration = 0.0, size = 0.0;
  for (const int each : {meeting.id.first, meeting.id.second}) {
    const Course& course = run_.course(run_.course_of(each));
    const BodySlice slice = body(each).slice();
    const Eigen::VectorXd q = course.state(time);
    const double radius = bounding_radius(body(each).solid);
    speed += Vector3(slice.velocity(q)).norm() + radius * angular_velocity(body(each), q).norm();
    acceleration += Vector3(slice.velocity(course.rate(time, q))).norm();
    size += Vector3(slice.position(q)).norm() + radius;
  }
  constexpr double kFewRoundings = 64.0 * kUnitRoundoff;
  const GapMotion gap = gap_motion_of(world, meeting, first_course(meeting), second_course(meeting));
  if (gap.speed < -kFewRoundings * speed || gap.speed > 0.0 || gap.acceleration < -kFewRoundings * acceleration)
    return false;
  return run_.meetings().stay_in_touch(meeting.id, kFewRoundings * size);
}

bool MeetingHandler::goes_on_from_contact(const Meeting& meeting) {
  const Course &first = first_course(meeting), &second = second_course(meeting);
  const GapMotion gap = gap_motion_of(run_.world(), meeting, first, second);
  if (gap.speed <= 0.0) return false;
  // of the flight: u^2 / (2 g), or where nothing pulls back, that on what was searched
  const double left = std::min(std::abs(first.segment().t1() - meeting.contact.time),
                               std::abs(second.segment().t1() - meeting.contact.time));
  const double height = gap.acceleration < 0.0 ? gap.speed * gap.speed / (-2.0 * gap.acceleration) : gap.speed * left;
  return run_.meetings().stay_in_contact(meeting.id, height);
}

void MeetingHandler::bounce(const Meeting& meeting, const Surface& surface, Impact impact) {
  const World& world = run_.world();
  const double t = meeting.contact.time;
  const auto end = [&](const std::string& reason) {
    record(meeting, impact);
    run_.fail(t, reason);
  };
  for (const int each : {meeting.id.first, meeting.id.second}) {
    const World::Body& one = body(each);
    if (sticks(each)) continue;
    if (!one.mass)
      return end("bodies " + names(meeting) + " meet, and what becomes of that needs their masses: give '" + one.name +
                 "' a `mass` or a `density`");
    if (const std::string reason = why_it_cannot_bounce(one, surface); !reason.empty()) return end(reason);
  }
  const int first_index = run_.course_of(meeting.id.first), second_index = run_.course_of(meeting.id.second);
  Course &first = run_.course(first_index), &second = run_.course(second_index);
  const double speed = std::max(0.0, -gap_motion_of(world, meeting, first, second).speed);
  const double restitution = surface.restitution.at(speed);
  if (!(restitution >= 0.0 && restitution <= 1.0))
    return end(describe_impossible_restitution("bodies " + names(meeting), surface, restitution, speed));

  if (run_.groups().handle(first_index, meeting)) return;
  for (const Meeting::Id& id : run_.meetings().met_at_once(meeting))
    run_.recorder().warn_of_tie(impact, body(id.first).name, body(id.second).name);
  sample(meeting, SamplePhase::before);
  Instant instant_first(first, t), other(second, t);
  Instant& instant_second = first_index == second_index ? instant_first : other;
  const double gained = bounce_bodies(world, meeting, surface, restitution, first.error_columns(t),
                                      second.error_columns(t), instant_first, instant_second, impact);
  run_.recorder().impact(impact);
  if (gained > 0.0) run_.recorder().warn_of_gain(impact, gained);
  for (const auto& [instant, moved] :
       {std::pair(&instant_first, meeting.id.first), {&instant_second, meeting.id.second}})
    if (const std::string failure = run_.lasting_contacts().release_by_speed(*instant, moved); !failure.empty())
      return run_.fail(t, "body '" + body(moved).name + "' in contact: " + failure);
  const GapMotion after =
      gap_motion(world, meeting, instant_first.q, instant_first.rate(), instant_second.q, instant_second.rate());
  if (after.acceleration < 0.0 &&
      is_below_flight(std::max(0.0, after.speed), -after.acceleration, meeting.contact.memory.tolerance))
    return run_.fail(t, "bodies " + names(meeting) + " come to rest against each other: contact of bodies that lasts " +
                            "is not computed yet");
  run_.go_on(first_index, instant_first);
  if (second_index != first_index) run_.go_on(second_index, instant_second);
  ContactMemory memory = rebounded(meeting.contact.memory);
  memory.contact_time = t;
  run_.meetings().remember(meeting.id, memory);
  sample(meeting, SamplePhase::after);
  run_.lasting_contacts().record_until(t);
  run_.advance(first_index);
  if (second_index != first_index) run_.advance(second_index);
}

}  // namespace trajet
