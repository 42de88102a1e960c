#pragma once

#include <span>
#include <vector>

#include "trajet/sim/motion_record.hpp"

namespace trajet::detail {

/// Where a thing is, and how it stands. World frame.
struct Pose {
  Vector3 position;
  Quaternion q_WB;
};

/// The poses of a body at increasing times, as the buffers of glTF have them: single precision.
struct AnimationKeys {
  std::vector<Eigen::Matrix<float, 1, 1>> times;  ///< s from the start of the run, strictly increasing
  std::vector<Eigen::Vector3f> positions;         ///< m
  std::vector<Eigen::Vector4f> rotations;         ///< x, y, z, w; without changes of sign from one to the next;
                                                  ///< of a body that does not turn the first one alone
};

/// `fps` keys a second and one at the end; two at each of the `jumps` (s, in the order of the run): at the time itself,
/// and at the next number of single precision; and where the body turns by more than a quarter of a turn from one key
/// to the next, as many in between as that needs. No keys where the run ended at its start.
///
/// Throws std::length_error for more than kMostAnimationKeys keys by `fps` alone, FileError where the body turns so
/// fast that it needs more of them, or keys closer than single precision can tell.
AnimationKeys animation_keys(const RecordedMotion& motion, const RunResult& result, const World::Body& body,
                             std::span<const double> jumps, double fps);
/// The same of a driven obstacle that is drawn so at the start.
AnimationKeys animation_keys(const RunResult& result, const World::Obstacle& obstacle, const Pose& start, double fps);

}  // namespace trajet::detail
