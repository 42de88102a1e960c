#pragma once

#include <Eigen/Core>

#include "passages.hpp"

namespace trajet {

/// Misses as two numbers: along two directions at right angles to a reference direction of motion.
class MissFrame {
 public:
  explicit MissFrame(const Vector3& direction);
  /// The residual turned as the passage's direction is turned to the reference: smooth, and of the same length.
  Eigen::Vector2d operator()(const Passage& passage) const;

 private:
  Vector3 direction_;
  Eigen::Matrix<double, 3, 2> across_;
};

/// d(x) = value + slope x: two equations for some unknowns.
struct LinearMiss {
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, Eigen::Dynamic> slope{};

  /// Number of equations that the unknowns have a say in; and how fast the slowest of these changes.
  int rank() const;
  double slowest() const;
};

/// Where the model is least within a box about 0, of half widths 1.  // (unknowns)
Eigen::VectorXd least_within_box(const LinearMiss& model);

/// The shortest step from `x` to the model's zero, or to where it is least, along the unknowns that can move: none
/// leaves 0..1. `model.value` is that at x.
Eigen::VectorXd newton_step(const LinearMiss& model, const Eigen::VectorXd& x);

}  // namespace trajet
