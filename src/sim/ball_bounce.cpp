#include "ball_bounce.hpp"

#include <algorithm>

#include "body_state.hpp"
#include "impact_sides.hpp"
#include "jump_derivative.hpp"
#include "trajet/collide/respond/frictional_impact.hpp"
#include "trajet/rigid/kinematics.hpp"

namespace trajet {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// What decides the impact of a ball: all in the world's frame.
struct BallContact {
  Vector3 velocity;         // of the ball's point of contact against the surface
  Vector3 normal;           // unit
  Matrix3 inverse_inertia;  // about the centre
};

/// How a ball answers to its contacts with one surface.
class BallResponse {
 public:
  BallResponse(double radius, double mass, const Surface& surface)
      : radius_(radius), mass_(mass), restitution_(surface.restitution), friction_(friction_of(surface)) {}

  FrictionalImpact impact(const BallContact& contact) const {
    const ImpactSide side{.velocity = contact.velocity,
                          .arm = -radius_ * contact.normal,
                          .inverse_mass = 1.0 / mass_,
                          .inverse_inertia = contact.inverse_inertia};
    const double speed = std::max(0.0, -contact.normal.dot(contact.velocity));
    const double restitution = std::clamp(restitution_.at(speed), 0.0, 1.0);
    return frictional_impact(side, {}, contact.normal, restitution, friction_);
  }
  /// The change of velocity and of angular velocity.
  Vector6 change(const BallContact& contact, const Vector3& impulse) const {
    Vector6 change;
    change << impulse / mass_, contact.inverse_inertia * (-radius_ * contact.normal).cross(impulse);
    return change;
  }
  Vector6 change(const BallContact& contact) const { return change(contact, impact(contact).impulse); }

 private:
  double radius_, mass_;
  RestitutionLaw restitution_;
  ImpactFriction friction_;
};

}  // namespace

double bounce_ball(const World& world, const Pair& pair, const std::optional<FrameMotion>& surface, double mass,
                   const Eigen::VectorXd& rate, Instant& instant, Impact& impact) {
  const World::Body& body = world.bodies[static_cast<std::size_t>(pair.id.body)];
  const BodySlice slice = body.slice();
  const Eigen::VectorXd before = instant.before();
  const double radius = bounding_radius(body.solid);
  const Vector3 normal = pair.contact.normal;
  const Vector3 center = slice.position(before);
  const Matrix3 R = rotation_of(body, slice, before);
  const bool is_in_world = !body.rotation || body.rotation->layout.frame == Frame::world;
  const Matrix3 axes = is_in_world ? Matrix3(Matrix3::Identity()) : R;  // of the state's angular velocity
  const BallResponse response(radius, mass, world.surface(pair.id.body, pair.id.obstacle));

  const auto inverse_inertia = [&](const Matrix3& orientation) {
    return body.inertia ? Matrix3(orientation * body.inertia->inverse() * orientation.transpose())
                        : Matrix3(Matrix3::Zero());
  };
  const Vector3 w = angular_velocity(body, before);
  const auto surface_velocity = [&](const Vector3& point) {
    return surface ? surface->velocity_at(point) : Vector3(0, 0, 0);
  };
  const auto contact_at = [&](const Vector3& place, const Vector3& n) {
    const Vector3 arm = -radius * n;
    return BallContact{Vector3(slice.position(rate)) + w.cross(arm) - surface_velocity(place + arm), n,
                       inverse_inertia(R)};
  };
  const BallContact contact = contact_at(center, normal);
  const FrictionalImpact result = response.impact(contact);
  const auto put_change = [&](const Vector6& change, auto&& column) {
    slice.velocity(column) += change.head<3>();
    if (body.rotation) slice.angular_velocity(column) += axes.transpose() * change.tail<3>();
  };
  put_change(response.change(contact, result.impulse), instant.q);
  impact.impulse = result.impulse;
  impact.velocity_after = slice.velocity(instant.q);
  impact.angular_velocity_after = angular_velocity(body, instant.q);

  // The derivative at a fixed time, by differences: steps of velocities are parts of the speed of approach, so that all
  // states have a contact.
  Eigen::MatrixXd derivative = instant.derivative;
  const double speed = contact.velocity.dot(normal);
  constexpr double kPart = 1e-5;
  const auto by_velocity = [&](const Vector3& direction) {
    const double size = direction.norm();
    if (!(size > 0.0) || !(speed < 0.0)) return Vector6(Vector6::Zero());
    const double step = kPart * -speed / size;
    BallContact more = contact, less = contact;
    more.velocity += step * direction;
    less.velocity -= step * direction;
    return Vector6((response.change(more) - response.change(less)) / (2.0 * step));
  };
  const Matrix3 bend = normal_derivative(world, pair, surface, center);
  const double step = kPart * (radius > 0.0 ? radius : small_part(1.0));
  for (int i = 0; i < 3; ++i) {
    const Vector3 axis = Vector3::Unit(i);
    put_change(by_velocity(axis), derivative.col(slice.velocity_index() + i));
    const Vector3 shift = step * axis;
    const auto moved = [&](double sign) {
      return response.change(contact_at(center + sign * shift, (normal + sign * bend * shift).normalized()));
    };
    put_change((moved(1.0) - moved(-1.0)) / (2.0 * step), derivative.col(slice.position_index() + i));
    if (!body.rotation) continue;
    put_change(by_velocity(Vector3(axes.col(i)).cross(-radius * normal)),
               derivative.col(slice.angular_velocity_index() + i));
  }
  if (!(speed < 0.0)) return result.energy_gained;

  // each state near this one has its contact at a time of its own: dt* = -n . dr / (n . u)
  Eigen::VectorXd jump = derivative * rate - instant.rate();
  if (surface) {  // what the surface alone does in the meantime: its normal turns, and its velocity changes
    const Vector3 turning = surface->w.cross(normal) - bend * surface_velocity(center);
    const double time = kPart * -speed / (1.0 + turning.norm() * contact.velocity.norm());
    const auto moved = [&](double sign) {
      FrameMotion motion = *surface;
      motion.p += sign * time * surface->v;
      motion.v += sign * time * surface->acceleration;
      motion.w += sign * time * surface->w_rate;
      const Vector3 n = (normal + sign * time * turning).normalized();
      const Vector3 arm = -radius * n;
      BallContact then = contact;
      then.normal = n;
      then.velocity = Vector3(slice.position(rate)) + w.cross(arm) - motion.velocity_at(center + arm);
      return response.change(then);
    };
    put_change((moved(1.0) - moved(-1.0)) / (2.0 * time), jump);
  }
  Eigen::RowVectorXd time_of_contact = Eigen::RowVectorXd::Zero(rate.size());
  time_of_contact.segment<3>(slice.position_index()) = -normal / speed;
  derivative += jump * time_of_contact;
  instant.derivative = derivative;
  return result.energy_gained;
}

}  // namespace trajet
