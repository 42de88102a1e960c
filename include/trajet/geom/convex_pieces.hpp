#pragma once

#include <memory>
#include <vector>

#include "trajet/geom/convex_core.hpp"

namespace trajet {

/// The convex solids whose union a solid is: one, or of a mesh all its triangles.
using ConvexPieces = std::vector<ConvexCore>;

ConvexPieces convex_pieces(const Solid& solid);

}  // namespace trajet
