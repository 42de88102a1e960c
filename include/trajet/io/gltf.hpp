#pragma once

#include <string>

#include "trajet/sim/motion_record.hpp"

namespace trajet {

/// No body of an animation has more regular keys.
inline constexpr double kMostAnimationKeys = 1e6;

/// A run as an animation in binary glTF 2.0 (a `.glb` file): docs/formats/gltf.md.
///
/// A node per body and obstacle, named after it. Every body has translation keys, and rotation keys if it turns: `fps`
/// > 0 keys a second, one at the end, and two at each impact and event, so that linear interpolation shows it where it
/// is. Key times count from the start of the run. Keys and meshes are in the scene's world frame, z up; the root node
/// `world` turns it to the y up of glTF. That node carries the impacts as `extras`.
/// Throws std::length_error where `fps` gives more than kMostAnimationKeys keys.
std::string gltf_binary(const MotionRecord& motion, const RunResult& result, double fps);

}  // namespace trajet
