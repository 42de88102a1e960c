#pragma once

#include "trajet/scene/world.hpp"

namespace trajet {

/// Throws InputError where a body can never meet an obstacle: one with extent a terrain, a ball the walls of a cavity
/// whose bends are narrower than it.
void check_fits(const World& world);

/// Throws InputError at a point or sphere that starts inside an obstacle, by more than what rounding leaves open: that
/// much the run itself decides, which knows where the body goes.
void check_starts(const World& world);

/// Warns where the times of a run are so large that what is short beside it is lost between two doubles.
void warn_of_coarse_times(World& world, double end);

}  // namespace trajet
