#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "plot_panel.hpp"
#include "pose_strip.hpp"
#include "row_style.hpp"
#include "trajet/viz/compare_figure.hpp"

namespace trajet::detail {

/// The panel of a comparison's figure that shows the motions over the reference.
class MotionsPanel {
 public:
  /// All arguments outlive the panel.
  MotionsPanel(const Comparison& comparison, const World& world, const std::vector<RowMotion>& motions,
               const std::optional<ShownComponent>& component, const std::vector<RowStyle>& styles);

  /// How many lines its legend has, which stands above its upper left corner.
  std::size_t legend_lines() const { return 1 + rows_.size(); }
  std::string script(const Frame& frame, const FigureSize& size) const;
  /// The solids that turn, as they stand in each motion.
  PoseStrip strip() const;
  /// The largest component of the reference's state, 0 if it knows none: SI units.
  double reference_size() const;
  /// Names a row: its method, with its step or tolerance.
  std::string title(const ComparisonRow& row) const;

 private:
  /// What is drawn of the state of each body, or of the one group of states.
  struct Owner {
    int group;
    int offset;
    std::optional<std::size_t> body;
  };
  struct States {
    std::vector<double> times;
    std::vector<std::vector<double>> values;
  };

  void choose_rows();
  void choose_components();
  double error(std::size_t row) const;
  const RowStyle& style(const ComparisonRow& row) const;
  /// In the legend, which says so if the motion is cut.
  std::string title(std::size_t row, bool is_cut) const;
  /// How far the reference is drawn, s: to its end, and closed forms, which know nothing of impacts, to the end of the
  /// motion that is nearest to them, or the first plane behind which they lead.
  double find_reference_end() const;
  double closed_form_end(double until) const;
  States reference_states(int group) const;
  /// Of a body of the World; none where the reference does not know its orientation.
  std::vector<Pose> reference_poses(const World::Body& body) const;
  /// A row's line: rows of one method differ by their dashes.
  std::string line_style(std::size_t row) const;
  /// What a motion takes up in space, its solids included.
  Eigen::AlignedBox3d extent_of(const RowMotion& motion) const;
  Eigen::AlignedBox3d reference_extent() const;
  std::string space_script(const Frame& frame, const FigureSize& size) const;
  std::string plot_script(const Frame& frame) const;

  ShownClock clock() const { return {world_.epoch, world_.duration}; }

  const Comparison& comparison_;
  const World& world_;
  const std::vector<RowMotion>& motions_;
  const std::optional<ShownComponent>& component_;
  const std::vector<RowStyle>& styles_;
  std::vector<std::size_t> rows_;  // that are drawn
  std::vector<Owner> owners_;      // all are drawn alike
  std::vector<int> components_;    // behind the owner's offset; one: against time
  std::vector<std::string> labels_;
  std::vector<std::size_t> solids_;  // bodies that turn and have a shape or points
  bool is_in_space_ = false;
  double reference_end_ = 0.0;  // s
};

}  // namespace trajet::detail
