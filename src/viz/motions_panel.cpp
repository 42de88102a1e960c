#include "motions_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "space_panel.hpp"

namespace trajet::detail {

namespace {

constexpr std::size_t kMostMotions = 6;

Vector3 position(const std::vector<double>& state, int first) { return Vector3::Map(state.data() + first); }

}  // namespace

MotionsPanel::MotionsPanel(const Comparison& comparison, const World& world, const std::vector<RowMotion>& motions,
                           const std::optional<ShownComponent>& component, const std::vector<RowStyle>& styles)
    : comparison_(comparison), world_(world), motions_(motions), component_(component), styles_(styles) {
  choose_rows();
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
  std::ranges::stable_sort(rows, [this](std::size_t a, std::size_t b) { return error(a) > error(b); });
  for (const std::size_t row : rows)
    if (rows_.size() < kMostMotions && std::ranges::none_of(rows_, [&](std::size_t other) {
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
  std::array<bool, 3> moves{};
  for (std::size_t b = 0; b < world_.bodies.size(); ++b) {
    const World::Body& body = world_.bodies[b];
    owners_.push_back({body.group, body.offset, b});
    for (int i = 0; i < 3; ++i) {
      Range range;
      for (const auto& state : reference_states(body.group).values)
        range.include(position(state, body.slice().position_index())[i]);
      moves[static_cast<std::size_t>(i)] |= range.extent() > 0.0;
    }
  }
  for (int i = 0; i < 3; ++i)
    if (moves[static_cast<std::size_t>(i)]) {
      components_.push_back(i);
      labels_.push_back(std::string(1, "xyz"[i]) + " [m]");
    }
  if (components_.empty()) {
    components_ = {0};
    labels_ = {"x [m]"};
  }
}

const RowStyle& MotionsPanel::style(const ComparisonRow& row) const {
  return *std::ranges::find_if(styles_, [&](const RowStyle& style) { return style.is_of(row); });
}

std::string MotionsPanel::title(const ComparisonRow& row) const {
  if (row.rtol) return fmt::format("{}, rtol {:g}", style(row).name, *row.rtol);
  return fmt::format("{}, {} steps", style(row).name, row.statistics.steps);
}

double MotionsPanel::reference_end() const {
  double until = comparison_.start_time;
  for (const ComparisonRow& row : comparison_.rows)
    if (std::abs(row.compared_until - comparison_.start_time) > std::abs(until - comparison_.start_time))
      until = row.compared_until;
  return until;
}

/// On a grid as fine as the picture.
MotionsPanel::States MotionsPanel::reference_states(int group) const {
  constexpr int kPoints = 400;
  const double until = reference_end();
  States states;
  Eigen::VectorXd q;
  for (int k = 0; k <= kPoints; ++k) {
    states.times.push_back(comparison_.start_time + (until - comparison_.start_time) * k / kPoints);
    comparison_.reference->state(group, states.times.back(), q);
    states.values.emplace_back(q.begin(), q.end());
  }
  return states;
}

std::vector<Pose> MotionsPanel::reference_poses(const World::Body& body) const {
  std::vector<Pose> poses;
  Eigen::VectorXd q;
  for (const double t : pose_times(comparison_.start_time, reference_end())) {
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

std::string MotionsPanel::space_script(const Frame& frame, const FigureSize& size) const {
  SpacePanel panel;
  for (std::size_t b = 0; b < world_.bodies.size(); ++b) {
    const World::Body& body = world_.bodies[b];
    const Look shown = look(body);
    const bool is_solid = std::ranges::find(solids_, b) != solids_.end();
    std::vector<Vector3> points;
    for (const auto& state : reference_states(body.group).values)
      points.push_back(position(state, body.slice().position_index()));
    // the reference lies beneath
    panel.add_path(std::move(points), fmt::format("lines lw 4 lc '{}'", color_text(kReferenceColor)),
                   b == 0 ? comparison_.reference_name : "");
    if (is_solid)
      for (const Pose& pose : reference_poses(body)) panel.add_body(shown, pose, kReferenceColor);
    for (const std::size_t r : rows_) {
      const Curve& curve = motions_[r].curves[static_cast<std::size_t>(body.group)];
      std::vector<Vector3> way;
      for (const auto& state : curve.states) way.push_back(position(state, body.slice().position_index()));
      panel.add_path(std::move(way), line_style(r), b == 0 ? title(comparison_.rows[r]) : "");
      if (is_solid)
        for (const Pose& pose : motions_[r].poses[b]) panel.add_body(shown, pose, style(comparison_.rows[r]).color);
    }
  }
  panel.add_obstacles(world_.obstacles);
  return panel.script(frame, size);
}

std::string MotionsPanel::plot_script(const Frame& frame) const {
  std::string data, plot;
  std::array<Range, 2> ranges;
  const auto add = [&](const std::string& name, const States& states, int offset, const std::string& style,
                       const std::string& title) {
    std::vector<std::vector<double>> rows;
    for (std::size_t p = 0; p < states.times.size(); ++p) {
      rows.emplace_back();
      if (components_.size() == 1) rows.back().push_back(states.times[p]);
      for (const int i : components_) rows.back().push_back(states.values[p][static_cast<std::size_t>(offset + i)]);
      for (std::size_t k = 0; k < ranges.size(); ++k) ranges[k].include(rows.back()[k]);
    }
    data += data_block(name, rows);
    plot += fmt::format("{}${} with {} {}", plot.empty() ? "" : ", ", name, style,
                        title.empty() ? "notitle" : "title " + quoted(title));
  };
  for (std::size_t o = 0; o < owners_.size(); ++o)
    add(fmt::format("reference{}", o), reference_states(owners_[o].group), owners_[o].offset,
        fmt::format("lines lw 4 lc '{}'", color_text(kReferenceColor)), o == 0 ? comparison_.reference_name : "");
  for (const std::size_t r : rows_)
    for (std::size_t o = 0; o < owners_.size(); ++o) {
      const Curve& curve = motions_[r].curves[static_cast<std::size_t>(owners_[o].group)];
      add(fmt::format("row{}_{}", r, o), {curve.times, curve.states}, owners_[o].offset, line_style(r),
          o == 0 ? title(comparison_.rows[r]) : "");
    }
  std::vector<std::string> labels = labels_;
  if (labels.size() == 1) labels.insert(labels.begin(), "time [s]");
  std::string script = data + place(frame);
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const char* name = k == 0 ? "x" : "y";
    script += axis(name, ranges[k].padded(), 5) + fmt::format("set {}label {}\n", name, quoted(labels[k]));
  }
  return script + "plot " + plot + "\n";
}

PoseStrip MotionsPanel::strip() const {
  PoseStrip strip;
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
