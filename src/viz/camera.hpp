#pragma once

#include <Eigen/Core>
#include <cmath>

#include "trajet/math/vector.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet::detail {

using Vector2 = Eigen::Vector2d;

/// The coordinates of pictures in space: x along the front to the right, y away from the eye, z up.
class PictureAxes {
 public:
  explicit PictureAxes(UpAxis up = UpAxis::z) : up_(up) {}

  /// From the world's coordinates: (x, y, z), or (x, -z, y) where y is up.
  Matrix3 turn() const {
    Matrix3 turn = Matrix3::Identity();
    if (up_ == UpAxis::y) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    return turn;
  }
  /// The world's axis along an axis of the picture, and whether it points the other way.
  int axis(int of_picture) const { return up_ == UpAxis::z || of_picture == 0 ? of_picture : 3 - of_picture; }
  double sign(int of_picture) const { return up_ == UpAxis::y && of_picture == 1 ? -1.0 : 1.0; }
  char name(int of_picture) const { return "xyz"[axis(of_picture)]; }
  /// The world's axis that points up.
  int up() const { return axis(2); }

 private:
  UpAxis up_;
};

/// Looks at the world from in front, right and above, from a distance without end: parallels stay parallel.
///
/// Picture coordinates are x to the right and y upward. `scale` stretches the axes of the picture first; where all are
/// equal, shapes keep their proportions.
class Camera {
 public:
  explicit Camera(const Vector3& scale = Vector3::Ones(), const PictureAxes& axes = PictureAxes())
      : scale_(scale), turn_(axes.turn()) {
    const double azimuth = 28.0 * kDegree, polar = 62.0 * kDegree;
    right_ = {std::cos(azimuth), std::sin(azimuth), 0.0};
    towards_ = {std::sin(azimuth) * std::sin(polar), -std::cos(azimuth) * std::sin(polar), std::cos(polar)};
    up_ = towards_.cross(right_);
  }

  Vector2 project(const Vector3& p) const { return {right_.dot(scaled(p)), up_.dot(scaled(p))}; }
  /// Larger is nearer.
  double nearness(const Vector3& p) const { return towards_.dot(scaled(p)); }
  /// The picture of a vector is this matrix times it.
  Eigen::Matrix<double, 2, 3> matrix() const {
    Eigen::Matrix<double, 2, 3> m;
    m << right_.transpose(), up_.transpose();
    return m * scale_.asDiagonal() * turn_;
  }

 private:
  static constexpr double kDegree = 0.017453292519943295;

  Vector3 scaled(const Vector3& p) const { return scale_.cwiseProduct(turn_ * p); }

  Vector3 scale_;
  Matrix3 turn_;
  Vector3 right_, up_, towards_;
};

}  // namespace trajet::detail
