#include "solid_bounce.hpp"

#include <algorithm>
#include <cmath>

#include "body_state.hpp"
#include "trajet/collide/respond/solid_impact.hpp"

namespace trajet {
namespace {

const World::Body& body_of(const World& world, const Pair& pair) {
  return world.bodies[static_cast<std::size_t>(pair.id.body)];
}

Matrix3 rotation_of(const World::Body& body, const Eigen::VectorXd& q) {
  if (!body.rotation) return rotation_matrix(body.q_WB);
  return body.rotation->layout.rotation(body.slice().orientation(q));
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
  const Matrix3 R = rotation_of(body, q);
  const ContactResult& contact = pair.contact;
  const bool turns = contact.touched->of_body == Feature::face && contact.touched->of_obstacle != Feature::face;
  return {R.transpose() * (contact.point - Vector3(body.slice().position(q))),
          turns ? Vector3(R.transpose() * contact.normal) : contact.normal, turns};
}

ImpactSide side_of(const World::Body& body, const Eigen::VectorXd& q, const Vector3& velocity, double mass,
                   const Vector3& point) {
  ImpactSide side{.velocity = velocity, .arm = point - Vector3(body.slice().position(q)), .inverse_mass = 1.0 / mass};
  if (!body.rotation) return side;
  const Matrix3 R = rotation_of(body, q);
  side.angular_velocity = angular_velocity(body, q);
  if (body.inertia) side.inverse_inertia = R * body.inertia->inverse() * R.transpose();
  return side;
}

ImpactSide side_of(const std::optional<FrameMotion>& surface, const Vector3& point) {
  ImpactSide side;
  if (surface) side.velocity = surface->velocity_at(point);
  return side;
}

/// Puts what an impact made of a side into the state.
void put(const World::Body& body, const ImpactSide& before, const ImpactSide& after, Eigen::VectorXd& q) {
  const BodySlice slice = body.slice();
  q.segment<3>(slice.velocity_index()) += after.velocity - before.velocity;
  if (!body.rotation) return;
  const Vector3 change = after.angular_velocity - before.angular_velocity;
  const bool is_in_world = body.rotation->layout.frame == Frame::world;
  q.segment<3>(slice.angular_velocity_index()) +=
      is_in_world ? change : Vector3(rotation_of(body, q).transpose() * change);
}

/// A number of the state that is off by a little, and by how much: for differences that keep half of the digits.
double small_part(double value) { return 1e-6 * std::max(1.0, std::abs(value)); }

}  // namespace

std::string why_it_cannot_bounce(const World::Body& body) {
  if (!body.rotation || body.inertia) return "";
  return "body '" + body.name + "' turns, and what an impact makes of that needs its inertia and its mass: give it a " +
         "`mass` or a `density`, and no angular acceleration";
}

void bounce_solid(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface, double restitution,
                  double mass, Instant& instant, Impact& impact) {
  const World::Body& body = body_of(world, pair);
  const BodySlice slice = body.slice();
  const Hold hold = hold_of(world, pair, instant.before());
  // what becomes of a state near this one that is in the same contact, at a fixed time
  const auto respond = [&](const Eigen::VectorXd& q, const Vector3& velocity, Eigen::VectorXd& result) {
    const Matrix3 R = rotation_of(body, q);
    const Vector3 point =
        hold.turns_with_body ? pair.contact.point : Vector3(Vector3(slice.position(q)) + R * hold.p_B);
    const ImpactSide before = side_of(body, q, velocity, mass, point);
    ImpactSide after = before;
    const Vector3 impulse = frictionless_impulse(before, side_of(surface, point), hold.normal_at(R), restitution);
    after.take(impulse);
    result = q;
    put(body, before, after, result);
    return impulse;
  };
  const Eigen::VectorXd rate = instant.rate();
  const Vector3 drift = Vector3(slice.position(rate)) - Vector3(slice.velocity(instant.before()));  // dr/dt - v
  impact.impulse = respond(instant.before(), slice.position(rate), instant.q);
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
}

NormalMotion normal_motion(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface,
                           const Eigen::VectorXd& q, const Eigen::VectorXd& rate) {
  const World::Body& body = body_of(world, pair);
  const BodySlice slice = body.slice();
  const Vector3& normal = pair.contact.normal;
  const Vector3& point = pair.contact.point;
  const Vector3 arm = point - Vector3(slice.position(q));
  const Vector3 w = angular_velocity(body, q);
  Vector3 velocity = Vector3(slice.position(rate)) + w.cross(arm);
  Vector3 acceleration = Vector3(slice.velocity(rate)) + w.cross(w.cross(arm));
  if (body.rotation) acceleration += angular_acceleration(body, q, rate).cross(arm);
  if (surface) {
    const Vector3 surface_arm = point - surface->p;
    velocity -= surface->velocity_at(point);
    acceleration -=
        surface->acceleration + surface->w_rate.cross(surface_arm) + surface->w.cross(surface->w.cross(surface_arm));
  }
  return {normal.dot(velocity), normal.dot(acceleration)};
}

Eigen::VectorXd gap_gradient(const World& world, const Pair& pair, const Eigen::VectorXd& q) {
  const World::Body& body = body_of(world, pair);
  const BodySlice slice = body.slice();
  const Hold hold = hold_of(world, pair, q);
  const auto gap = [&](const Eigen::VectorXd& state) {
    const Matrix3 R = rotation_of(body, state);
    return hold.normal_at(R).dot(Vector3(slice.position(state)) + R * hold.p_B - pair.contact.point);
  };
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(q.size());
  gradient.segment<3>(slice.position_index()) = pair.contact.normal;
  if (!body.rotation) return gradient;
  for (int i = slice.orientation_index(); i < slice.angular_velocity_index(); ++i) {
    const double part = small_part(q[i]);
    Eigen::VectorXd more = q, less = q;
    more[i] += part;
    less[i] -= part;
    gradient[i] = (gap(more) - gap(less)) / (2.0 * part);
  }
  return gradient;
}

}  // namespace trajet
