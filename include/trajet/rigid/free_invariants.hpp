#pragma once

#include "trajet/math/quaternion.hpp"
#include "trajet/rigid/principal_axes.hpp"

namespace trajet {

/// What a solid on which no torque acts keeps: its energy of rotation, and its angular momentum in the world's frame.
///
/// An integrator's error moves a free top to another energy and momentum, and with them to another period; near the
/// intermediate axis that error grows e-fold again and again. Putting the state back where it belongs leaves only the
/// error along the orbit, which grows with time and no faster: the standard projection, [HairerLubichWanner2006] IV.4.
class FreeInvariants {
 public:
  /// q_WB unit; w_WB_B in rad/s; the inertia about the centre of mass, body's frame.
  FreeInvariants(const Quaternion& q_WB, const Vector3& w_WB_B, const Matrix3& inertia);

  /// Puts a state that is nearly right back: the angular velocity to the nearest one of that energy and that length of
  /// the momentum, then the orientation by the shortest rotation that turns the momentum to its direction. A state too
  /// far off for Newton's method stays as it is.
  void restore(Quaternion& q_WB, Vector3& w_WB_B) const;

 private:
  PrincipalAxes principal_;
  Vector3 excess_moments_;  // I_i (I_i - I_middle)
  double twice_energy_;
  double excess_;       // L^2 - 2 T I_middle, which decides the period: kept without the cancellation
  Vector3 momentum_W_;  // unit
};

}  // namespace trajet
