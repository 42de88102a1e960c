#pragma once

#include <optional>

#include "trajet/collide/sustain/contact_law.hpp"

namespace trajet {

/// The law of a group in which a body sticks to an obstacle and moves as that does, whatever acts on it: its rates are
/// those of a place of the obstacle.
///
/// \param obstacle  how it moves; of the contact no more is used
/// \param place     of the body's centre, m, as the obstacle stood at the start
/// None where a function by which the obstacle moves has no derivative among our operations (a table).
std::optional<Program> make_stuck_law(const Program& law, const SustainedBody& body, const SustainedContact& obstacle,
                                      const Vector3& place);

}  // namespace trajet
