#pragma once

#include <Eigen/Core>
#include <cmath>

#include "trajet/math/vector.hpp"

namespace trajet::detail {

using Vector2 = Eigen::Vector2d;

/// Looks at the world from in front, right and above, from a distance without end: parallels stay parallel.
///
/// Picture coordinates are x to the right and y upward. `scale` stretches the world's axes first; where all are equal,
/// shapes keep their proportions.
class Camera {
 public:
  explicit Camera(const Vector3& scale = Vector3::Ones()) : scale_(scale) {
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
    return m * scale_.asDiagonal();
  }

 private:
  static constexpr double kDegree = 0.017453292519943295;

  Vector3 scaled(const Vector3& p) const { return scale_.cwiseProduct(p); }

  Vector3 scale_, right_, up_, towards_;
};

}  // namespace trajet::detail
