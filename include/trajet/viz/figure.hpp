#pragma once

#include <string>

#include "trajet/viz/gnuplot.hpp"

namespace trajet {

/// A picture before it is drawn.
struct Figure {
  std::string script;  ///< for `draw`
  FigureSize size;
};

}  // namespace trajet
