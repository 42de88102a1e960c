#pragma once

#include <optional>

#include "trajet/geom/solid.hpp"

namespace trajet {

/// The inertia of 1 kg about the centre of mass, m^2, in the solid's frame: spread evenly over its volume, or over the
/// area of a thin disk; of a compound whose parts have masses, as these have them. None of what has neither, or no
/// bounds.
std::optional<Matrix3> unit_inertia(const Solid& solid);

}  // namespace trajet
