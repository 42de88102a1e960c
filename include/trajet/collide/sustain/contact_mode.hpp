#pragma once

#include <vector>

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
/// And where its direction follows it, it has stopped where it is so small.
inline constexpr double kHasDied = 1e-11;
/// One point among several that move has none where its part of their motions is so small, and has one again from the
/// other part on.
inline constexpr double kOneStops = 1e-5, kOneBegun = 2e-5;

/// How friction acts on one of several points of a contact whose directions of slip differ.
struct PointSlip {
  enum class State {
    follows,  ///< against its own velocity
    begins,   ///< against what accelerates it: it is too slow for a direction of its own
    turns,    ///< it moves round the point that sticks
    sticks,   ///< it does not move: the others turn about it
  };
  State state = State::follows;
  Vector3 direction = Vector3::Zero();  ///< unit, world: of a point that `begins`
  /// Where all are held: what friction it has per normal force, against what the others have if they move as fast.
  double grip = 1.0;
  bool operator==(const PointSlip&) const = default;
};

/// How a contact lasts: what it does against slip, against turning along the surface and against turning about the
/// normal.
struct ContactMode {
  Resistance slip{}, roll{}, spin{};
  std::vector<PointSlip> points{};  ///< of a contact of several
  /// The point about which the others turn, with the sign of `slip`; -1 if there is none.
  int sticking_point() const {
    if (!slip.is_moving()) return -1;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].state == PointSlip::State::sticks) return static_cast<int>(i);
    return -1;
  }
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
