// What of lasting contacts is sticking: a body takes the motion of the obstacle that it hits, and keeps it until an
// event lets it go.

#include <algorithm>

#include "body_state.hpp"
#include "contact_handler.hpp"
#include "impact_record.hpp"
#include "impact_sides.hpp"
#include "lasting_contacts.hpp"
#include "solid_bounce.hpp"
#include "sustained.hpp"
#include "ties.hpp"
#include "trajet/portable.hpp"
#include "trajet/rigid/kinematics.hpp"

namespace trajet {
namespace {

/// The angular velocity of an obstacle as the state of a body holds its own.
Vector3 turning_of(const World::Body& body, const std::optional<FrameMotion>& surface, const Eigen::VectorXd& q) {
  if (!surface) return Vector3::Zero();
  return body.rotation->layout.frame == Frame::world
             ? surface->w
             : Vector3(rotation_of(body, body.slice(), q).transpose() * surface->w);
}

/// The derivative of the state behind by the one before, at one time, where the body has taken the obstacle's motion.
Eigen::MatrixXd derivative_of_sticking(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface,
                                       const Instant& instant) {
  const World::Body& body = world.bodies[static_cast<std::size_t>(pair.id.body)];
  const BodySlice slice = body.slice();
  const Eigen::VectorXd& before = instant.before();
  const Eigen::VectorXd rate = instant.course().rate(instant.time(), before);
  Eigen::MatrixXd derivative = instant.derivative;
  derivative.middleRows<3>(slice.velocity_index()).setZero();
  if (body.rotation) derivative.middleRows<3>(slice.angular_velocity_index()).setZero();
  Vector3 faster = Vector3::Zero();  // of what the obstacle is at a fixed place
  if (surface) {
    derivative.block<3, 3>(slice.velocity_index(), slice.position_index()) = cross_matrix(surface->w);
    const Vector3 arm = Vector3(slice.position(before)) - surface->p;
    faster = surface->acceleration + surface->w_rate.cross(arm) - surface->w.cross(surface->v);
  }
  // states near this one stick at a time of their own: dt = -dg / g'
  const NormalMotion motion = normal_motion(world, pair, surface, before, rate);
  if (!(motion.speed < 0.0)) return derivative;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(before.size());
  if (pair.contact.touched)
    gradient = gap_gradient(world, pair, before);
  else
    slice.position(gradient) = pair.contact.normal;
  Eigen::VectorXd jump = derivative * rate - instant.rate();
  slice.velocity(jump) += faster;
  if (body.rotation) slice.angular_velocity(jump).setZero();
  derivative += jump * (-gradient.transpose() / motion.speed);
  return derivative;
}

}  // namespace

void ContactHandler::stick(int index, const Pair& pair, Impact impact) {
  const double t = impact.elapsed;
  Instant instant(run_.course(index), t);
  run_.recorder().sample(t, pair.id.body, SamplePhase::before);
  if (const std::string failure = run_.lasting_contacts().stick(instant, pair.id, impact); !failure.empty())
    return run_.fail(
        t, "body '" + body_of(pair).name + "' sticks to obstacle '" + obstacle_of(pair).name + "', " + failure);
  const bool stops = settle_other_contacts(run_.world(), run_.encounters(), pair, impact, instant, run_.recorder());
  go_on_from(index, pair, instant);
  if (stops) return run_.stop();
  run_.advance(index);
}

std::string LastingContacts::stick(Instant& instant, PairId id, Impact& impact) {
  const World::Body& body = this->body(id.body);
  const BodySlice slice = body.slice();
  const double t = instant.time();
  const std::optional<FrameMotion> surface = encounters_.frame(id.obstacle, t);
  for (std::size_t i = instant.contacts.size(); i-- > 0;) {
    if (instant.contacts[i].body != id.body) continue;
    record(instant.contacts[i], ImpactKind::leave, t, instant.before());
    end(instant, static_cast<int>(i));
  }
  const auto at_start = [&](const Vector3& place) { return surface ? surface->to_start(place) : place; };
  const Vector3 normal = surface ? Vector3(surface->R.transpose() * impact.normal) : impact.normal;
  RestingContact contact{id.body, id.obstacle, body.offset, normal, at_start(impact.point), normal};
  contact.is_plain = false;
  contact.stuck_at = at_start(impact.position);
  if (!stuck_law(world_, instant.course().group().law, contact))
    return "whose motion is by a table, and the velocity of that is not known";
  slice.velocity(instant.q) = surface ? surface->velocity_at(impact.position) : Vector3(0, 0, 0);
  if (body.rotation) slice.angular_velocity(instant.q) = turning_of(body, surface, instant.q);
  instant.contacts.push_back(contact);
  instant.derivative = derivative_of_sticking(world_, encounters_.pair(id), surface, instant);

  impact.kind = ImpactKind::stick;
  impact.velocity_after = slice.velocity(instant.q);
  impact.angular_velocity_after = angular_velocity(body, instant.q);
  impact.impulse = mass_of(body, t, instant.q) * (impact.velocity_after - impact.velocity_before);
  recorder_.impact(impact);
  recorder_.contact(t, id, ImpactKind::stick);
  return "";
}

void LastingContacts::let_go(Instant& instant, const RestingContact& contact) {
  const PairId id{contact.body, contact.obstacle};
  const std::optional<FrameMotion> surface = encounters_.frame(id.obstacle, instant.time());
  Impact impact = describe(world_, contact, ImpactKind::leave, instant.time(), instant.before());
  impact.velocity_after = instant.q.segment<3>(contact.offset + 3);
  impact.angular_velocity_after = angular_velocity(body(id.body), instant.q);
  impact.point = surface ? surface->from_start(contact.point) : contact.point;
  impact.normal = surface ? Vector3(surface->R * contact.normal) : contact.normal;
  recorder_.impact(impact);
  // what steps have let it drift is contact still
  constexpr double kDrift = 1e-10;  // of its place and size
  ContactMemory memory = encounters_.pair(id).memory;
  memory.contact_time = instant.time();
  memory.tolerance =
      std::max(memory.tolerance, kDrift * (impact.position.norm() + bounding_radius(body(id.body).solid)));
  const auto place = ranges::find_if(instant.contacts, [&](const RestingContact& each) { return &each == &contact; });
  end(instant, static_cast<int>(place - instant.contacts.begin()));
  instant.memories.emplace_back(id, memory);
}

}  // namespace trajet
