#pragma once

#include <cstddef>
#include <string>

#include "trajet/ensemble/sweep_summary.hpp"
#include "trajet/viz/gnuplot.hpp"

namespace trajet {

/// The rows of a sweep, for its figure.
struct ShownSweep {
  std::string title;
  SweepHeader header;
  std::size_t axis_count = 0;  ///< of the grid: the first quantities
  bool is_sampled = false;     ///< further quantities are random
  SweepRowSource rows;
};

/// The figure of a sweep: the first columns of numbers, against the quantity of a grid of one axis, as heat maps over the
/// first two of more axes, or as histograms of random motions; with these where the first impacts lie on what was hit
/// most, with the ellipses that hold 50 % and 95 % of normal ones. Of very many rows some are drawn.
Figure sweep_figure(const ShownSweep& sweep, const SweepSummary& summary);

}  // namespace trajet
