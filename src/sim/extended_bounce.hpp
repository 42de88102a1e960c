#pragma once

#include <Eigen/Core>

#include "encounters.hpp"
#include "instant.hpp"

namespace trajet {

/// A frictionless bounce in extended precision, where the course carries its state so: puts position and velocity of
/// the body behind it into the instant.
///
/// The root that the search found in double precision is polished on the step's own series, and so is the normal. The
/// body bounces at that time, which lies between two doubles, and flies on to the instant's, which is one.
void bounce_extended(const World& world, const Pair& pair, Instant& instant);

}  // namespace trajet
