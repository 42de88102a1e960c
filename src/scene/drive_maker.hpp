#pragma once

#include <memory>

#include "scene_numbers.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// How an obstacle moves; none where it is at rest. `at_start`: the numbers of its place, in which t is that of the
/// start, `epoch`. Throws InputError that points at the place.
std::shared_ptr<const World::Drive> make_drive(const ObstacleDefinition& obstacle, const Symbols& constants,
                                               const SceneNumbers& at_start, double epoch);

}  // namespace trajet
