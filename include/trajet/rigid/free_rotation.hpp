#pragma once

#include <optional>

#include "trajet/math/jacobi_functions.hpp"
#include "trajet/math/quaternion.hpp"

namespace trajet {

/// Frames in which an angular velocity can be written.
enum class Frame { world, body };

/// The rotation of a solid on which no torque acts, or whose angular velocity is constant, in closed form.
///
/// Times are those since the start, s, of either sign. The work does not grow with time and nothing accumulates: the
/// error is the rounding of the phase, about eps |w| t.
class FreeRotation {
 public:
  /// Constant angular velocity in the world's frame (and so in the body's), rad/s: the screw.
  FreeRotation(const Quaternion& q_WB, const Vector3& w_WB_W) : q_WB_(q_WB), w_WB_W_(w_WB_W) {}
  /// A free top: q_WB unit; w_WB_B rad/s; inertia about the centre of mass in the body's frame, symmetric, positive
  /// definite. Jacobi's solution, with the attitude by elliptic integrals of the third kind [VanZonSchofield2007].
  FreeRotation(const Quaternion& q_WB, const Vector3& w_WB_B, const Matrix3& inertia);

  /// Unit.
  Quaternion q_WB(double time) const;
  Vector3 w_WB_B(double time) const;
  Vector3 w_WB_W(double time) const;

 private:
  /// A top whose angular velocity is not constant, in principal axes C numbered so that the third is the one around
  /// which the others turn: w = (w1 cn u, w2 sn u, w3 dn u), u = rate t + phase.
  struct Tumbling {
    Quaternion q_CB;
    Quaternion start;  ///< from C to W but for the turn about the angular momentum, at time 0
    JacobiFunctions functions;
    double w1, w2, w3;
    double rate, phase;
    Vector3 inertia;
    double momentum;          ///< |L|
    double n;                 ///< characteristic of the integral of the third kind
    double third_kind_start;  ///< its value, and that of its circular part, at time 0
    double circular_start;
  };
  static std::optional<Tumbling> tumbling(const Quaternion& q_WB, const Vector3& w_WB_B, const Matrix3& inertia);

  Quaternion q_WB_;
  Vector3 w_WB_W_;
  std::optional<Tumbling> tumbling_;
};

}  // namespace trajet
