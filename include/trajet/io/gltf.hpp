#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "trajet/sim/motion_record.hpp"
#include "trajet/sim/run_records.hpp"

namespace trajet {

/// No body of an animation has more regular keys.
inline constexpr double kMostAnimationKeys = 1e6;

/// A run as an animation in binary glTF 2.0 (a `.glb` file): docs/formats/gltf.md.
///
/// A node per body and obstacle, named after it. Every body has translation keys, and rotation keys if it turns: `fps`
/// > 0 keys a second, one at the end, two at each impact and event, and as many more where it turns fast that
/// neighbours are at most a quarter of a turn apart, so that linear interpolation shows it where it is. Key times count
/// from the start of the run. Keys are in the scene's world frame, the meshes of obstacles in frames of their
/// own; the root node `world` turns a scene of z up to the y up of glTF. That node carries the impacts and events as
/// `extras`. Throws std::length_error where `fps` gives more than kMostAnimationKeys keys, FileError where a body turns
/// too fast for so many, or a file would be larger than glTF allows (4 GiB).
///
/// `write` gets the file part by part: what happened in the run is never one text in memory.
void write_gltf(const RecordedMotion& motion, const RunResult& result, const RunRecords& records, double fps,
                const std::function<void(std::string_view)>& write);

/// The same in one text, of a result that holds its impacts and events.
std::string gltf_binary(const RecordedMotion& motion, const RunResult& result, double fps);

}  // namespace trajet
