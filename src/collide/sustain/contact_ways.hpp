#pragma once

#include <cmath>

#include "trajet/collide/sustain/contact_decision.hpp"

namespace trajet::detail {

/// What a motion or a force has without its part along the normal.
template <class V, class T>
Vector3T<T> along_surface(const V& v, const Vector3T<T>& normal) {
  const Vector3T<T> whole = v;
  return whole - normal * normal.dot(whole);
}

/// The three ways in which a contact resists, as one.
enum class Way { slip, roll, spin };
inline constexpr Way kWays[] = {Way::slip, Way::roll, Way::spin};

inline Resistance& resistance(ContactMode& mode, Way way) {
  return way == Way::slip ? mode.slip : way == Way::roll ? mode.roll : mode.spin;
}

/// What a motion, or a force against it, is in that way.
inline Vector3 part(Way way, const Vector3& of_slip, const Vector3& of_turning, const Vector3& normal) {
  if (way == Way::slip) return along_surface(of_slip, normal);
  return way == Way::roll ? along_surface(of_turning, normal) : Vector3(of_turning.dot(normal) * normal);
}

inline ContactEnd start_of(Way way) {
  return way == Way::slip   ? ContactEnd::slip_starts
         : way == Way::roll ? ContactEnd::roll_starts
                            : ContactEnd::spin_starts;
}

inline double coefficient(const ContactQuestion& question, Way way) {
  if (way == Way::slip) return question.friction.slip;
  if (!question.turns) return 0.0;
  return way == Way::roll ? question.friction.roll : question.friction.spin;
}

/// Lets a motion begin, or go on, with that velocity or acceleration.
inline void set_moving(Resistance& it, Way way, const Vector3& motion, const Vector3& normal) {
  it.state = Resistance::State::moving;
  it.direction = motion.normalized();
  it.sign = way == Way::spin ? std::copysign(1.0, motion.dot(normal)) : 0.0;
}

}  // namespace trajet::detail
