#pragma once

#include <vector>

#include "trajet/sim/motion_record.hpp"

namespace trajet {

/// Where a body is and how it stands at one time.
struct Pose {
  double time = 0.0;  ///< s
  Vector3 p_WB;       ///< m
  Matrix3 R_WB;       ///< as carried: it may stretch where the way lets it
};

/// Of a body of a World, from the state of its group at that time.
Pose pose(const World::Body& body, double time, const Eigen::VectorXd& state);

/// Some twelve times from `start` to `end`, both included: the start and round steps from there, 1, 2 or 5 times a
/// power of ten.
std::vector<double> pose_times(double start, double end);

/// The poses of a body at times in the order of the run; those of the start where the run ended there.
std::vector<Pose> poses_at(const MotionRecord& record, const World::Body& body, const std::vector<double>& times);

/// The poses of a body at the `pose_times` of its motion.
std::vector<Pose> make_poses(const MotionRecord& record, const World::Body& body);

}  // namespace trajet
