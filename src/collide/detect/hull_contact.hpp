#pragma once

#include "trajet/collide/detect/contact_table.hpp"

namespace trajet::detail {

/// The first contact of a ball with a convex surface, which is a solid.
ContactResult hull_contact(const MeshSurface& surface, const MovingBall& ball, const ContactMemory& memory);

}  // namespace trajet::detail
