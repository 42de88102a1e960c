#pragma once

#include <string>
#include <vector>

#include "plot_panel.hpp"
#include "row_style.hpp"
#include "shown_clock.hpp"
#include "trajet/viz/gnuplot.hpp"

namespace trajet::detail {

/// Panels side by side of what becomes of the bodies that turn, against time: the stretch |det R - 1|, the angle from
/// the reference's orientation, the drifts of energy and angular momentum. Those are left out of which no row knows
/// anything but rounding.
class RotationPanels {
 public:
  RotationPanels(const Comparison& comparison, const std::vector<RowStyle>& styles);

  bool is_empty() const { return panels_.empty(); }
  /// Pixels that the panels should have, or 0 if there are none.
  int height() const { return is_empty() ? 0 : 270; }
  /// The lines of a gnuplot script that fill the lowest `height()` pixels above `bottom` with the panels.
  std::string script(int bottom, const FigureSize& size) const;

 private:
  struct Line {
    std::vector<std::vector<double>> points;
    Color color;
    int dash;
  };
  struct Panel {
    std::string title;
    std::vector<Line> lines;
  };
  ShownClock clock_;
  std::vector<Panel> panels_;
};

}  // namespace trajet::detail
