#pragma once

#include "trajet/event/time_switches.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/law/program_expansion.hpp"
#include "trajet/math/quaternion.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// Where a driven thing is, and how it moves there: a place on it, its pivot, and the rotation about it since the
/// start. World frame, SI units.
struct FrameMotion {
  Vector3 pivot{};                         ///< where the pivot was at the start
  Vector3 p{};                             ///< where it is
  Matrix3 R = Matrix3::Identity();         ///< since the start
  Vector3 v = Vector3::Zero();             ///< of the pivot, m/s
  Vector3 w = Vector3::Zero();             ///< rad/s
  Vector3 acceleration = Vector3::Zero();  ///< of the pivot, m/s^2
  Vector3 w_rate = Vector3::Zero();        ///< rad/s^2

  /// Where a place of the thing is that was there at the start, and the other way round.
  Vector3 from_start(const Vector3& place) const { return p + R * (place - pivot); }
  Vector3 to_start(const Vector3& place) const { return pivot + R.transpose() * (place - p); }

  /// The velocity of what is at the place and moves with the thing.
  Vector3 velocity_at(const Vector3& place) const { return v + w.cross(place - p); }
};

/// A drive evaluated: at times, and as polynomials.
class DrivenFrame {
 public:
  /// Of its polynomials.
  static constexpr int kOrder = 20;

  /// The drive must live as long as this.
  explicit DrivenFrame(const World::Drive& drive);

  const World::Drive& drive() const { return drive_; }

  FrameMotion at(double t);

  /// The motion from time `t` on (s, elapsed), right to rounding, up to `until` (later than t) or as far as one
  /// expansion reaches. Components: the place of the pivot, then the unit quaternion since the start. Coefficients are
  /// not finite where the formulas are not.
  Segment<7> piece(double t, double until);

 private:
  const World::Drive& drive_;
  ProgramExpansion expansion_;
  TimeSwitches switches_;
};

}  // namespace trajet
