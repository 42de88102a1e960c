#pragma once

#include <optional>
#include <span>

#include "trajet/law/pinned_law.hpp"

namespace trajet {

/// A border along which a motion slides because both branches drive it there.
struct SlidingBorder {
  int border = 0;   ///< in PinnedLaw::borders
  double at = 0.0;  ///< its value
};

/// The law of a motion along borders, [Filippov1988]: of the laws on the two sides of each border such shares that the
/// function of no border changes.
struct SlidingLaw {
  Program law;        ///< inputs and outputs as those of the pinned law
  Program shares;     ///< of the side above each border: the motion slides as long as all lie between 0 and 1
  Program residuals;  ///< of several borders: what the law on all of their upper sides has that the shares leave out;
                      ///< where it is not zero, the shares mean nothing
};

/// `sides`: of all borders. None where a function on the way has no derivative among our operations (a table).
std::optional<SlidingLaw> make_sliding_law(const PinnedLaw& pinned, std::span<const BorderSide> sides,
                                           std::span<const SlidingBorder> sliding);

}  // namespace trajet
