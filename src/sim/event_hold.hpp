#pragma once

#include <Eigen/Core>
#include <optional>

#include "trajet/law/held_law.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

class Instant;

/// A motion that stays where an event happens, because the law brings it back there as soon as the event's `set` has
/// turned it away: a ball at rest whose bounces are written as an event.
struct EventHold {
  int event = 0;              ///< in World::events
  int side = 1;               ///< -1 or 1: the sign of the event's function where the motion came from
  Eigen::VectorXd direction;  ///< of the state, along which the `set` acts
  Program border;             ///< of HeldLaw
};

/// Holds the motion of an instant at the limit of an event that has happened infinitely often in finite time, and last
/// in `crossing_direction` (-1 or 1): its state becomes that of the limit. Where the law does not push the motion back,
/// or the `set` changes the state even there, or that cannot be told, the instant stays as it was: false.
bool hold_at_limit(const World& world, int event, int crossing_direction, Instant& instant);

}  // namespace trajet
