#pragma once

#include <array>
#include <string>
#include <vector>

#include "drawing.hpp"
#include "plot_panel.hpp"
#include "space_panel.hpp"
#include "trajet/sim/motion_record.hpp"
#include "trajet/sim/run_result.hpp"
#include "trajet/viz/curve.hpp"
#include "trajet/viz/gnuplot.hpp"

namespace trajet::detail {

/// The colour of a body: its own, or one by its index.
Color body_color(const World& world, std::size_t body);

/// The panel of a run's figure that shows where everything went: the paths, the solids as they stood, the obstacles,
/// the impacts. In space, or where all points move in one plane of the axes, in that plane.
///
/// What only turns about a fixed centre stands as at the end, in red, over its start in blue where it has no extent,
/// with its axis of rotation in black and the ways of those of its named points that the eye can follow.
class PathPanel {
 public:
  /// `curves`: of each group. All arguments outlive the panel.
  PathPanel(const RunResult& result, const MotionRecord& record, const std::vector<Curve>& curves);

  /// Nothing moves, or on a line alone.
  bool is_empty() const { return !is_in_space_ && kept_.size() < 2; }
  bool is_in_space() const { return is_in_space_; }
  /// How many times as wide as high its picture wants to be.
  double aspect() const;
  std::string script(const Frame& frame, const FigureSize& size) const;

 private:
  const Curve& curve(const World::Body& body) const { return curves_[static_cast<std::size_t>(body.group)]; }
  /// Around the ways of all bodies.
  Eigen::AlignedBox3d motion_box() const;
  std::vector<Vector3> path(const World::Body& body) const;
  std::vector<Vector3> way_of(const World::Body& body, const World::Point& point) const;
  /// In the world, at the end.
  Vector3 angular_velocity(const World::Body& body) const;
  /// A turning body that has something to show.
  bool is_turning_solid(const World::Body& body) const;
  bool stays(const World::Body& body) const;
  SpacePanel space_panel() const;
  std::string plane_script(const Frame& frame) const;

  const RunResult& result_;
  const MotionRecord& record_;
  const World& world_;
  const std::vector<Curve>& curves_;
  std::vector<int> kept_;  // the coordinates that change
  bool is_in_space_ = false;
};

}  // namespace trajet::detail
