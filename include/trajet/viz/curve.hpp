#pragma once

#include <vector>

#include "trajet/sim/motion_record.hpp"

namespace trajet {

/// A motion as points to draw lines between.
struct Curve {
  std::vector<double> times;                // s
  std::vector<std::vector<double>> states;  // of each time, the state of the group
  std::vector<std::vector<double>> rates;   // and its derivative in time, that of the Segment
};

/// The motion of a group of a World, with as many points as a line needs to look smooth in whatever figures draw of it:
/// positions, velocities, accelerations, angular velocities, extra states, each in the scale of its axis, which may
/// show the motion up to any point, or from there on, as large as there is room. Both sides of a jump that can be seen
/// are among them. Orientations are not drawn against time: `poses_at` has them.
Curve make_curve(const MotionRecord& record, int group);

}  // namespace trajet
