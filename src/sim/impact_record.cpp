#include "impact_record.hpp"

#include "body_state.hpp"

namespace trajet {
namespace {

Impact without_impulse(const World& world, PairId id, const Eigen::VectorXd& q) {
  const World::Body& body = world.bodies[static_cast<std::size_t>(id.body)];
  Impact impact;
  impact.body = body.name;
  impact.with = world.obstacles[static_cast<std::size_t>(id.obstacle)].name;
  impact.position = q.segment<3>(body.offset);
  impact.velocity_before = impact.velocity_after = q.segment<3>(body.offset + 3);
  impact.angular_velocity_before = impact.angular_velocity_after = angular_velocity(body, q);
  impact.impulse = Vector3::Zero();
  return impact;
}

}  // namespace

Impact describe(const World& world, const Pair& pair, const Eigen::VectorXd& q) {
  Impact impact = without_impulse(world, pair.id, q);
  impact.elapsed = pair.contact.time;
  impact.kind = pair.contact.status == ContactStatus::graze ? ImpactKind::graze : ImpactKind::hit;
  impact.point = pair.contact.point;
  impact.normal = pair.contact.normal;
  impact.time_error_bound = pair.contact.time_error_bound;
  impact.touched = pair.contact.touched;
  return impact;
}

Impact describe(const World& world, const RestingContact& contact, ImpactKind kind, double time,
                const Eigen::VectorXd& q) {
  Impact impact = without_impulse(world, {contact.body, contact.obstacle}, q);
  impact.elapsed = time;
  impact.kind = kind;
  impact.normal = contact.normal;
  impact.point =
      impact.position - bounding_radius(world.bodies[static_cast<std::size_t>(contact.body)].solid) * contact.normal;
  return impact;
}

}  // namespace trajet
