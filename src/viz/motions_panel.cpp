#include "motions_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>

#include "shown_range.hpp"
#include "space_panel.hpp"

#include "trajet/portable.hpp"

namespace trajet::detail {

namespace {

constexpr std::size_t kMostMotions = 6;
constexpr int kReferencePoints = 400;
/// An axis of the picture in space shows at least this part of the longest one.
constexpr double kLeastExtent = 1.0 / 16.0;

Vector3 position(const std::vector<double>& state, int first) { return Vector3::Map(state.data() + first); }

Ranges ranges_of(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return Ranges(3);
  Ranges ranges;
  for (int axis = 0; axis < 3; ++axis) ranges.push_back({box.min()[axis], box.max()[axis]});
  return ranges;
}

}  // namespace

MotionsPanel::MotionsPanel(const Comparison& comparison, const World& world, const std::vector<RowMotion>& motions,
                           const std::optional<ShownComponent>& component, const std::vector<RowStyle>& styles)
    : comparison_(comparison), world_(world), motions_(motions), component_(component), styles_(styles) {
  choose_rows();
  reference_end_ = find_reference_end();
  for (std::size_t b = 0; b < world.bodies.size(); ++b)
    if (world.bodies[b].rotation && !look(world.bodies[b]).is_empty()) solids_.push_back(b);
  choose_components();
  is_in_space_ = !component_ && (components_.size() == 3 || !solids_.empty());
}

double MotionsPanel::error(std::size_t row) const { return comparison_.rows[row].at_samples.state.value_or(0.0); }

/// All rows if there are few; else of each style the one with the largest error, of the styles with the largest ones.
void MotionsPanel::choose_rows() {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < comparison_.rows.size(); ++i)
    if (comparison_.rows[i].succeeded()) rows.push_back(i);
  if (rows.size() <= kMostMotions) {
    rows_ = std::move(rows);
    return;
  }
  ranges::stable_sort(rows, [this](std::size_t a, std::size_t b) { return error(a) > error(b); });
  for (const std::size_t row : rows)
    if (rows_.size() < kMostMotions && ranges::none_of(rows_, [&](std::size_t other) {
          return &style(comparison_.rows[other]) == &style(comparison_.rows[row]);
        }))
      rows_.push_back(row);
}

void MotionsPanel::choose_components() {
  if (component_) {
    owners_.push_back({component_->group, 0, {}});
    components_.push_back(component_->index);
    labels_.push_back(component_->label);
    return;
  }
  if (world_.bodies.empty()) {
    owners_.push_back({world_.states.front().group, 0, {}});
    for (std::size_t s = 0; s < world_.states.size() && s < 2; ++s)
      if (world_.states[s].group == world_.states.front().group) {
        components_.push_back(world_.states[s].offset);
        labels_.push_back(world_.states[s].name);
      }
    return;
  }
  std::array<Range, 3> ranges;
  double size = 0.0;
  for (std::size_t b = 0; b < world_.bodies.size(); ++b) {
    const World::Body& body = world_.bodies[b];
    owners_.push_back({body.group, body.slice().position_index(), b});
    for (const auto& state : reference_states(body.group).values)
      for (int i = 0; i < 3; ++i) {
        const double coordinate = position(state, body.slice().position_index())[i];
        ranges[static_cast<std::size_t>(i)].include(coordinate);
        if (std::isfinite(coordinate)) size = std::max(size, std::abs(coordinate));
      }
  }
  constexpr double kRounding = 1e-12;
  for (int i = 0; i < 3; ++i)
    if (ranges[static_cast<std::size_t>(i)].extent() > kRounding * size) {
      components_.push_back(i);
      labels_.push_back(std::string(1, "xyz"[i]) + " [m]");
    }
  if (components_.empty()) {
    components_ = {0};
    labels_ = {"x [m]"};
  }
}

const RowStyle& MotionsPanel::style(const ComparisonRow& row) const {
  return *ranges::find_if(styles_, [&](const RowStyle& style) { return style.is_of(row); });
}

std::string MotionsPanel::title(const ComparisonRow& row) const {
  if (row.rtol) return fmt::format("{}, rtol {:g}", style(row).name, *row.rtol);
  if (!row.succeeded()) return row.step ? fmt::format("{}, step {:g} s", style(row).name, *row.step) : style(row).name;
  // into how many the whole time is divided: the run may have ended before
  const double duration = std::abs(comparison_.duration);
  const long count = row.step ? std::lround(duration / *row.step) : row.statistics.steps;
  return fmt::format("{}, {} {}", style(row).name, count, count == 1 ? "step" : "steps");
}

std::string MotionsPanel::title(std::size_t row, bool is_cut) const {
  return title(comparison_.rows[row]) + (is_cut ? " (leaves the picture)" : "");
}

double MotionsPanel::find_reference_end() const {
  if (const auto end = comparison_.reference->end_time()) return *end;
  const ComparisonRow* nearest = nullptr;
  const auto error_of = [](const ComparisonRow& row) {
    return row.at_samples.state.value_or(std::numeric_limits<double>::infinity());
  };
  for (const ComparisonRow& row : comparison_.rows)
    if (row.succeeded() && (nearest == nullptr || error_of(row) < error_of(*nearest))) nearest = &row;
  return closed_form_end(nearest == nullptr ? 0.0 : nearest->compared_until);
}

double MotionsPanel::closed_form_end(double until) const {
  Eigen::VectorXd q;
  const auto is_behind_a_plane = [&](double t) {
    for (const World::Body& body : world_.bodies) {
      comparison_.reference->state(body.group, t, q);
      const Vector3 position = body.slice().position(q);
      for (const World::Obstacle& obstacle : world_.obstacles)
        if (const auto* plane = std::get_if<Plane>(&obstacle.shape);
            plane != nullptr && obstacle.surface.on_hit != OnHit::pass &&
            plane->normal.dot(position - plane->point) < (is_round(body.solid) ? bounding_radius(body.solid) : 0.0))
          return true;
    }
    return false;
  };
  if (is_behind_a_plane(0.0)) return until;
  double front = 0.0;
  for (int k = 1; k <= kReferencePoints; ++k) {
    double behind = until * k / kReferencePoints;
    if (is_behind_a_plane(behind)) {
      constexpr int kHalvings = 30;
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = front + 0.5 * (behind - front);
        (is_behind_a_plane(middle) ? behind : front) = middle;
      }
      return front;
    }
    front = behind;
  }
  return until;
}

double MotionsPanel::reference_size() const {
  double size = 0.0;
  for (std::size_t g = 0; g < world_.groups.size(); ++g)
    for (const auto& state : reference_states(static_cast<int>(g)).values)
      for (const double value : state)
        if (std::isfinite(value)) size = std::max(size, std::abs(value));
  return size;
}

/// On a grid as fine as the picture.
MotionsPanel::States MotionsPanel::reference_states(int group) const {
  States states;
  Eigen::VectorXd q;
  for (int k = 0; k <= kReferencePoints; ++k) {
    states.times.push_back(reference_end_ * k / kReferencePoints);
    comparison_.reference->state(group, states.times.back(), q);
    states.values.emplace_back(q.begin(), q.end());
  }
  return states;
}

std::vector<Pose> MotionsPanel::reference_poses(const World::Body& body) const {
  std::vector<Pose> poses;
  Eigen::VectorXd q;
  for (const double t : pose_times(0.0, reference_end_)) {
    comparison_.reference->state(body.group, t, q);
    poses.push_back(pose(body, t, q));
    if (!poses.back().p_WB.allFinite() || !poses.back().R_WB.allFinite()) return {};
  }
  return poses;
}

std::string MotionsPanel::line_style(std::size_t row) const {
  constexpr const char* kDashes[] = {"dt 1", "dt (12,5)", "dt (3,4)"};
  const RowStyle& look = style(comparison_.rows[row]);
  std::size_t before = 0;
  for (const std::size_t other : rows_) {
    if (other == row) break;
    if (&style(comparison_.rows[other]) == &look) ++before;
  }
  return fmt::format("lines lw 2 lc '{}' {}", color_text(look.color), kDashes[before % std::size(kDashes)]);
}

std::string MotionsPanel::script(const Frame& frame, const FigureSize& size) const {
  const std::string legend =
      fmt::format("set key at screen {:.4f}, screen {:.4f} left bottom Left reverse vertical maxrows 10 samplen 2\n",
                  frame.left, frame.top + 6.0 / size.height);
  return legend + (is_in_space_ ? space_script(frame, size) : plot_script(frame));
}

Eigen::AlignedBox3d MotionsPanel::reference_extent() const {
  Eigen::AlignedBox3d box;
  for (const World::Body& body : world_.bodies)
    for (const auto& state : reference_states(body.group).values)
      if (const Vector3 point = position(state, body.slice().position_index()); point.allFinite()) box.extend(point);
  for (const std::size_t b : solids_)
    for (const Pose& pose : reference_poses(world_.bodies[b])) box.extend(extent(look(world_.bodies[b]), pose));
  return box;
}

Eigen::AlignedBox3d MotionsPanel::extent_of(const RowMotion& motion) const {
  Eigen::AlignedBox3d box;
  for (const World::Body& body : world_.bodies)
    for (const auto& state : motion.curves[static_cast<std::size_t>(body.group)].states)
      if (const Vector3 point = position(state, body.slice().position_index()); point.allFinite()) box.extend(point);
  for (const std::size_t b : solids_)
    for (const Pose& pose : motion.poses[b])
      if (pose.p_WB.allFinite() && pose.R_WB.allFinite()) box.extend(extent(look(world_.bodies[b]), pose));
  return box;
}

std::string MotionsPanel::space_script(const Frame& frame, const FigureSize& size) const {
  const Eigen::AlignedBox3d reference = reference_extent();
  std::vector<Ranges> extents;  // of each row that is drawn
  for (const std::size_t r : rows_) extents.push_back(ranges_of(extent_of(motions_[r])));
  const Ranges kept = shown_ranges(ranges_of(reference), extents,
                                   reference.isEmpty() ? 0.0 : kLeastExtent * reference.sizes().maxCoeff());
  SpacePanel panel(world_.up);
  if (ranges::none_of(kept, &Range::is_empty))
    panel.show({Vector3(kept[0].low, kept[1].low, kept[2].low), Vector3(kept[0].high, kept[1].high, kept[2].high)});
  for (std::size_t b = 0; b < world_.bodies.size(); ++b) {
    const World::Body& body = world_.bodies[b];
    const Look shape = look(body);
    const bool is_solid = ranges::find(solids_, b) != solids_.end();
    std::vector<Vector3> points;
    for (const auto& state : reference_states(body.group).values)
      points.push_back(position(state, body.slice().position_index()));
    // the reference lies beneath
    panel.add_path(std::move(points), fmt::format("lines lw 4 lc '{}'", color_text(kReferenceColor)),
                   b == 0 ? comparison_.reference_name : "");
    if (is_solid)
      for (const Pose& pose : reference_poses(body)) panel.add_body(shape, pose, kReferenceColor);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const std::size_t r = rows_[i];
      const Curve& curve = motions_[r].curves[static_cast<std::size_t>(body.group)];
      std::vector<Vector3> way;
      for (const auto& state : curve.states) way.push_back(position(state, body.slice().position_index()));
      panel.add_path(std::move(way), line_style(r), b == 0 ? title(r, leaves(extents[i], kept)) : "");
      if (is_solid)
        for (const Pose& pose : motions_[r].poses[b]) panel.add_body(shape, pose, style(comparison_.rows[r]).color);
    }
  }
  panel.add_obstacles(world_.obstacles);
  return panel.script(frame, size);
}

std::string MotionsPanel::plot_script(const Frame& frame) const {
  std::string data;
  const auto add = [&](const std::string& name, const States& states, int offset, Ranges& ranges) {
    std::vector<std::vector<double>> rows;
    for (std::size_t p = 0; p < states.times.size(); ++p) {
      rows.emplace_back();
      if (components_.size() == 1) rows.back().push_back(clock().time(states.times[p]));
      for (const int i : components_) rows.back().push_back(states.values[p][static_cast<std::size_t>(offset + i)]);
      for (std::size_t k = 0; k < ranges.size(); ++k) ranges[k].include(rows.back()[k]);
    }
    data += data_block(name, rows);
  };
  Ranges reference(2);
  std::vector<Ranges> ranges(rows_.size(), Ranges(2));
  for (std::size_t o = 0; o < owners_.size(); ++o)
    add(fmt::format("reference{}", o), reference_states(owners_[o].group), owners_[o].offset, reference);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (std::size_t o = 0; o < owners_.size(); ++o) {
      const Curve& curve = motions_[rows_[i]].curves[static_cast<std::size_t>(owners_[o].group)];
      add(fmt::format("row{}_{}", i, o), {curve.times, curve.states}, owners_[o].offset, ranges[i]);
    }

  std::string script = data + place(frame);
  const bool is_position = owners_.front().body && components_.size() > 1;
  const Ranges shown = shown_ranges(
      reference, ranges, is_position ? kLeastExtent * std::max(reference[0].extent(), reference[1].extent()) : 0.0);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const char* name = k == 0 ? "x" : "y";
    const std::string label = labels_.size() == 1 ? (k == 0 ? clock().label() : labels_[0]) : labels_[k];
    script += axis(name, shown[k].padded(), 5) + fmt::format("set {}label {}\n", name, quoted(label));
  }
  std::string plot;
  const auto draw = [&](const std::string& name, const std::string& style, const std::string& title) {
    plot += fmt::format("{}${} with {} {}", plot.empty() ? "" : ", ", name, style,
                        title.empty() ? "notitle" : "title " + quoted(title));
  };
  for (std::size_t o = 0; o < owners_.size(); ++o)
    draw(fmt::format("reference{}", o), fmt::format("lines lw 4 lc '{}'", color_text(kReferenceColor)),
         o == 0 ? comparison_.reference_name : "");
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (std::size_t o = 0; o < owners_.size(); ++o)
      draw(fmt::format("row{}_{}", i, o), line_style(rows_[i]),
           o == 0 ? title(rows_[i], leaves(ranges[i], shown)) : "");
  return script + "plot " + plot + "\n";
}

PoseStrip MotionsPanel::strip() const {
  PoseStrip strip(clock(), world_.up);
  for (const std::size_t b : solids_) {
    const World::Body& body = world_.bodies[b];
    const std::string of = solids_.size() > 1 ? body.name + ": " : "";
    const std::vector<Pose> known = reference_poses(body);
    if (!known.empty()) strip.add_row(of + comparison_.reference_name, look(body), known, kReferenceColor);
    for (const std::size_t r : rows_)
      if (!motions_[r].poses[b].empty())
        strip.add_row(of + title(comparison_.rows[r]), look(body), motions_[r].poses[b],
                      style(comparison_.rows[r]).color);
  }
  return strip;
}

}  // namespace trajet::detail
