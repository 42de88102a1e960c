#pragma once

#include "scene_numbers.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// Gives the obstacles that a definition has become their restitution, a number or a formula of the speed of approach
/// `u`. Throws InputError at what is wrong with it; `warnings` get a sentence on one that nothing needs.
void set_restitution(const ObstacleDefinition& obstacle, const Symbols& constants, const SceneNumbers& numbers,
                     std::vector<World::Obstacle>& made, std::vector<std::string>& warnings);

}  // namespace trajet
