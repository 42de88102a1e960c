#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "trajet/scene/world.hpp"

namespace trajet::detail {

/// Where driven obstacles come: their outlines as closed lines, m, at equal times behind the start of a run of that
/// duration, s. A ball's is a circle `across` a direction. None of planes and grounds, which the picture cuts, of what
/// has so many faces that lines would hide it, and of what is farther from the `motion` than that is large.
std::vector<std::vector<Vector3>> driven_outlines(const World& world, double duration, const Vector3& across,
                                                  const Eigen::AlignedBox3d& motion);

}  // namespace trajet::detail
