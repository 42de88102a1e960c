#pragma once

#include <vector>

#include "encounters.hpp"
#include "instant.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// Where a body meets several perfectly inelastic obstacles at one instant, or one while it stays on others: their
/// impacts, solved together, each with its share of the change of the velocity. The instant goes on with the velocity
/// behind them. Empty where `handled` is no such impact or the only one; then nothing has changed.
///
/// \param handled  the pair whose impact is being handled
/// \param impact   as it is described before it has an impulse
/// \param mass     of the body, kg; 1 where it has none
std::vector<Impact> bounce_plastic(const World& world, const Encounters& encounters, const Pair& handled,
                                   const Impact& impact, double mass, Instant& instant);

}  // namespace trajet
