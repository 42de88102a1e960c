#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "camera.hpp"
#include "plot_panel.hpp"

namespace trajet::detail {

/// A camera and where its picture lies in a panel, in pixels from the lower left corner.
struct View {
  Camera camera;
  PictureAxes axes;
  Vector2 pixels(const Vector3& p) const { return camera.project(p) + offset; }
  Vector2 offset = Vector2::Zero();
};

/// How many times as wide as high the picture of a box is, without the labels of its axes.
double aspect(const Eigen::AlignedBox3d& box, bool one_scale, const PictureAxes& axes);

/// The view that shows a box as large as a panel of `size` (pixels) has room for beside the labels of the axes.
/// `one_scale`: the same for all axes.
View fit(const Eigen::AlignedBox3d& box, bool one_scale, const PictureAxes& axes, const Vector2& size);

/// The grid on the floor and on the two walls behind, and the axes with their marks and labels, in metres.
struct SpaceAxes {
  std::vector<std::vector<Vector2>> walls, floor, axes;
  std::string labels;      // lines of a gnuplot script
  std::string end_labels;  // lines that remove them
};
SpaceAxes space_axes(const Eigen::AlignedBox3d& box, const View& view);

}  // namespace trajet::detail
