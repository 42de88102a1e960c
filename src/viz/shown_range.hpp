#pragma once

#include <vector>

#include "plot_panel.hpp"

namespace trajet::detail {

/// The ranges of something along all axes of a picture.
using Ranges = std::vector<Range>;

/// What the axes of a picture show of a reference and of motions that are compared with it: the whole reference, and
/// each motion that stays near it, within twice its extent along each axis, or twice `least_extent`, on both sides.
/// Of the others, what happens to lie there. An axis of which the reference knows nothing shows all motions.
Ranges shown_ranges(const Ranges& reference, const std::vector<Ranges>& motions, double least_extent);

/// Whether a motion is cut by a picture that shows that.
bool leaves(const Ranges& motion, const Ranges& shown);

}  // namespace trajet::detail
