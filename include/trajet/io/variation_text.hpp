#pragma once

#include <string>

#include "trajet/ensemble/sweep_plan.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet {

/// NAME=LOW:HIGH or NAME=LOW:HIGH:COUNT of a command line: a parameter or a key of the scene, and the values at the
/// ends of its range as in scene files (`theta=-1deg:1 deg:1001`). COUNT is 0 where it is left out.
///
/// Throws InputError whose place is `option` and the name. Adds a sentence to the scene's warnings where a bare number
/// stands for what has a unit in the scene.
GridAxis read_range(const std::string& text, const std::string& option, Scene& scene);

/// NAME=normal(MEAN,SD), uniform(LOW,HIGH), lognormal(MEAN,SD) or truncated(MEAN,SD,LOW,HIGH), likewise.
SampledQuantity read_sample(const std::string& text, const std::string& option, Scene& scene);

/// X,Y,Z of a command line, m: numbers, quantities or formulas of the scene's parameters as they stand. Throws InputError
/// whose place is `option`.
Vector3 read_point(const std::string& text, const std::string& option, const Scene& scene);

/// NAME,NAME=COEFFICIENT of two of the sampled quantities.
Correlation read_correlation(const std::string& text, const std::string& option,
                             const std::vector<SampledQuantity>& samples);

}  // namespace trajet
