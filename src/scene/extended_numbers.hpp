#pragma once

#include "trajet/law/symbols.hpp"
#include "trajet/scene/scene.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// The numbers of a scene in extended precision, for a World that has the others already.
World::ExtendedNumbers extended_numbers(const Scene& scene, const World& world, const Symbols& parameters);

}  // namespace trajet
