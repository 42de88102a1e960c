#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace trajet {

/// A vector of three numbers of any number type: double, Series, Pack, Interval.
template <class T>
using Vector3T = Eigen::Matrix<T, 3, 1>;

using Vector3 = Vector3T<double>;
using Matrix3 = Eigen::Matrix3d;
/// (w, x, y, z), Hamilton. A unit quaternion `q_WB` maps body coordinates to world coordinates.
using Quaternion = Eigen::Quaterniond;

}  // namespace trajet
