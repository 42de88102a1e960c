#pragma once

#include "scene_numbers.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// Gives the obstacle that the World has got last its restitution, a number or a formula of the speed of approach `u`.
/// Throws InputError at what is wrong with it; the World warns of one that nothing needs.
void set_restitution(const ObstacleDefinition& obstacle, const Symbols& constants, const SceneNumbers& numbers,
                     World& world);

}  // namespace trajet
