#pragma once

#include "scene_symbols.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// Gives a world the obstacles of its scene: where they stand, how they move, what happens at them. Its start is known.
/// Throws InputError that points at the place.
void make_obstacles(const Scene& scene, const ParameterSet& parameters, World& world);

/// Whether there are obstacles that turn and to which bodies stick.
bool may_turn_bodies(const Scene& scene, const World& world);

}  // namespace trajet
