#pragma once

#include "trajet/collide/detect/contact.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// Whether a body has corners that can be looked at one by one: it is a polytope, and no edge of it is round.
bool has_corners(const Solid& solid);

/// The first contact of a polytope's corners with an obstacle at rest as the course finds it: each corner is looked at
/// where steps end, by its 3.1 or 3.2. What happens within a step, and what edges and faces do, is missed.
ContactResult first_corner_contact(const World::Body& body, const World::Obstacle& obstacle, const Segment<>& motion,
                                   double from, double to, Locator locator, const ContactMemory& memory);

}  // namespace trajet
