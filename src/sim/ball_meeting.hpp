#pragma once

#include "trajet/collide/detect/contact.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// A stretch of time, s; `to` before `from` where the integration runs backward.
struct TimeSpan {
  double from = 0.0;
  double to = 0.0;
};

/// The first contact of two points or balls, at least one a ball, each on its Segment; both cover the time. What is
/// searched is the one's path as the other sees it, in the axes of the world, so that two that fall alike move
/// uniformly.
ContactResult first_contact_of_balls(const World::Body& a, const Segment<>& motion_a, const World::Body& b,
                                     const Segment<>& motion_b, const TimeSpan& span, Locator locator,
                                     const ContactMemory& memory);

}  // namespace trajet
