#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "trajet/rigid/free_rotation.hpp"
#include "trajet/rigid/kinematics.hpp"

namespace trajet {

/// How an orientation is carried as numbers with differential equations. The pages: docs/formats/orientation.md.
enum class OrientationWay {
  quaternion_normalized,  ///< 4 numbers, divided by their norm after each step
  quaternion,             ///< 4 numbers, as the integrator leaves them
  matrix,                 ///< 9 numbers, row by row
  rotation_vector,        ///< a rotation vector from the start of each step, which is a quaternion: 4 + 3 numbers
  exact,                  ///< 4 numbers, replaced by the closed form after each step
};

/// One way as users see it. A line of the table in src/rigid/orientation.cpp adds one.
struct OrientationInfo {
  OrientationWay way;
  std::string_view name;
  std::vector<std::string_view> aliases;
  int size;  ///< numbers in the state
  std::string_view known_as;
  std::string_view summary;  ///< one line
};

/// All ways; the first is the default.
std::span<const OrientationInfo> orientation_ways();
/// The way of that name or alias, or nullptr.
const OrientationInfo* find_orientation_way(std::string_view name);
const OrientationInfo& orientation_info(OrientationWay way);

/// An orientation and an angular velocity within a state: `way` says what the numbers of the orientation mean, `frame`
/// in which frame the angular velocity is written.
struct OrientationLayout {
  OrientationWay way = OrientationWay::quaternion_normalized;
  Frame frame = Frame::world;

  /// Numbers of the orientation; three of the angular velocity follow them.
  int size() const { return orientation_info(way).size; }

  /// The quaternion that the numbers stand for, unless they are a matrix.
  template <class T>
  QuaternionT<T> quaternion(const T* part) const {
    const QuaternionT<T> q(part[0], part[1], part[2], part[3]);
    if (way != OrientationWay::rotation_vector) return q;
    const QuaternionT<T> step = small_rotation<T>({part[4], part[5], part[6]});
    return frame == Frame::world ? step * q : q * step;
  }

  /// The matrix that carries body coordinates into the world, as the numbers have it: not quite a rotation for `matrix`
  /// and `quaternion`.
  template <class T>
  Matrix3T<T> matrix(const T* part) const {
    if (way != OrientationWay::matrix) return rotation_matrix(quaternion(part));
    Matrix3T<T> R;
    R << part[0], part[1], part[2], part[3], part[4], part[5], part[6], part[7], part[8];
    return R;
  }

  /// The rotation: as `matrix`, but not stretched where the numbers are a quaternion.
  template <class T>
  Matrix3T<T> rotation(const T* part) const {
    if (way == OrientationWay::matrix || way == OrientationWay::rotation_vector) return matrix(part);
    const QuaternionT<T> q = quaternion(part);
    return matrix(part) * (T(1.0) / dot(q, q));
  }

  /// The rates of the numbers under an angular velocity in the frame of the layout.  // rates: (size)
  template <class T>
  void rate(const T* part, const Vector3T<T>& w, T* rates) const {
    const bool in_world = frame == Frame::world;
    if (way == OrientationWay::matrix) {
      const Matrix3T<T> R = matrix(part);
      const Matrix3T<T> dR = in_world ? matrix_rate_world(R, w) : matrix_rate_body(R, w);
      for (int i = 0; i < 9; ++i) rates[i] = dR(i / 3, i % 3);
    } else if (way == OrientationWay::rotation_vector) {
      const Vector3T<T> u(part[4], part[5], part[6]);
      const Vector3T<T> du = in_world ? rotation_vector_rate_world(u, w) : rotation_vector_rate_body(u, w);
      for (int i = 0; i < 4; ++i) rates[i] = T(0.0);
      for (int i = 0; i < 3; ++i) rates[4 + i] = du[i];
    } else {
      const QuaternionT<T> q(part[0], part[1], part[2], part[3]);
      const QuaternionT<T> dq = in_world ? quaternion_rate_world(q, w) : quaternion_rate_body(q, w);
      rates[0] = dq.w();
      for (int i = 0; i < 3; ++i) rates[1 + i] = dq.vec()[i];
    }
  }

  /// Writes a rotation.  // part: (size)
  void put(const Quaternion& q_WB, double* part) const;
  /// Of q and -q, which are one rotation, makes the part hold that which is nearer to another's. A matrix has no such
  /// choice.
  void align(double* part, const double* other) const;
  /// What the way does at the end of a step: normalises the quaternion, or starts the next rotation vector at 0.
  void settle(double* part) const;
  /// How far the numbers are from those that `settle` leaves: 0 to a few roundings; 1 is as far as they may get.
  double unsettled(const double* part) const;
};

}  // namespace trajet
