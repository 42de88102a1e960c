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

/// The motion of a group of a World, with points close enough for a line to look smooth where the motion is, at least
/// one on each piece unless these are too short to be seen, and two at each jump of the state or its rate.
Curve make_curve(const MotionRecord& record, int group);

}  // namespace trajet
