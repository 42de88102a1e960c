#pragma once

#include <string>
#include <vector>

#include "drawing.hpp"
#include "plot_panel.hpp"
#include "shown_clock.hpp"
#include "trajet/viz/gnuplot.hpp"

namespace trajet::detail {

/// A panel with a row of pictures for each body: how it stands at several times, seen from its centre. All pictures
/// have one scale, so that growth is seen.
class PoseStrip {
 public:
  explicit PoseStrip(const ShownClock& clock, UpAxis up = UpAxis::z) : clock_(clock), axes_(up) {}
  void add_row(const std::string& title, const Look& look, const std::vector<Pose>& poses, Color color);
  bool is_empty() const { return rows_.empty(); }
  /// Pixels that a row should have.
  static constexpr int kRowHeight = 138;
  int height() const { return kRowHeight * static_cast<int>(rows_.size()); }

  /// The lines of a gnuplot script that fill a frame of the figure with the panel.
  std::string script(const Frame& frame, const FigureSize& size) const;

 private:
  struct Row {
    std::string title;
    Look look;
    std::vector<Pose> poses;
    Color color;
  };
  ShownClock clock_;
  PictureAxes axes_;
  std::vector<Row> rows_;
};

}  // namespace trajet::detail
