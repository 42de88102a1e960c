#include "body_state.hpp"

#include "trajet/rigid/kinematics.hpp"

namespace trajet {
Quaternion reported_orientation(const OrientationLayout& layout, const double* part) {
  if (layout.way == OrientationWay::matrix) return from_rotation_matrix(nearest_rotation(layout.matrix(part)));
  return layout.quaternion(part);
}

Vector3 in_world(const OrientationLayout& layout, const double* part, const Vector3& v) {
  return layout.frame == Frame::world ? v : Vector3(layout.rotation(part) * v);
}

namespace {

/// A vector that the state, or its rate, holds behind the orientation, in the world's frame.
Vector3 in_world(const World::Rotation& rotation, const Eigen::VectorXd& q, const Eigen::VectorXd& holder) {
  return in_world(rotation.layout, q.data() + rotation.offset,
                  holder.segment<3>(rotation.offset + rotation.layout.size()));
}

}  // namespace

Vector3 angular_velocity(const World::Body& body, const Eigen::VectorXd& q) {
  return body.rotation ? in_world(*body.rotation, q, q) : Vector3(0, 0, 0);
}

// d(R w_B)/dt = R dw_B/dt, since w x w = 0: the same transformation
Vector3 angular_acceleration(const World::Body& body, const Eigen::VectorXd& q, const Eigen::VectorXd& dq) {
  return body.rotation ? in_world(*body.rotation, q, dq) : Vector3(0, 0, 0);
}

BodyState body_state(const World::Body& body, const Eigen::VectorXd& q, const Eigen::VectorXd& dq) {
  BodyState state;
  state.body = body.name;
  state.position = q.segment<3>(body.offset);
  state.velocity = q.segment<3>(body.offset + 3);
  state.acceleration = dq.segment<3>(body.offset + 3);
  state.orientation = body.q_WB;
  if (body.rotation) {
    const World::Rotation& rotation = *body.rotation;
    const double* part = q.data() + rotation.offset;
    state.turns = true;
    state.rotation_matrix = rotation.layout.matrix(part);
    state.orientation = reported_orientation(rotation.layout, part);
    state.angular_velocity = angular_velocity(body, q);
  } else {
    state.rotation_matrix = rotation_matrix(body.q_WB);
  }
  const Vector3 turning_faster = angular_acceleration(body, q, dq);
  const PointMotion center{state.position, dq.segment<3>(body.offset), state.acceleration};
  for (const World::Point& point : body.points) {
    const PointMotion motion =
        point_motion(center, state.rotation_matrix, state.angular_velocity, turning_faster, point.p_B);
    state.points.push_back({point.name, motion.position, motion.velocity, motion.acceleration});
  }
  return state;
}

}  // namespace trajet
