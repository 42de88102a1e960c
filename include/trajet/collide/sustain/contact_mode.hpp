#pragma once

#include "trajet/math/vector.hpp"

namespace trajet {

/// One way in which a surface resists what moves on it: a part of the relative motion at a contact, and the force or
/// torque against it.
struct Resistance {
  enum class State {
    none,    ///< it does not resist
    moving,  ///< with all that its coefficient gives, against the motion
    held,    ///< with what keeps the motion at zero, up to that
  };
  State state = State::none;
  Vector3 direction = Vector3::Zero();  ///< unit, world: of the motion when it began to be `moving`
  double sign = 0.0;                    ///< of a turning about the normal, instead of a direction
  /// Whether the direction follows the motion; else it is constant, as of what slides straight on.
  bool follows = false;
  /// Of a motion that begins at zero in a direction that follows it: still so slow that its direction is that of what
  /// accelerates it. Its own would be as stiff as it is slow.
  bool begins = false;
  double scale = 0.0;  ///< of the speeds at the contact when it began, in the same unit

  bool is_moving() const { return state == State::moving; }
  bool is_held() const { return state == State::held; }
  bool operator==(const Resistance&) const = default;
};

/// A motion that begins has a direction of its own from so large a part of its scale on.
inline constexpr double kBegun = 1e-5;

/// How a contact lasts: what it does against slip, against turning along the surface and against turning about the
/// normal.
struct ContactMode {
  Resistance slip{}, roll{}, spin{};
  bool operator==(const ContactMode&) const = default;
};

/// What may end the way in which a contact lasts.
enum class ContactEnd {
  pull,        ///< it would have to pull
  past_edge,   ///< the body has come past the patch
  slip_stops,  ///< what moved does so no more
  roll_stops,
  spin_stops,
  slip_starts,  ///< friction does not hold any more
  roll_starts,
  spin_starts,
  slip_bends,  ///< the direction is not constant
  roll_bends,
  tips,       ///< its points would have to pull on one side: it goes on on the other
  touches,    ///< another corner comes to the same surface
  one_stops,  ///< one of several points that slide does so no more
};

/// The coefficients of a surface: of Coulomb, and of the torques over the normal force, m.
struct FrictionCoefficients {
  double slip = 0.0, roll = 0.0, spin = 0.0;
  bool has_any() const { return slip > 0.0 || roll > 0.0 || spin > 0.0; }
};

}  // namespace trajet
