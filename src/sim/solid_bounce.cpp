#include "solid_bounce.hpp"

#include <algorithm>
#include <cmath>

#include "body_state.hpp"
#include "impact_sides.hpp"
#include "trajet/collide/respond/frictional_impact.hpp"

namespace trajet {
namespace {

const World::Body& body_of(const World& world, const Pair& pair) {
  return world.bodies[static_cast<std::size_t>(pair.id.body)];
}

/// A contact as the state of the body sees it: its place on the body, and whether its normal turns with the body.
struct Hold {
  Vector3 p_B;
  Vector3 normal;  // in the frame of the body if it turns with that, else in the world
  bool turns_with_body;

  Vector3 normal_at(const Matrix3& R) const { return turns_with_body ? Vector3(R * normal) : normal; }
};

Hold hold_of(const World& world, const Pair& pair, const Eigen::VectorXd& q) {
  const World::Body& body = body_of(world, pair);
  const Matrix3 R = rotation_of(body, body.slice(), q);
  const ContactResult& contact = pair.contact;
  const bool turns = contact.touched->of_body == Feature::face && contact.touched->of_obstacle != Feature::face;
  return {R.transpose() * (contact.point - Vector3(body.slice().position(q))),
          turns ? Vector3(R.transpose() * contact.normal) : contact.normal, turns};
}

ImpactSide side_of(const std::optional<FrameMotion>& surface, const Vector3& point) {
  ImpactSide side;
  if (surface) side.velocity = surface->velocity_at(point);
  return side;
}

}  // namespace

double bounce_solid(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface, double restitution,
                    double mass, Instant& instant, Impact& impact) {
  const World::Body& body = body_of(world, pair);
  const BodySlice slice = body.slice();
  const Hold hold = hold_of(world, pair, instant.before());
  const ImpactFriction friction = friction_of(world.surface(pair.id.body, pair.id.obstacle));
  // what becomes of a state near this one that is in the same contact, at a fixed time
  const auto respond = [&](const Eigen::VectorXd& q, const Vector3& velocity, Eigen::VectorXd& result) {
    const Matrix3 R = rotation_of(body, body.slice(), q);
    const Vector3 point =
        hold.turns_with_body ? pair.contact.point : Vector3(Vector3(slice.position(q)) + R * hold.p_B);
    const ImpactSide before = impact_side(body, body.slice(), q, velocity, mass, point);
    ImpactSide after = before;
    const FrictionalImpact hit =
        frictional_impact(before, side_of(surface, point), hold.normal_at(R), restitution, friction);
    after.take(hit.impulse);
    result = q;
    put(body, body.slice(), before, after, result);
    return hit;
  };
  const Eigen::VectorXd rate = instant.rate();
  const Vector3 drift = Vector3(slice.position(rate)) - Vector3(slice.velocity(instant.before()));  // dr/dt - v
  const FrictionalImpact hit = respond(instant.before(), slice.position(rate), instant.q);
  impact.impulse = hit.impulse;
  impact.velocity_after = slice.velocity(instant.q);
  impact.angular_velocity_after = angular_velocity(body, instant.q);

  Eigen::MatrixXd derivative = instant.derivative;
  Eigen::VectorXd moved, result;
  for (int i = slice.first; i < slice.first + slice.size(); ++i) {
    const double part = small_part(instant.before()[i]);
    Eigen::VectorXd change = Eigen::VectorXd::Zero(instant.q.size());
    for (const double sign : {1.0, -1.0}) {
      moved = instant.before();
      moved[i] += sign * part;
      respond(moved, Vector3(slice.velocity(moved)) + drift, result);
      change += sign / (2.0 * part) * result;
    }
    derivative.col(i) = change;
  }
  // each state near this one has its contact at a time of its own: dt* = -dg / g'
  const double speed = normal_motion(world, pair, surface, instant.before(), rate).speed;
  if (speed < 0.0) {
    const Eigen::RowVectorXd time = -gap_gradient(world, pair, instant.before()).transpose() / speed;
    derivative += (derivative * rate - instant.rate()) * time;
  }
  instant.derivative = derivative;
  return hit.energy_gained;
}

NormalMotion normal_motion(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface,
                           const Eigen::VectorXd& q, const Eigen::VectorXd& rate) {
  const Vector3& normal = pair.contact.normal;
  const Vector3& point = pair.contact.point;
  MaterialMotion motion = motion_at(body_of(world, pair), q, rate, point);
  if (surface) {
    const Vector3 surface_arm = point - surface->p;
    motion.velocity -= surface->velocity_at(point);
    motion.acceleration -=
        surface->acceleration + surface->w_rate.cross(surface_arm) + surface->w.cross(surface->w.cross(surface_arm));
  }
  return {normal.dot(motion.velocity), normal.dot(motion.acceleration)};
}

Eigen::VectorXd gap_gradient(const World& world, const Pair& pair, const Eigen::VectorXd& q) {
  const World::Body& body = body_of(world, pair);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(q.size());
  add_gradient(body, body.slice(), q, pair.contact.point, pair.contact.normal, gradient);
  return gradient;
}

}  // namespace trajet
