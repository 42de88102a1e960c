#pragma once

#include <optional>
#include <vector>

#include "trajet/geom/solid.hpp"

namespace trajet {

/// A solid that stands in a compound's frame.
struct CompoundPart {
  Solid solid;
  Vector3 p_BP;  ///< of the solid's centre of mass, m
  Matrix3 R_BP;
  std::optional<double> density{};  ///< kg/m^3
};

/// In the frame of the common centre of mass.
struct CompoundParts {
  std::vector<CompoundPart> parts;
  VolumeProperties properties;   ///< the inertia is that of a mass of 1 kg for each m^3 of all
  std::optional<double> mass{};  ///< kg, of parts with densities
  Vector3 origin;                ///< of the frame in which the parts were given, in this one, m
};

/// Parts become one, moved to the common centre of mass. All have a density or none has: then they have the same. Parts
/// that overlap count twice where they do. Throws std::domain_error if there is no part, or one without volume.
Compound make_compound(std::vector<CompoundPart> parts);

}  // namespace trajet
