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
  std::optional<double> mass{};  ///< kg
};

/// In the frame of the common centre of mass.
struct CompoundParts {
  std::vector<CompoundPart> parts;
  double volume = 0.0;                      ///< of all parts, m^3; thin ones have none
  Matrix3 unit_inertia = Matrix3::Zero();   ///< of 1 kg, about the origin, m^2
  std::optional<double> mass{};             ///< kg, of parts with masses
  Vector3 origin = Vector3(0.0, 0.0, 0.0);  ///< of the frame in which the parts were given, in this one, m
};

/// Parts become one, moved to the common centre of mass. All have a mass or none has: then they have one density. Parts
/// that overlap count twice where they do. Throws std::domain_error if there is no part, one without mass that has no
/// volume, or one that can have no inertia.
Compound make_compound(std::vector<CompoundPart> parts);

}  // namespace trajet
