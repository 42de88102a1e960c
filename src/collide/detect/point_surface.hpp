#pragma once

#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/triangle_surface.hpp"

namespace trajet::detail {

/// The first contact of a point with a surface of triangles: it crosses or touches one of them. Where it is on the
/// surface when the search begins, at an edge or a corner too, `memory.side` is the side of all triangles there, which
/// look to the same side.
ContactResult point_surface_contact(const SurfaceTriangles& surface, const MovingBall& point,
                                    const ContactMemory& memory);

}  // namespace trajet::detail
