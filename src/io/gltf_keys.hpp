#pragma once

#include <map>

#include "trajet/sim/motion_record.hpp"

namespace trajet::detail {

/// Where a body is, and how it stands. World frame.
struct Pose {
  Vector3 position;
  Quaternion q_WB;
};

/// The poses of a body by key time (s from the start of the run), strictly increasing in single precision.
///
/// `fps` a second, one at the end; two at each impact of the body and at each event: at the time itself, and at the
/// next number of single precision. Quaternions follow each other without changes of sign.
std::map<float, Pose> animation_keys(const MotionRecord& motion, const RunResult& result, const World::Body& body,
                                     double fps);

}  // namespace trajet::detail
