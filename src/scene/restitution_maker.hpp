#pragma once

#include "scene_numbers.hpp"
#include "trajet/collide/respond/restitution_law.hpp"

namespace trajet {

/// The restitution of an obstacle, a number or a formula of the speed of approach `u`. Throws InputError at what is
/// wrong with it.
RestitutionLaw make_restitution(const ObstacleDefinition& obstacle, const Symbols& constants,
                                const SceneNumbers& numbers);

}  // namespace trajet
