#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "trajet/collide/sustain/contact_terms.hpp"

namespace trajet {

/// The direction of a motion that is resisted.
template <class T>
Vector3T<T> direction_of(const Resistance& resistance, const Vector3T<T>& motion, const Vector3T<T>& free_rate,
                         const Vector3T<T>& normal) {
  using std::sqrt;
  if (!resistance.follows) return resistance.direction.cast<T>();
  const Vector3T<T>& leading = resistance.begins ? free_rate : motion;
  const Vector3T<T> along = leading - normal * normal.dot(leading);
  return along * (T(1.0) / sqrt(along.dot(along)));
}

/// The direction in which a point of a contact slides, unit; zero of one that sticks.
template <class T>
Vector3T<T> slip_direction(const BodyTerms<T>& terms, const ContactPoints& contact, const ContactMode& mode,
                           std::size_t i) {
  using std::sqrt;
  using State = PointSlip::State;
  const auto point = [&](std::size_t k) -> const ContactTerms<T>& {
    return terms.points[static_cast<std::size_t>(contact.points[k])];
  };
  const ContactTerms<T>& at = point(i);
  const State state = mode.slip.follows && !mode.points.empty() ? mode.points[i].state : State::follows;
  if (state == State::sticks) return {T(0.0), T(0.0), T(0.0)};
  if (state == State::begins) return mode.points[i].direction.cast<T>();
  if (state == State::turns) {
    const Vector3T<T> arm = at.arm - point(static_cast<std::size_t>(mode.sticking_point())).arm;
    const Vector3T<T> across = at.normal.cross(arm);
    return across * (T(mode.slip.sign) / sqrt(across.dot(across)));
  }
  return direction_of(mode.slip, at.slip, at.slip_rate, at.normal);
}

/// Of several points that are held, what friction each has per normal force. It is that of a turning about a centre, as
/// of points that creep, by their grips and normal forces; all together keep what is held.
template <class T>
std::vector<Vector3T<T>> held_friction(const BodyTerms<T>& terms, const ContactPoints& contact, const ContactMode& mode,
                                       const ContactForce<T>& force) {
  const auto point = [&](std::size_t k) -> const ContactTerms<T>& {
    return terms.points[static_cast<std::size_t>(contact.points[k])];
  };
  const std::size_t count = contact.points.size();
  const Vector3T<T>& normal = point(0).normal;
  const Vector3T<T> along = force.force - normal * normal.dot(force.force);
  const Vector3T<T> zero(T(0.0), T(0.0), T(0.0));
  Vector3T<T> middle = zero, center = zero;
  T sum(0.0), inertia(0.0);
  std::vector<T> weights;
  for (std::size_t i = 0; i < count; ++i) {
    weights.push_back(force.shares[i] * T(mode.points[i].grip));
    sum += weights.back();
    middle += point(i).arm * T(1.0 / static_cast<double>(count));
    center += point(i).arm * weights.back();
  }
  center = center * (T(1.0) / sum);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3T<T> arm = point(i).arm - center;
    inertia += weights[i] * arm.dot(arm);
  }
  const T turning = normal.dot(force.torque + Vector3T<T>(middle - center).cross(along)) / inertia;
  std::vector<Vector3T<T>> friction;
  for (std::size_t i = 0; i < count; ++i)
    friction.push_back((along * (T(1.0) / sum) + normal.cross(Vector3T<T>(point(i).arm - center)) * turning) *
                       T(mode.points[i].grip));
  return friction;
}

}  // namespace trajet
