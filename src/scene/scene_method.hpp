#pragma once

#include "scene_numbers.hpp"
#include "trajet/scene/scene.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// Finds the scene's method and gives its options their numbers, into a World whose times are set. Throws InputError
/// for an unknown method, a missing step, an order that cannot be chosen.
void set_method(const MethodOptions& method, const SceneNumbers& numbers, World& world);

/// Throws InputError at the formula that the World's method cannot integrate, once the groups have their laws.
void check_that_method_suits(const Scene& scene, const World& world);

}  // namespace trajet
