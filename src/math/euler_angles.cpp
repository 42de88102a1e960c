#include "trajet/math/euler_angles.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace trajet {

using std::numbers::pi;

Quaternion from_euler_angles(const Vector3& angles_rad, const EulerConvention& convention) {
  Quaternion q = Quaternion::Identity();
  for (int i = 0; i < 3; ++i) {
    const Vector3 axis = Vector3::Unit(convention.axes[static_cast<std::size_t>(i)]);
    const Quaternion turn = from_axis_angle<double>(axis, angles_rad[i]);
    q = convention.is_intrinsic ? q * turn : turn * q;
  }
  return q;
}

Vector3 to_euler_angles(const Quaternion& q, const EulerConvention& convention) {
  // Rotations about turning axes are those about fixed axes in reverse order.
  auto [first, middle, last] = convention.axes;
  if (convention.is_intrinsic) std::swap(first, last);
  const bool is_proper = first == last;
  if (is_proper) last = 3 - first - middle;
  const double sign = (first - middle) * (middle - last) * (last - first) / 2;

  // The paper's (a, b, c, d): as complex numbers a + ib and c + id have the arguments (angle_3 ± angle_1) / 2 and
  // lengths whose ratio is the tangent of half the middle angle.
  const double x = q.vec()[first], y = q.vec()[middle], z = sign * q.vec()[last];
  const double a = is_proper ? q.w() : q.w() - y;
  const double b = is_proper ? x : x + z;
  const double c = is_proper ? y : q.w() + y;
  const double d = is_proper ? z : z - x;
  const double length_ab = std::hypot(a, b), length_cd = std::hypot(c, d);
  const double half_sum = std::atan2(b, a), half_difference = std::atan2(d, c);

  Vector3 angles(0.0, 2.0 * std::atan2(length_cd, length_ab), 0.0);
  // Below, the argument of the shorter one is rounding.
  constexpr double kLocked = 1e-14;
  const double length = std::hypot(length_ab, length_cd);
  if (length_cd < kLocked * length) {
    angles[2] = 2.0 * half_sum;
  } else if (length_ab < kLocked * length) {
    angles[2] = 2.0 * half_difference;
  } else {
    angles[0] = half_sum - half_difference;
    angles[2] = half_sum + half_difference;
  }
  if (!is_proper) {
    angles[1] -= pi / 2.0;
    angles[2] *= sign;
  }
  for (const int outer : {0, 2}) angles[outer] = std::remainder(angles[outer], 2.0 * pi);
  return convention.is_intrinsic ? Vector3(angles.reverse()) : angles;
}

}  // namespace trajet
