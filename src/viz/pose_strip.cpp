#include "pose_strip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "trajet/portable.hpp"

namespace trajet::detail {

namespace {

/// Room for a row's title above it and the times below it, pixels.
constexpr double kTitle = 20.0, kTimes = 22.0;
/// Of rows below one another every second pose will do, if there are more than this.
constexpr std::size_t kMostColumns = 7;
/// What has grown to more than so many times its size at first is told, not drawn: it would make the others too small.
constexpr double kMostGrowth = 5.0;
/// A picture's part of its cell.
constexpr double kFill = 0.94;

Vector2 reach(const Drawing& drawing) {
  Vector2 largest(1e-300, 1e-300);
  for (const auto& line : drawing.lines)
    for (const Vector2& point : line) largest = largest.cwiseMax(point.cwiseAbs());
  return largest;
}

/// How many times as large a body is as it is made; of a rotation 1.
double growth(const Pose& pose) { return pose.R_WB.colwise().norm().maxCoeff(); }

/// Every second one, counted from the last; the first too.
std::vector<Pose> every_second(const std::vector<Pose>& poses) {
  std::vector<Pose> result;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (i == 0 || (poses.size() - 1 - i) % 2 == 0) result.push_back(poses[i]);
  return result;
}

bool have_one_time(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  return ranges::equal(a, b, {}, &Pose::time, &Pose::time);
}

}  // namespace

void PoseStrip::add_row(const std::string& title, const Look& look, const std::vector<Pose>& poses, Color color) {
  rows_.push_back({title, look, poses, color});
  for (Pose& pose : rows_.back().poses) pose.p_WB.setZero();
}

std::string PoseStrip::script(const Frame& frame, const FigureSize& size) const {
  std::vector<Row> rows = rows_;
  if (rows.size() > 1)
    for (Row& row : rows)
      if (row.poses.size() > kMostColumns) row.poses = every_second(row.poses);
  const Vector2 panel((frame.right - frame.left) * size.width, (frame.top - frame.bottom) * size.height);
  std::size_t columns = 1;
  Vector2 largest = Vector2::Zero();
  for (const Row& row : rows) {
    columns = std::max(columns, row.poses.size());
    for (const Pose& pose : row.poses)
      if (growth(pose) <= kMostGrowth)
        largest = largest.cwiseMax(reach(draw_body(row.look, pose, Camera(Vector3::Ones(), axes_), row.color)));
  }
  const Vector2 cell(panel.x() / static_cast<double>(columns), panel.y() / static_cast<double>(rows.size()));
  const Vector2 room(cell.x(), cell.y() - kTitle - kTimes);
  const Camera camera(Vector3::Constant(0.5 * kFill * room.cwiseQuotient(largest).minCoeff()), axes_);

  std::string script =
      place(frame) + fmt::format("set xrange [0:{:.1f}]\nset yrange [0:{:.1f}]\n", panel.x(), panel.y());
  script += "unset border\nunset tics\nunset grid\nunset xlabel\nunset ylabel\nunset key\n";
  std::string plot, end_labels;
  int label = 10;
  const auto add_label = [&](const std::string& text, double x, double y, const char* style) {
    script += fmt::format("set label {} {} at first {:.1f},{:.1f} {}\n", label, quoted(text), x, y, style);
    end_labels += fmt::format("unset label {}\n", label++);
  };
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Row& row = rows[r];
    const bool shows_times = r + 1 == rows.size() || !have_one_time(row.poses, rows[r + 1].poses);
    const double bottom = panel.y() - cell.y() * static_cast<double>(r + 1);
    add_label(row.title, 0.0, bottom + cell.y() - 0.4 * kTitle, "left tc '#505050'");
    for (std::size_t p = 0; p < row.poses.size(); ++p) {
      const Vector2 center(cell.x() * (static_cast<double>(p) + 0.5), bottom + kTimes + 0.5 * room.y());
      if (shows_times)
        add_label(short_text(clock_.time(row.poses[p].time)) + " s", center.x(), bottom + 0.4 * kTimes, "center");
      if (!(growth(row.poses[p]) <= kMostGrowth)) {
        const double times = growth(row.poses[p]);
        add_label(std::isfinite(times) ? fmt::format("× {:.2g}", times) : "not finite", center.x(), center.y(),
                  "center tc '#505050'");
        continue;
      }
      const Drawing drawing = moved(draw_body(row.look, row.poses[p], camera, row.color), center);
      const PlotElements elements = plot_elements(drawing, fmt::format("strip{}_{}", r, p));
      script += elements.data;
      if (!elements.elements.empty()) plot += (plot.empty() ? "" : ", ") + elements.elements;
    }
  }
  script += "plot " + plot + "\n" + end_labels;
  return script + "set border 31 lw 1.2 lc '#404040'\nset tics\nset grid lc '#d8d8d8' lt 1 lw 0.8\n";
}

}  // namespace trajet::detail
