#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "drawing.hpp"
#include "plot_panel.hpp"
#include "trajet/viz/gnuplot.hpp"

namespace trajet::detail {

/// What a body takes up as it stands, world frame.
Eigen::AlignedBox3d extent(const Look& look, const Pose& pose);

/// The panel of a figure that shows what happens in space: paths, solids as they stand, obstacles, within axes.
///
/// Where the motion does not extend much farther along one axis than along another, or where a solid turns, all axes
/// have the same scale, so that a ball is round; else each axis has its own.
class SpacePanel {
 public:
  explicit SpacePanel(UpAxis up) : axes_(up) {}

  /// `style`: as gnuplot's `with` takes it, `lines lw 2 lc 'red'`. Without a title it has no entry in the legend.
  void add_path(std::vector<Vector3> points, const std::string& style, const std::string& title = "");
  /// A path with its shadow on the floor.
  void add_shadowed_path(std::vector<Vector3> points, const std::string& style, const std::string& title);
  void add_body(const Look& look, const Pose& pose, Color color);
  /// The picture shows this, and obstacles near by, instead of all that was added; paths are cut where they leave it,
  /// and solids that reach beyond are left out.
  void show(const Eigen::AlignedBox3d& box) { shown_ = box; }
  void add_obstacles(const std::vector<World::Obstacle>& obstacles) { obstacles_ = obstacles; }

  /// How many times as wide as high the picture is.
  double aspect() const;
  /// The lines of a gnuplot script that fill a frame of the figure with the panel; what a legend needs is set before.
  std::string script(const Frame& frame, const FigureSize& size) const;

 private:
  struct Path {
    std::vector<Vector3> points;
    std::string style, title;
  };
  struct Body {
    Look look;
    Pose pose;
    Color color;
  };

  Eigen::AlignedBox3d axes_box() const;
  bool has_one_scale(const Eigen::AlignedBox3d& box) const;

  PictureAxes axes_;
  std::vector<Path> paths_, shadows_;
  std::vector<Body> bodies_;
  std::vector<World::Obstacle> obstacles_;
  Eigen::AlignedBox3d motion_;  // of all paths and solids
  std::optional<Eigen::AlignedBox3d> shown_;
  bool has_turning_solid_ = false;
};

}  // namespace trajet::detail
