#pragma once

#include <Eigen/Core>
#include <vector>

namespace trajet {

/// A point of a contact that does not move along its surface and what friction at such points does there. Tangential
/// coordinates; friction of all is put together to the three numbers of a planar wrench, of which one point needs two.
struct OnsetPoint {
  using Rows = Eigen::Matrix<double, 2, 3>;
  Eigen::Vector2d free = Eigen::Vector2d::Zero();                    ///< m/s^2: its acceleration without that friction
  Rows by_wrench = Rows::Zero();                                     ///< what the wrench adds to it
  double normal = 0.0;                                               ///< N: its normal force without that friction
  Eigen::RowVector3d normal_by_wrench = Eigen::RowVector3d::Zero();  ///< what the wrench adds to it
  Rows share = Rows::Zero();  ///< transposed: what its own friction is of the wrench
};

/// How points of a contact begin to move along the surface.
struct SlipOnset {
  bool is_found = false;
  std::vector<Eigen::Vector2d> rates{};  ///< m/s^2; of points that hold, a creep that tells how they share the load
  std::vector<bool> holds{};             ///< of each point
  double creep = 0.0;                    ///< m/s^2: where friction has come to 1/sqrt(2) of its limit
  bool hold_all() const;
};

/// Friction acts against the acceleration of each point with `coefficient` times its normal force; where less stops it,
/// with that. It is the limit of friction that grows with the rate of creep: with constant normal forces the minimum of
/// a convex function, so that there is one acceleration.
SlipOnset find_onset(const std::vector<OnsetPoint>& points, double coefficient);

}  // namespace trajet
