#pragma once

#include "trajet/scene/world.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// What a report says of a body when its group is in state q, whose rate is dq.
BodyState body_state(const World::Body& body, const Eigen::VectorXd& q, const Eigen::VectorXd& dq);

/// The angular velocity of a body, world frame, rad/s.
Vector3 angular_velocity(const World::Body& body, const Eigen::VectorXd& q);
/// Its angular acceleration where the group's state has the rate dq, world frame, rad/s^2.
Vector3 angular_acceleration(const World::Body& body, const Eigen::VectorXd& q, const Eigen::VectorXd& dq);

/// The quaternion that the numbers of an orientation stand for; of a matrix that has drifted the nearest rotation.
Quaternion reported_orientation(const OrientationLayout& layout, const double* part);
/// A vector that stands in the layout's frame, in the world's; `part` are the numbers of the orientation.
Vector3 in_world(const OrientationLayout& layout, const double* part, const Vector3& v);

}  // namespace trajet
