#pragma once

#include <string>

namespace trajet::detail {

/// gnuplot's SVG with names for people in the place of gnuplot's own, which browsers show where the pointer rests: the
/// `title` for the picture, for a curve what the legend calls it, and none for what the legend does not name.
std::string with_names(const std::string& svg, const std::string& title);

}  // namespace trajet::detail
