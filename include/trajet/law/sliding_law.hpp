#pragma once

#include <optional>
#include <span>

#include "trajet/law/pinned_law.hpp"

namespace trajet {

/// A border along which a motion slides because both branches drive it there, or a direction whose vector the law
/// holds at zero.
struct SlidingBorder {
  int border = 0;   ///< in PinnedLaw::borders, and behind them the directions
  double at = 0.0;  ///< its value
};

/// The law of a motion along borders, [Filippov1988]: of the laws on the two sides of each border such shares that the
/// function of no border changes. In place of a direction a vector u for which its vector does not change.
struct SlidingLaw {
  Program law;        ///< inputs and outputs as those of the pinned law
  Program shares;     ///< of the side above each border, of a direction (1 + u^2) / 2: the motion slides as long as all
                      ///< lie between 0 and 1
  Program residuals;  ///< of several: what the law on all of their upper sides has that the shares leave out; where it
                      ///< is not zero, the shares mean nothing
  Program holds;      ///< of each direction: u, the rate of its vector where u were 0, and the sum of what each
                      ///< component of u does to its own component of that rate
};

/// `sides`: of all borders. None where a function on the way has no derivative among our operations.
std::optional<SlidingLaw> make_sliding_law(const PinnedLaw& pinned, std::span<const BorderSide> sides,
                                           std::span<const SlidingBorder> sliding);

}  // namespace trajet
