#include "impact_record.hpp"

#include "body_state.hpp"
#include "trajet/collide/detect/ball_features.hpp"

namespace trajet {
namespace {

Impact without_impulse(const World::Body& body, const std::string& with, const Eigen::VectorXd& q) {
  Impact impact;
  impact.body = body.name;
  impact.with = with;
  impact.position = q.segment<3>(body.offset);
  impact.velocity_before = impact.velocity_after = q.segment<3>(body.offset + 3);
  impact.angular_velocity_before = impact.angular_velocity_after = angular_velocity(body, q);
  impact.impulse = Vector3::Zero();
  return impact;
}

void put_contact(const ContactResult& contact, Impact& impact) {
  impact.elapsed = contact.time;
  impact.kind = contact.status == ContactStatus::graze ? ImpactKind::graze : ImpactKind::hit;
  impact.point = contact.point;
  impact.normal = contact.normal;
  impact.time_error_bound = contact.time_error_bound;
  impact.touched = contact.touched;
}

const World::Body& body_at(const World& world, int index) { return world.bodies[static_cast<std::size_t>(index)]; }

const std::string& name_of_obstacle(const World& world, int index) {
  return world.obstacles[static_cast<std::size_t>(index)].name;
}

}  // namespace

Impact describe(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface,
                const Eigen::VectorXd& q) {
  const World::Body& body = body_at(world, pair.id.body);
  Impact impact = without_impulse(body, name_of_obstacle(world, pair.id.obstacle), q);
  put_contact(pair.contact, impact);
  if (impact.touched) return impact;
  // shapes stand where they stood at the start
  const Vector3 point = surface ? surface->to_start(impact.point) : impact.point;
  const Vector3 normal = surface ? Vector3(surface->R.transpose() * impact.normal) : impact.normal;
  const Shape& shape = world.obstacles[static_cast<std::size_t>(pair.id.obstacle)].shape;
  impact.touched = features_of_ball(bounding_radius(body.solid), shape, point, normal);
  impact.touched->points = {impact.point};
  return impact;
}

Impact describe(const World& world, const Meeting& meeting, const Eigen::VectorXd& q_first,
                const Eigen::VectorXd& q_second) {
  const World::Body& other = body_at(world, meeting.id.second);
  Impact impact = without_impulse(body_at(world, meeting.id.first), other.name, q_first);
  put_contact(meeting.contact, impact);
  const auto feature_of = [](const World::Body& body) {
    return bounding_radius(body.solid) > 0.0 ? Feature::surface : Feature::vertex;
  };
  if (!impact.touched)
    impact.touched = {feature_of(body_at(world, meeting.id.first)), feature_of(other), {impact.point}};
  ImpactPartner& partner = impact.partner.emplace();
  partner.velocity_before = partner.velocity_after = other.slice().velocity(q_second);
  partner.angular_velocity_before = partner.angular_velocity_after = angular_velocity(other, q_second);
  return impact;
}

Impact describe(const World& world, const RestingContact& contact, ImpactKind kind, double time,
                const Eigen::VectorXd& q) {
  Impact impact = without_impulse(body_at(world, contact.body), name_of_obstacle(world, contact.obstacle), q);
  impact.elapsed = time;
  impact.kind = kind;
  impact.normal = contact.normal;
  impact.point = contact.core
                     ? contact.point
                     : Vector3(impact.position - bounding_radius(body_at(world, contact.body).solid) * contact.normal);
  return impact;
}

}  // namespace trajet
