#pragma once

#include "scene_numbers.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// A body's shape with its numbers. Throws InputError that points at the place.
Solid make_solid(const BodyDefinition& body, const SceneNumbers& numbers);

/// An obstacle with its numbers, but for its restitution and how it moves: several of one name where it has parts.
/// `at_start`: the numbers of its place, in which t is that of the start. Throws InputError that points at the place.
std::vector<World::Obstacle> make_obstacles(const ObstacleDefinition& obstacle, const SceneNumbers& numbers,
                                            const SceneNumbers& at_start);

}  // namespace trajet
