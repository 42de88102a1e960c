#include "space_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "obstacle_faces.hpp"
#include "polyline.hpp"
#include "space_axes.hpp"

#include "trajet/portable.hpp"

namespace trajet::detail {

namespace {

constexpr double kObstacleOpacity = 0.5;
/// Beyond this ratio of the sides of the axes' box each axis has a scale of its own.
constexpr double kLongestBox = 16.0;
/// A body whose picture has a smaller radius than this is not drawn, and one with less than that as an outline, pixels.
constexpr double kSmallestBody = 2.0, kSmallestDetail = 9.0;

}  // namespace

Eigen::AlignedBox3d extent(const Look& look, const Pose& pose) {
  Eigen::AlignedBox3d box;
  const auto include = [&](const Vector3& p_B) { box.extend(Vector3(pose.p_WB + pose.R_WB * p_B)); };
  for (const Face& face : look.faces)
    for (const Vector3& corner : face.corners) include(corner);
  for (const Vector3& point : look.points) include(point);
  box.extend(Vector3(pose.p_WB.array() - look.ball_radius));
  box.extend(Vector3(pose.p_WB.array() + look.ball_radius));
  return box;
}

void SpacePanel::add_path(std::vector<Vector3> points, const std::string& style, const std::string& title) {
  for (const Vector3& point : points)
    if (point.allFinite()) motion_.extend(point);
  paths_.push_back({std::move(points), style, title});
}

void SpacePanel::add_shadowed_path(std::vector<Vector3> points, const std::string& style, const std::string& title) {
  shadows_.push_back({points, "lines lw 1.2 lc '#b4b4b4'", ""});
  add_path(std::move(points), style, title);
}

void SpacePanel::add_body(const Look& look, const Pose& pose, Color color) {
  if (look.is_empty() || !pose.p_WB.allFinite() || !pose.R_WB.allFinite()) return;
  motion_.extend(extent(look, pose));
  has_turning_solid_ = has_turning_solid_ || look.turns;
  bodies_.push_back({look, pose, color});
}

Eigen::AlignedBox3d SpacePanel::axes_box() const {
  const Eigen::AlignedBox3d box = with_obstacles(shown_.value_or(motion_), obstacles_);
  Eigen::AlignedBox3d padded = box;
  for (int i = 0; i < 3; ++i) {
    const Range range = Range{box.min()[i], box.max()[i]}.padded();
    padded.min()[i] = range.low;
    padded.max()[i] = range.high;
  }
  // the ground is the floor of the picture
  const int up = axes_.up();
  for (const World::Obstacle& obstacle : obstacles_)
    if (const auto* plane = std::get_if<Plane>(&obstacle.shape);
        plane != nullptr && (axes_.turn() * plane->normal).head<2>().norm() < 1e-12 &&
        plane->point[up] <= box.min()[up])
      padded.min()[up] = std::max(padded.min()[up], plane->point[up]);
  return padded;
}

bool SpacePanel::has_one_scale(const Eigen::AlignedBox3d& box) const {
  return has_turning_solid_ || box.sizes().maxCoeff() <= kLongestBox * box.sizes().minCoeff();
}

double SpacePanel::aspect() const {
  const Eigen::AlignedBox3d box = axes_box();
  return detail::aspect(box, has_one_scale(box), axes_);
}

std::string SpacePanel::script(const Frame& frame, const FigureSize& size) const {
  const Vector2 panel((frame.right - frame.left) * size.width, (frame.top - frame.bottom) * size.height);
  const Eigen::AlignedBox3d box = axes_box();
  const View view = fit(box, has_one_scale(box), axes_, panel);
  const SpaceAxes axes = space_axes(box, view);

  std::string script =
      place(frame) + fmt::format("set xrange [0:{:.1f}]\nset yrange [0:{:.1f}]\n", panel.x(), panel.y());
  script += "unset border\nunset tics\nunset grid\nunset xlabel\nunset ylabel\n" + axes.labels;
  std::string plot;
  const auto add = [&](const PlotElements& each) {
    script += each.data;
    if (!each.elements.empty()) plot += (plot.empty() ? "" : ", ") + each.elements;
  };
  const auto shifted = [&](Drawing drawing) { return moved(std::move(drawing), view.offset); };
  const auto add_lines = [&](const char* name, const std::vector<std::vector<Vector2>>& lines, Color color,
                             double width) {
    add(plot_elements(Drawing{{}, lines, color, width}, name));
  };
  add_lines("walls", axes.walls, 0xe2e2e2, 0.8);

  std::vector<Drawing> drawings;
  for (const World::Obstacle& obstacle : obstacles_) {
    const auto* ball = std::get_if<Sphere>(&obstacle.shape);
    const bool is_hollow = std::holds_alternative<Cavity>(obstacle.shape);
    Drawing drawing =
        ball != nullptr
            ? draw_body({.ball_radius = ball->radius, .turns = true}, {0.0, ball->center, Matrix3::Identity()},
                        view.camera, obstacle_color(obstacle))
            : draw_faces(obstacle_faces(obstacle.shape, box), view.camera, obstacle_color(obstacle), is_hollow);
    drawing.opacity = kObstacleOpacity;
    if (std::holds_alternative<Plane>(obstacle.shape))
      add(plot_elements(shifted(std::move(drawing)), fmt::format("plane{}", plot.size())));
    else
      drawings.push_back(shifted(std::move(drawing)));
  }
  add_lines("floor", axes.floor, 0xc8c8c8, 0.8);
  const auto within = [this](const std::vector<Vector3>& points, const Eigen::AlignedBox3d& limits) {
    return shown_ ? clipped(points, limits) : std::vector<std::vector<Vector3>>{points};
  };
  const auto add_paths = [&](const std::vector<Path>& paths, const std::string& name, bool on_floor) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      std::vector<std::vector<double>> rows;
      for (const std::vector<Vector3>& part : within(paths[i].points, box)) {
        if (!rows.empty()) rows.emplace_back();
        for (Vector3 point : part) {
          if (on_floor) point[axes_.up()] = box.min()[axes_.up()];
          const Vector2 at = view.pixels(point);
          rows.push_back({at.x(), at.y()});
        }
      }
      if (rows.empty()) rows.push_back({std::nan(""), std::nan("")});  // its title is still in the legend
      const std::string block = fmt::format("{}{}", name, i);
      const std::string& title = paths[i].title;
      add({data_block(block, rows),
           fmt::format("${} with {} {}", block, paths[i].style, title.empty() ? "notitle" : "title " + quoted(title))});
    }
  };
  add_paths(shadows_, "shadow", true);

  const double pixels_per_metre = view.camera.matrix().row(1).norm();
  for (const Body& body : bodies_) {
    const double radius = body.look.radius() * pixels_per_metre;
    const bool is_shown = !shown_ || box.contains(extent(body.look, body.pose));
    if (is_shown && radius >= kSmallestBody)
      drawings.push_back(shifted(draw_body(body.look, body.pose, view.camera, body.color, radius < kSmallestDetail)));
  }
  ranges::stable_sort(drawings, {}, &Drawing::nearness);
  for (std::size_t i = 0; i < drawings.size(); ++i) add(plot_elements(drawings[i], fmt::format("solid{}_", i)));
  add_lines("axes", axes.axes, 0x404040, 1.2);
  add_paths(paths_, "path", false);

  script += "plot " + plot + "\n" + axes.end_labels;
  return script + "set border 31 lw 1.2 lc '#404040'\nset tics\nset grid lc '#d8d8d8' lt 1 lw 0.8\n";
}

}  // namespace trajet::detail
