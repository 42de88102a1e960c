#include "scene_numbers.hpp"

#include <cmath>

#include "trajet/law/program_builder.hpp"
#include "trajet/math/euler_angles.hpp"
#include "trajet/math/quaternion.hpp"
#include "trajet/portable.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {

bool SceneNumbers::knows(const Expression& formula) const {
  return ranges::all_of(formula.names(), [&](const std::string& name) { return constants_.find(name) != nullptr; });
}

double SceneNumbers::scalar(const Expression& value, const std::string& what) const {
  const double number = evaluate_scalar(value, constants_);
  if (!std::isfinite(number)) throw InputError(value.where(), what + " is not a finite number");
  return number;
}

double SceneNumbers::positive(const Expression& value, const std::string& what) const {
  const double number = scalar(value, what);
  if (number <= 0.0) throw InputError(value.where(), what + " must be positive, got " + shortest_text(number));
  return number;
}

double SceneNumbers::not_negative(const Expression& value, const std::string& what) const {
  const double number = scalar(value, what);
  if (number < 0.0) throw InputError(value.where(), what + " must not be negative, got " + shortest_text(number));
  return number;
}

double SceneNumbers::within(const Expression& value, double lowest, double highest, const std::string& what) const {
  const double number = scalar(value, what);
  if (number < lowest || number > highest)
    throw InputError(value.where(), what + " must lie between " + shortest_text(lowest) + " and " +
                                        shortest_text(highest) + ", got " + shortest_text(number));
  return number;
}

Vector3 SceneNumbers::vector(const Expression& value, const std::string& what) const {
  const Vector3 numbers = evaluate_vector(value, constants_);
  if (!numbers.allFinite()) throw InputError(value.where(), what + " is not finite");
  return numbers;
}

Quaternion SceneNumbers::orientation(const OrientationDefinition& orientation, const std::string& what) const {
  if (orientation.axis && orientation.angle_rad) {
    const Vector3 axis = vector(*orientation.axis, what);
    if (axis.norm() == 0.0) throw InputError(orientation.axis->where(), "axis of " + what + " has no direction");
    return from_axis_angle<double>(axis, scalar(*orientation.angle_rad, what)).normalized();
  }
  if (orientation.quaternion.size() == 4) {
    Eigen::Vector4d q;
    for (int i = 0; i < 4; ++i) q[i] = scalar(orientation.quaternion[static_cast<std::size_t>(i)], what);
    if (q.norm() == 0.0) throw InputError(orientation.quaternion[0].where(), "quaternion of " + what + " is zero");
    q.stableNormalize();
    return {q[0], q[1], q[2], q[3]};
  }
  if (orientation.matrix.size() == 3) {
    Matrix3 R;
    for (int i = 0; i < 3; ++i) R.row(i) = vector(orientation.matrix[static_cast<std::size_t>(i)], what).transpose();
    constexpr double kOrthogonality = 1e-9;  // what a matrix printed to ten digits keeps
    if (!(R.transpose() * R).isIdentity(kOrthogonality) || !(R.determinant() > 0.0))
      throw InputError(orientation.matrix[0].where(), what +
                                                          " is no rotation matrix: its rows must be orthogonal unit "
                                                          "vectors, right-handed");
    return from_rotation_matrix(nearest_rotation(R));
  }
  if (orientation.roll_pitch_yaw.size() == 3) {
    Vector3 angles_rad;
    for (int i = 0; i < 3; ++i) angles_rad[i] = scalar(orientation.roll_pitch_yaw[static_cast<std::size_t>(i)], what);
    return from_euler_angles(angles_rad, kRollPitchYaw).normalized();
  }
  if (orientation.axis || orientation.angle_rad || !orientation.quaternion.empty() || !orientation.matrix.empty() ||
      !orientation.roll_pitch_yaw.empty())
    throw InputError(orientation.where,
                     what + " is incomplete: an axis and an angle, four numbers, three rows, or three angles expected");
  return Quaternion::Identity();
}

}  // namespace trajet
