#pragma once

#include "trajet/geom/aabb.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// A box around all places that a body takes on a Segment of its group between two times, whatever its orientation.
Aabb swept_box(const World::Body& body, const Segment<>& segment, double from, double to);

}  // namespace trajet
