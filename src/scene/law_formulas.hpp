#pragma once

#include <vector>

#include "trajet/scene/world.hpp"

namespace trajet {

/// Appends the formulas of a body's laws, so that a failure of the numbers can be told where it is written. `index`: of
/// the body in World::bodies.
void add_formulas(const BodyDefinition& definition, const World::Body& body, int index,
                  std::vector<World::LawFormula>& formulas);

}  // namespace trajet
