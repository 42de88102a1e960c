#pragma once

#include <functional>
#include <vector>

#include "aim_flights.hpp"
#include "aim_model.hpp"

namespace trajet {

/// A place at which the miss vanishes.
struct AimRoot {
  AimPlace place{};
  Passage passage{};
  bool is_family = false;  ///< more unknowns than equations: one place of many
};

/// What has come of a search for a zero from a place on.
enum class RootOutcome {
  root,
  none,     ///< the miss is least at a place where it is not zero, or the flight is blocked there, or leaves the ranges
  stalled,  ///< the numbers led nowhere
};

/// Searches the zero of a label's miss from a place on, with a model of the miss there in units of the ranges:
/// Broyden's method with steps that are shortened until they help.
RootOutcome refine_aim(AimFlights& flights, const std::string& label, AimPlace place, LinearMiss model,
                       const MissFrame& frame, AimRoot& root);

/// The slopes of a label's miss at a place, by differences over steps of that share of the ranges; false where the
/// label ends.
bool slopes_at(AimFlights& flights, const std::string& label, const AimPlace& place, double step,
               const MissFrame& frame, LinearMiss& model);

struct AimRoots {
  std::vector<AimRoot> roots{};  ///< each once
  bool has_stalled = false;      ///< somewhere a zero is likely and was not found
  bool is_incomplete = false;    ///< too many motions were needed, or the search was ended
};

AimRoots find_aim_roots(AimFlights& flights, const std::function<bool()>& should_stop);

/// The place at which a motion comes nearest to the target, searched from the best of all that have been computed.
AimPlace find_closest(AimFlights& flights, const std::function<bool()>& should_stop);

/// The distance to the target that the flight comes to, m.
double least_miss(const AimFlight& flight);

}  // namespace trajet
