#pragma once

#include "scene_numbers.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// Tells the bodies of a world whom they meet, and pairs what becomes of them, as the scene says. Its bodies and
/// obstacles are made. Throws InputError that points at the place.
void make_companies(const Scene& scene, World& world);
void make_pairs(const Scene& scene, const SceneNumbers& numbers, World& world);

}  // namespace trajet
