#include "impact_sides.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "body_state.hpp"
#include "instant.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/scene/law_name.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {

double mass_of(const World::Body& body, double t, const Eigen::VectorXd& q) {
  double value = 1.0;
  if (!body.mass) return value;
  Evaluator<double> mass(*body.mass);
  mass(t, q.data(), &value);
  return value;
}

double mass_in_meetings(const World& world, int index, const Instant& instant) {
  if (sticking_contact(instant.contacts, index) != nullptr) return std::numeric_limits<double>::infinity();
  return mass_of(world.bodies[static_cast<std::size_t>(index)], instant.time(), instant.before());
}

ImpactFriction friction_of(const Surface& surface) {
  const auto measure = [&] {
    switch (surface.impact) {
      case ImpactLaw::poisson:
        return RestitutionOf::impulse;
      case ImpactLaw::newton:
        return RestitutionOf::speed;
      case ImpactLaw::stronge:
        break;
    }
    return RestitutionOf::work;
  };
  return {surface.friction, surface.tangential_restitution, measure()};
}

std::string why_it_cannot_bounce(const World::Body& body, const Surface& surface) {
  if (body.inertia || bounding_radius(body.solid) == 0.0) return "";
  if (friction_of(surface).acts())
    return "friction turns body '" + body.name + "', and how much needs its inertia and its mass: give it a `mass` " +
           "that is constant or a `density`, and no angular acceleration";
  if (is_round(body.solid) || !body.rotation) return "";
  return "body '" + body.name + "' turns, and what an impact makes of that needs its inertia and its mass: give it a " +
         "`mass` or a `density`, and no angular acceleration";
}

std::string describe_impossible_restitution(const std::string& owner, const Surface& surface, double restitution,
                                            double speed) {
  const std::string place = place_text(surface.restitution_where);
  return "restitution of " + owner + " is " + shortest_text(restitution) + " at a speed of approach of " +
         shortest_text(speed) + " m/s, not within 0 and 1" + (place.empty() ? "" : " (" + place + ")");
}

Matrix3 rotation_of(const World::Body& body, const BodySlice& slice, const Eigen::VectorXd& q) {
  return body.rotation ? body.rotation->layout.rotation(slice.orientation(q)) : rotation_matrix(body.q_WB);
}

ImpactSide impact_side(const World::Body& body, const BodySlice& slice, const Eigen::VectorXd& q,
                       const Vector3& velocity, double mass, const Vector3& point) {
  ImpactSide side{.velocity = velocity, .arm = point - Vector3(slice.position(q)), .inverse_mass = 1.0 / mass};
  if (!body.rotation) return side;
  const Matrix3 R = rotation_of(body, slice, q);
  const Vector3 w = slice.angular_velocity(q);
  side.angular_velocity = body.rotation->layout.frame == Frame::world ? w : Vector3(R * w);
  if (body.inertia && std::isfinite(mass)) side.inverse_inertia = R * body.inertia->inverse() * R.transpose();
  return side;
}

void put(const World::Body& body, const BodySlice& slice, const ImpactSide& before, const ImpactSide& after,
         Eigen::VectorXd& q) {
  q.segment<3>(slice.velocity_index()) += after.velocity - before.velocity;
  if (!body.rotation) return;
  const Vector3 change = after.angular_velocity - before.angular_velocity;
  const bool is_in_world = body.rotation->layout.frame == Frame::world;
  q.segment<3>(slice.angular_velocity_index()) +=
      is_in_world ? change : Vector3(rotation_of(body, slice, q).transpose() * change);
}

MaterialMotion motion_at(const World::Body& body, const Eigen::VectorXd& q, const Eigen::VectorXd& rate,
                         const Vector3& point) {
  const BodySlice slice = body.slice();
  const Vector3 arm = point - Vector3(slice.position(q));
  const Vector3 w = angular_velocity(body, q);
  MaterialMotion motion{Vector3(slice.position(rate)) + w.cross(arm),
                        Vector3(slice.velocity(rate)) + w.cross(w.cross(arm))};
  if (body.rotation) motion.acceleration += angular_acceleration(body, q, rate).cross(arm);
  return motion;
}

void add_gradient(const World::Body& body, const BodySlice& slice, const Eigen::VectorXd& q, const Vector3& point,
                  const Vector3& direction, Eigen::VectorXd& gradient) {
  gradient.segment<3>(slice.position_index()) += direction;
  if (!body.rotation) return;
  const Vector3 p_B = rotation_of(body, slice, q).transpose() * (point - Vector3(slice.position(q)));
  const auto height = [&](const Eigen::VectorXd& state) {
    return direction.dot(rotation_of(body, slice, state) * p_B);
  };
  for (int i = slice.orientation_index(); i < slice.angular_velocity_index(); ++i) {
    const double part = small_part(q[i]);
    Eigen::VectorXd more = q, less = q;
    more[i] += part;
    less[i] -= part;
    gradient[i] += (height(more) - height(less)) / (2.0 * part);
  }
}

double small_part(double value) { return 1e-6 * std::max(1.0, std::abs(value)); }

}  // namespace trajet
