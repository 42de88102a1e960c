#include "group_handler.hpp"

#include <map>
#include <set>

#include "body_bounce.hpp"
#include "body_state.hpp"
#include "contact_handler.hpp"
#include "group_bounce.hpp"
#include "impact_record.hpp"
#include "impact_sides.hpp"
#include "ties.hpp"
#include "trajet/collide/sustain/rest.hpp"

namespace trajet {
namespace {

Pair as_pair(const GroupedContact& contact) {
  return {.id = {contact.first, contact.obstacle}, .is_lasting = contact.is_lasting, .contact = contact.contact};
}
Meeting as_meeting(const GroupedContact& contact) {
  return {.id = {contact.first, contact.second}, .contact = contact.contact};
}

/// What is known of a pair behind an impact at time t, from which it does not go through.
ContactMemory memory_behind(const ContactResult& contact, double t) {
  ContactMemory memory = rebounded(contact.memory);
  memory.contact_time = t;
  return memory;
}

}  // namespace

bool GroupHandler::handle(int course, const Pair& met) {
  return handle(course, {.first = met.id.body,
                         .obstacle = met.id.obstacle,
                         .contact = met.contact,
                         .surface = run_.world().surface(met.id.body, met.id.obstacle),
                         .is_met = true});
}

bool GroupHandler::handle(int course, const Meeting& met) {
  return handle(course, {.first = met.id.first,
                         .second = met.id.second,
                         .contact = met.contact,
                         .surface = run_.world().surface_of_bodies(met.id.first, met.id.second),
                         .is_met = true});
}

bool GroupHandler::handle(int index, const GroupedContact& seed) {
  const std::vector<GroupedContact> contacts = contacts_at_once(run_, seed);
  if (contacts.size() == 1 && contacts.front().points.size() < 2) return false;
  const World& world = run_.world();
  const double t = seed.contact.time;
  std::set<int> bodies;
  std::map<int, Instant> instants;
  for (const GroupedContact& contact : contacts)
    for (const int each : {contact.first, contact.second})
      if (each >= 0) bodies.insert(each);
  for (const int each : bodies) {
    const int course = run_.course_of(each);
    instants.try_emplace(course, run_.course(course), t);
  }
  std::vector<std::optional<FrameMotion>> surfaces;
  for (const GroupedContact& contact : contacts)
    surfaces.push_back(contact.second < 0 ? run_.encounters().frame(contact.obstacle, t) : std::nullopt);
  GroupBounce bounce(world, contacts, instants, std::move(surfaces));
  const GroupResponse& response = bounce.response();
  // an impact at one point alone is resolved by itself
  if (response.status == GroupResponse::Status::resolved &&
      (bounce.is_of_first_alone() || is_known_alone(contacts, bounce)))
    return false;

  // at one instant, events come first, those of the other courses too
  for (const auto& [other, instant] : instants) {
    if (other == index || !run_.has_event_at(other, t)) continue;
    run_.enqueue(index);
    run_.handle_event(other, t);
    return true;
  }
  for (const int each : bodies) run_.recorder().sample(t, each, SamplePhase::before);
  if (const std::string failure = describe_failure(contacts, bounce); !failure.empty()) {
    run_.fail(t, failure);
    return true;
  }
  std::map<int, Eigen::MatrixXd> errors;
  for (const auto& [course, instant] : instants) errors[course] = run_.course(course).error_columns(t);
  bounce.apply(errors);
  const std::vector<Impact> all = impacts(contacts, bounce, instants);
  std::vector<Impact> pushing;
  for (const Impact& each : all)
    if (!each.impulse.isZero(0.0)) pushing.push_back(each);
  run_.recorder().impacts(pushing);
  if (!settle(contacts, all, bounce, instants)) return true;

  bool stops = false;
  std::set<int> settled;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const GroupedContact& contact = contacts[i];
    if (contact.second >= 0 || !contact.is_met || !settled.insert(contact.first).second) continue;
    Instant& instant = instants.at(run_.course_of(contact.first));
    stops =
        settle_other_contacts(world, run_.encounters(), as_pair(contact), all[i], instant, run_.recorder()) || stops;
  }
  for (const GroupedContact& contact : contacts) {
    if (contact.second >= 0 || contact.is_lasting) continue;
    auto& memories = instants.at(run_.course_of(contact.first)).memories;
    memories.insert(memories.begin(), {{contact.first, contact.obstacle}, memory_behind(contact.contact, t)});
  }
  for (const auto& [course, instant] : instants) run_.go_on(course, instant);
  for (const GroupedContact& contact : contacts)
    if (contact.second >= 0)
      run_.meetings().remember({contact.first, contact.second}, memory_behind(contact.contact, t));
  for (const int each : bodies) run_.recorder().sample(t, each, SamplePhase::after);
  run_.lasting_contacts().record_until(t);
  if (stops) {
    run_.stop();
    return true;
  }
  for (const auto& [course, instant] : instants) run_.advance(course);
  return true;
}

bool GroupHandler::is_known_alone(const std::vector<GroupedContact>& contacts, const GroupBounce& bounce) const {
  // of what pushes most, so little is what rounding makes of nothing
  constexpr double kNoImpulse = 1e-12;
  double most = 0.0, rubbing = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double impulse = bounce.impulse(i).norm();
    most = std::max(most, impulse);
    const ImpactFriction friction = friction_of(contacts[i].surface);
    if (friction.tangential_restitution || (friction.acts() && !contacts[i].points.empty()))
      rubbing = std::max(rubbing, impulse);
  }
  return rubbing > kNoImpulse * most;
}

std::string GroupHandler::names(const GroupedContact& contact) const {
  const std::string& other = contact.second >= 0
                                 ? body(contact.second).name
                                 : run_.world().obstacles[static_cast<std::size_t>(contact.obstacle)].name;
  return "'" + body(contact.first).name + "' with '" + other + "'";
}

std::string GroupHandler::describe_failure(const std::vector<GroupedContact>& contacts,
                                           const GroupBounce& bounce) const {
  const GroupResponse& response = bounce.response();
  if (response.status == GroupResponse::Status::jammed)
    return "body '" + body(contacts.front().first).name +
           "' is jammed: no velocity is left that all let it have which it touches at this instant, " +
           names(contacts.front()) + " among them";
  if (response.status != GroupResponse::Status::impossible) return {};
  const GroupedContact& contact = contacts[bounce.contact_of(response.contact)];
  return describe_impossible_restitution("the contact of " + names(contact), contact.surface,
                                         contact.surface.restitution.at(response.speed), response.speed);
}

std::vector<Impact> GroupHandler::impacts(const std::vector<GroupedContact>& contacts, const GroupBounce& bounce,
                                          const std::map<int, Instant>& instants) const {
  const World& world = run_.world();
  const double t = contacts.front().contact.time;
  std::vector<Impact> impacts;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const GroupedContact& contact = contacts[i];
    const Instant& first = instants.at(run_.course_of(contact.first));
    Impact& impact = impacts.emplace_back();
    if (contact.second >= 0) {
      const Instant& second = instants.at(run_.course_of(contact.second));
      impact = describe(world, as_meeting(contact), first.before(), second.before());
      impact.partner->velocity_after = body(contact.second).slice().velocity(second.q);
      impact.partner->angular_velocity_after = angular_velocity(body(contact.second), second.q);
    } else {
      impact = describe(world, as_pair(contact), run_.encounters().frame(contact.obstacle, t), first.before());
    }
    impact.elapsed = t;
    impact.velocity_after = body(contact.first).slice().velocity(first.q);
    impact.angular_velocity_after = angular_velocity(body(contact.first), first.q);
    impact.impulse = bounce.impulse(i);
    if (!contact.points.empty()) impact.point = bounce.point(i);
  }
  return impacts;
}

bool GroupHandler::settle(const std::vector<GroupedContact>& contacts, const std::vector<Impact>& impacts,
                          const GroupBounce& bounce, std::map<int, Instant>& instants) {
  const World& world = run_.world();
  const double t = contacts.front().contact.time;
  for (auto& [course, instant] : instants)
    for (const int each : instant.course().group().bodies)
      if (const std::string failure = run_.lasting_contacts().release_by_speed(instant, each); !failure.empty()) {
        run_.fail(t, "body '" + body(each).name + "' in contact: " + failure);
        return false;
      }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const GroupedContact& contact = contacts[i];
    Instant& first = instants.at(run_.course_of(contact.first));
    const double approach = bounce.approach(i);
    if (contact.second < 0) {
      if (contact.is_lasting || !contact.is_met) continue;
      if (!contacts_.settle(first, as_pair(contact), impacts[i], contact.surface.restitution.at(approach)))
        return false;
      continue;
    }
    const Instant& second = instants.at(run_.course_of(contact.second));
    const GapMotion gap = gap_motion(world, as_meeting(contact), first.q, first.rate(), second.q, second.rate());
    if (gap.acceleration < 0.0 &&
        is_below_flight(std::max(0.0, gap.speed), -gap.acceleration, contact.contact.memory.tolerance)) {
      run_.fail(t, "bodies " + names(contact) +
                       " come to rest against each other: contact of bodies that lasts is not computed yet");
      return false;
    }
  }
  return true;
}

}  // namespace trajet
