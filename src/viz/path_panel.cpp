#include "path_panel.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "driven_outlines.hpp"
#include "obstacle_faces.hpp"

#include "trajet/portable.hpp"

namespace trajet::detail {

namespace {

constexpr Color kStartColor = 0x0050c8, kEndColor = 0xd01010;  // the notes draw a vector in blue and, turned, in red
constexpr std::size_t kMostLegendEntries = 12;
/// A way that is longer than so many times its extent is a tangle.
constexpr double kLongestWay = 16.0;
constexpr std::size_t kMostTrails = 4;
/// What moves by less than this, against where it is, does not move.
constexpr double kRounding = 1e-12;

std::string line_style(Color color) { return fmt::format("lines lw 2.4 lc '{}'", color_text(line_color(color))); }
constexpr const char* kOutlineStyle = "lines lw 0.8 lc '#a8a8a8'";
constexpr const char* kImpactStyle = "points pt 6 ps 1.2 lw 2 lc '#202020'";

bool is_clear(const std::vector<Vector3>& way) {
  Eigen::AlignedBox3d box;
  double length = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    box.extend(way[i]);
    if (i > 0) length += (way[i] - way[i - 1]).norm();
  }
  return length > 0.0 && length <= kLongestWay * box.sizes().norm();
}

}  // namespace

Color body_color(const World& world, std::size_t body) {
  constexpr Color kColors[] = {0x0050c8, 0xe07b00, 0x007a6c, 0xa03a90, 0x6b6b6b, 0x8c5a2b};
  return color_or(world.bodies[body].color, kColors[body % std::size(kColors)]);
}

PathPanel::PathPanel(const RunResult& result, const MotionRecord& record, const std::vector<Curve>& curves)
    : result_(result), record_(record), world_(record.world()), curves_(curves) {
  const Eigen::AlignedBox3d box = motion_box();
  for (int i = 0; i < 3 && !box.isEmpty(); ++i)
    if (box.sizes()[i] > kRounding * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()))
      kept_.push_back(i);
  if (world_.up == UpAxis::y && kept_ == std::vector{1, 2}) kept_ = {2, 1};  // y upward
  is_in_space_ = kept_.size() == 3 ||
                 ranges::any_of(world_.bodies, [&](const World::Body& body) { return is_turning_solid(body); });
}

Eigen::AlignedBox3d PathPanel::motion_box() const {
  Eigen::AlignedBox3d box;
  for (const World::Body& body : world_.bodies)
    for (const Vector3& point : path(body)) box.extend(point);
  return box;
}

std::vector<Vector3> PathPanel::path(const World::Body& body) const {
  const std::vector<std::vector<double>>& states = curve(body).states;
  if (states.empty()) return {make_poses(record_, body).front().p_WB};
  std::vector<Vector3> points;
  for (const std::vector<double>& state : states)
    points.push_back(Vector3::Map(state.data() + body.slice().position_index()));
  return points;
}

std::vector<Vector3> PathPanel::way_of(const World::Body& body, const World::Point& point) const {
  if (curve(body).times.empty()) return {};
  constexpr int kParts = 600;
  const double start = curve(body).times.front(), duration = curve(body).times.back() - start;
  std::vector<double> times;
  for (int k = 0; k <= kParts; ++k) times.push_back(start + duration * k / kParts);
  std::vector<Vector3> way;
  for (const Pose& at : poses_at(record_, body, times)) way.push_back(at.p_WB + at.R_WB * point.p_B);
  return way;
}

Vector3 PathPanel::angular_velocity(const World::Body& body) const {
  const OrientationLayout& layout = body.rotation->layout;
  const Eigen::VectorXd& start = world_.groups[static_cast<std::size_t>(body.group)].start;
  const double* part =
      (curve(body).states.empty() ? start.data() : curve(body).states.back().data()) + body.rotation->offset;
  const Vector3 w = Vector3::Map(part + layout.size());
  return layout.frame == trajet::Frame::world ? w : Vector3(layout.rotation(part) * w);
}

bool PathPanel::is_turning_solid(const World::Body& body) const { return body.rotation && !look(body).is_empty(); }

bool PathPanel::stays(const World::Body& body) const {
  const std::vector<Vector3> points = path(body);
  const double rounding = kRounding * (points.front().norm() + look(body).radius());
  return ranges::all_of(points, [&](const Vector3& point) { return (point - points.front()).norm() <= rounding; });
}

double PathPanel::aspect() const { return is_in_space_ ? space_panel().aspect() : 1.0; }

std::string PathPanel::script(const Frame& frame, const FigureSize& size) const {
  const std::string legend = fmt::format("set key at screen {:.4f}, {:.4f} right bottom Left reverse horizontal\n",
                                         frame.right, frame.top + 4.0 / size.height);
  return legend + (is_in_space_ ? space_panel().script(frame, size) : plane_script(frame));
}

SpacePanel PathPanel::space_panel() const {
  SpacePanel panel(world_.up);
  std::size_t trails = 0;
  for (std::size_t b = 0; b < world_.bodies.size(); ++b) {
    const World::Body& body = world_.bodies[b];
    const Color color = body_color(world_, b);
    const Look shown = look(body);
    const bool is_fixed = is_turning_solid(body) && stays(body);
    const std::vector<Pose> poses = make_poses(record_, body);
    if (is_fixed) {
      if (!shown.points.empty() && poses.size() > 1) panel.add_body(shown, poses.front(), kStartColor);
      panel.add_body(shown, poses.back(), shown.points.empty() ? color : poses.size() > 1 ? kEndColor : kStartColor);
    } else {
      for (const Pose& pose : poses) panel.add_body(shown, pose, color);
      panel.add_shadowed_path(path(body), line_style(color), b < kMostLegendEntries ? body.name : "");
    }
    if (!body.rotation) continue;
    for (const World::Point& point : body.points) {
      std::vector<Vector3> way = way_of(body, point);
      if (trails >= kMostTrails || !is_clear(way)) continue;
      constexpr Color kTrailColors[] = {0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9};
      panel.add_path(std::move(way), fmt::format("lines lw 1.8 lc '{}' dt (10,4)", color_text(kTrailColors[trails++])),
                     (world_.bodies.size() > 1 ? body.name + "." : "") + point.name);
    }
    const Vector3 w = angular_velocity(body);
    if (is_fixed && w.norm() > 0.0) {
      const Vector3 center = path(body).back(), reach = 1.1 * shown.radius() * w.normalized();
      panel.add_path({shown.points.empty() ? Vector3(center - reach) : center, center + reach},
                     "lines lw 2 lc '#000000'", "axis of rotation");
    }
  }
  if (!result_.impacts.empty()) {
    std::vector<Vector3> points;
    for (const Impact& impact : result_.impacts) points.push_back(impact.position);
    panel.add_path(std::move(points), kImpactStyle, "impact");
  }
  for (std::vector<Vector3>& outline : driven_outlines(world_, result_.elapsed, Vector3::UnitZ(), motion_box()))
    panel.add_path(std::move(outline), kOutlineStyle, "");
  panel.add_obstacles(world_.obstacles);
  return panel;
}

std::string PathPanel::plane_script(const Frame& frame) const {
  const int across = 3 - kept_[0] - kept_[1];
  Eigen::AlignedBox3d motion = motion_box();
  std::string data, lines;
  const auto add = [&](const std::string& name, const std::vector<Vector3>& points, const std::string& style) {
    std::vector<std::vector<double>> rows;
    for (const Vector3& point : points) rows.push_back({point[kept_[0]], point[kept_[1]]});
    data += data_block(name, rows);
    lines += fmt::format("{}${} with {}", lines.empty() ? "" : ", ", name, style);
  };
  const auto outlines = driven_outlines(world_, result_.elapsed, Vector3::Unit(across), motion);
  for (const std::vector<Vector3>& outline : outlines)
    for (const Vector3& corner : outline) motion.extend(corner);
  const Eigen::AlignedBox3d shown = with_obstacles(motion, world_.obstacles);
  Eigen::AlignedBox3d box = shown;
  std::array<Range, 2> ranges;
  for (std::size_t k = 0; k < 2; ++k) {
    ranges[k] = Range{shown.min()[kept_[k]], shown.max()[kept_[k]]}.padded();
    box.min()[kept_[k]] = ranges[k].low;
    box.max()[kept_[k]] = ranges[k].high;
  }
  for (std::size_t o = 0; o < world_.obstacles.size(); ++o) {
    const Shape& shape = world_.obstacles[o].shape;
    std::vector<Face> faces = obstacle_faces(shape, box);
    if (const auto* ball = std::get_if<Sphere>(&shape))
      faces = {face(make_disk(ball->center, Vector3::Unit(across), ball->radius), 48)};
    for (std::size_t f = 0; f < faces.size(); ++f) {
      std::vector<Vector3> corners = faces[f].corners;
      corners.push_back(corners.front());
      add(fmt::format("obstacle{}_{}", o, f), corners,
          fmt::format("lines lw 3 lc '{}' notitle", color_text(line_color(obstacle_color(world_.obstacles[o])))));
    }
  }
  for (std::size_t i = 0; i < outlines.size(); ++i)
    add(fmt::format("outline{}", i), outlines[i], std::string(kOutlineStyle) + " notitle");
  for (std::size_t b = 0; b < world_.bodies.size(); ++b)
    add(fmt::format("path{}", b), path(world_.bodies[b]),
        line_style(body_color(world_, b)) +
            (b < kMostLegendEntries ? " title " + quoted(world_.bodies[b].name) : std::string(" notitle")));
  if (!result_.impacts.empty()) {
    std::vector<Vector3> points;
    for (const Impact& impact : result_.impacts) points.push_back(impact.position);
    add("impacts", points, std::string(kImpactStyle) + " title 'impact'");
  }
  std::string script = data + place(frame);
  for (std::size_t k = 0; k < 2; ++k)
    script += axis(k == 0 ? "x" : "y", ranges[k], 5) +
              fmt::format("set {}label '{} [m]'\n", k == 0 ? "x" : "y", "xyz"[kept_[k]]);
  return script + "plot " + lines + "\n";
}

}  // namespace trajet::detail
