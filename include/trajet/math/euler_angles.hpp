#pragma once

#include <array>

#include "trajet/math/quaternion.hpp"

namespace trajet {

/// Which three rotations a triple of Euler angles stands for.
struct EulerConvention {
  std::array<int, 3> axes;  ///< 0 x, 1 y, 2 z, in the order of the angles; neighbours differ
  bool is_intrinsic;        ///< about the axes of the turning body; else about those of the world
};

/// Yaw, pitch, roll: about z, then the new y, then the new x. R = Rz(a) Ry(b) Rx(c), -pi/2 <= b <= pi/2.
inline constexpr EulerConvention kYawPitchRoll{{2, 1, 0}, true};
/// Roll, pitch, yaw: about the world's x, then y, then z. R = Rz(c) Ry(b) Rx(a).
inline constexpr EulerConvention kRollPitchYaw{{0, 1, 2}, false};
/// Precession, nutation, spin of tops: about z, the new x, the new z. R = Rz(a) Rx(b) Rz(c), 0 <= b <= pi.
inline constexpr EulerConvention kPrecessionNutationSpin{{2, 0, 2}, true};

/// The unit quaternion of three angles (rad).
Quaternion from_euler_angles(const Vector3& angles_rad, const EulerConvention& convention);

/// The angles (rad) of a rotation; q of any length but 0. The middle one is in the range given with the conventions,
/// the others between -pi and pi. In gimbal lock, where only the sum or the difference of the outer ones is determined,
/// the last (intrinsic) or first (extrinsic) is 0. [BernardesViollet2022].
Vector3 to_euler_angles(const Quaternion& q, const EulerConvention& convention);

}  // namespace trajet
