#pragma once

#include "trajet/geom/solid.hpp"

namespace trajet {

/// A solid whose frame B stands in the world.
struct PlacedSolid {
  const Solid& solid;
  Vector3 p_WB;  ///< m
  Matrix3 R_WB;
};

/// Whether two bounded solids have more in common than points at which they touch. Balls and points by their distance,
/// all others as convex solids by the algorithm of Gilbert, Johnson and Keerthi; a mesh counts as its convex hull.
bool overlap(const PlacedSolid& a, const PlacedSolid& b);

}  // namespace trajet
