#pragma once

#include "trajet/sim/motion_record.hpp"
#include "trajet/sim/run_result.hpp"
#include "trajet/viz/gnuplot.hpp"

namespace trajet {

/// The figure of a run: for each body position (blue), velocity (green) and acceleration (red) against time, the extra
/// states, the paths of all bodies, and the impacts. A large scene shows the first bodies and states only.
Figure run_figure(const RunResult& result, const MotionRecord& record);

}  // namespace trajet
