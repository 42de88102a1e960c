#pragma once

#include <functional>
#include <map>
#include <string>

#include "trajet/law/measure.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet {

/// What is known of the dimensions of a scene's parameters, from the units in their texts.
///
/// Throws InputError where a text contradicts itself.
std::map<std::string, Measure, std::less<>> parameter_measures(const Scene& scene);

/// Throws InputError at the first formula whose dimension contradicts what it is for, or itself. The formulas must be
/// ones that compile.
void check_units(const Scene& scene);

}  // namespace trajet
