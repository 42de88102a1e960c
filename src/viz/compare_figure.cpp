#include "trajet/viz/compare_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "compare_notes.hpp"
#include "motions_panel.hpp"
#include "plot_panel.hpp"
#include "pose_strip.hpp"
#include "rotation_panels.hpp"
#include "row_style.hpp"
#include "trajet/portable.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {

namespace {

using detail::Frame;
using detail::quoted;
using detail::Range;
using detail::RowStyle;

/// Of a figure without solids; theirs is higher by the pictures of them and by what becomes of their rotation.
constexpr FigureSize kSize{1240, 760};
/// Errors below this are rounding, and zero has no logarithm.
constexpr double kSmallestError = 1e-17;
/// Of a line of notes, pixels.
constexpr int kNoteHeight = 20;
constexpr std::size_t kFirstNoteLabel = 100;

class CompareFigure {
 public:
  CompareFigure(const Comparison& comparison, const World& world, const std::vector<RowMotion>& motions,
                const std::optional<ShownComponent>& component)
      : comparison_(comparison),
        styles_(detail::row_styles(comparison)),
        motions_(comparison, world, motions, component, styles_),
        rotations_(comparison, styles_),
        strip_(motions_.strip()) {
    if (component) strip_ = detail::PoseStrip(detail::ShownClock{world.epoch, world.duration});
    if (const double size = motions_.reference_size(); size > 0.0) largest_error_ = detail::kMostError * size;
    notes_ = detail::compare_notes(comparison, styles_, largest_error_,
                                   [this](const ComparisonRow& row) { return motions_.title(row); });
    size_.height += notes_height() + strip_.height() + rotations_.height();
  }

  Figure build() {
    script_ = fmt::format(
        "set multiplot\nset label 1 {} at screen 0.5, screen {:.4f} center font ',21'\n"
        "set label 2 {} at screen 0.5, screen {:.4f} center tc '#505050'\n"
        "set border lw 1.2 lc '#404040'\nset grid lc '#d8d8d8' lt 1 lw 0.8\n",
        quoted(title()), 1.0 - 24.0 / size_.height, quoted(subtitle()), 1.0 - 49.0 / size_.height);
    for (std::size_t i = 0; i < notes_.size(); ++i)
      script_ += fmt::format("set label {} {} at screen {:.4f}, screen {:.4f} left tc '#505050'\n", kFirstNoteLabel + i,
                             quoted(notes_[i]), 24.0 / size_.width,
                             (notes_height() - kNoteHeight * (static_cast<double>(i) + 0.5)) / size_.height);
    constexpr double kLegendLine = 25.0 / kSize.height;
    const double motions_top = 0.895 - kLegendLine * static_cast<double>(motions_.legend_lines());
    script_ += motions_.script(upper({0.08, 0.485, 0.11, motions_top}), size_);
    for (std::size_t i = 0; i < notes_.size(); ++i) script_ += fmt::format("unset label {}\n", kFirstNoteLabel + i);
    script_ += "unset label 1\nunset label 2\nset logscale xy\nset termoption enhanced\n";
    const double work_right = 0.985 - legend_width();
    add_work(upper({0.6, work_right, 0.56, 0.86}), "law evaluations", true);
    add_work(upper({0.6, work_right, 0.11, 0.42}), "time [ms]", false);
    add_legend(upper({work_right + 0.01, 0.99, 0.11, 0.86}));
    if (!strip_.is_empty()) {
      script_ += "set termoption noenhanced\n";
      script_ += strip_.script({24.0 / size_.width, 1.0 - 24.0 / size_.width, (notes_height() + 8.0) / size_.height,
                                (notes_height() + strip_.height() - 4.0) / size_.height},
                               size_);
    }
    if (!rotations_.is_empty()) script_ += rotations_.script(notes_height() + strip_.height(), size_);
    script_ += "unset multiplot\n";
    return {std::move(script_), size_, title()};
  }

 private:
  std::string title() const { return comparison_.title.empty() ? comparison_.scene : comparison_.title; }

  /// Pixels of the notes, which stand at the foot.
  int notes_height() const { return notes_.empty() ? 0 : kNoteHeight * static_cast<int>(notes_.size()) + 10; }

  std::string subtitle() const {
    const std::string reference =
        comparison_.reference_name == "exact" ? "the closed form" : comparison_.reference_name;
    return "reference (red): " + reference + "; error: maximum over the samples of all components (SI units)";
  }

  /// Of the list of methods, as part of the figure's width.
  double legend_width() const {
    constexpr double kSample = 60.0, kCharacter = 8.6, kLeast = 0.195;
    std::size_t longest = 0;
    for (const RowStyle& style : styles_) longest = std::max(longest, entry(style).size());
    return std::max(kLeast, (kSample + kCharacter * static_cast<double>(longest)) / kSize.width);
  }

  /// A frame of the figure without solids, in the one above them.
  Frame upper(Frame frame) const {
    for (double* y : {&frame.bottom, &frame.top})
      *y = (*y * kSize.height + notes_height() + strip_.height() + rotations_.height()) / size_.height;
    return frame;
  }

  bool has_result(const RowStyle& style) const {
    return ranges::any_of(comparison_.rows,
                          [&](const ComparisonRow& row) { return style.is_of(row) && row.succeeded(); });
  }

  /// In the list of methods.
  std::string entry(const RowStyle& style) const { return has_result(style) ? style.name : style.name + ": no result"; }

  /// The error against what it costs, one line for each method.
  void add_work(const Frame& frame, const std::string& label, bool is_first) {
    std::string plot;
    Range costs, errors;
    for (const RowStyle& style : styles_) {
      std::vector<std::vector<double>> rows;
      for (const ComparisonRow& row : comparison_.rows) {
        if (!style.is_of(row) || !row.succeeded() || !row.at_samples.state) continue;
        if (!(*row.at_samples.state <= largest_error_)) continue;
        const double cost =
            is_first ? static_cast<double>(row.statistics.law_evaluations) : 1e3 * row.statistics.wall_seconds;
        rows.push_back({std::max(cost, is_first ? 1.0 : 1e-6), std::max(*row.at_samples.state, kSmallestError)});
        costs.include(rows.back()[0]);
        errors.include(rows.back()[1]);
      }
      if (rows.empty()) continue;
      ranges::sort(rows);
      const std::string name = fmt::format("work{}_{}", is_first ? 0 : 1, plot.size());
      script_ += detail::data_block(name, rows);
      plot += fmt::format("{}${} with linespoints lw 1.8 lc '{}' pt {} ps 0.9 title {}", plot.empty() ? "" : ", ", name,
                          detail::color_text(style.color), style.point, quoted(style.name));
    }
    if (plot.empty()) return;
    script_ += detail::place(frame);
    script_ += detail::logarithmic_axis("x", costs) + detail::logarithmic_axis("y", errors);
    script_ += fmt::format("set xlabel {}\nset ylabel {}\n", quoted(label),
                           quoted("error [" + detail::error_unit(comparison_) + "]"));
    script_ += "unset key\nplot " + plot + "\n";
  }

  /// The methods, in a panel of their own: beside a diagram gnuplot would break the list at its height.
  void add_legend(const Frame& frame) {
    std::string plot;
    for (const RowStyle& style : styles_) {
      const char* with = has_result(style) ? "linespoints" : "points";
      plot += fmt::format("{}NaN with {} lw 1.8 lc '{}' pt {} ps 0.9 title {}", plot.empty() ? "" : ", ", with,
                          detail::color_text(style.color), style.point, quoted(entry(style)));
    }
    if (plot.empty()) return;
    script_ += detail::place(frame) +
               "unset logscale\nunset border\nunset tics\nunset grid\nunset xlabel\nunset ylabel\n"
               "set xrange [0:1]\nset yrange [0:1]\n"
               "set key at graph 0, graph 1 left top Left reverse vertical maxrows 40 samplen 2.5\nplot " +
               plot + "\n";
  }

  const Comparison& comparison_;
  std::vector<RowStyle> styles_;
  detail::MotionsPanel motions_;
  detail::RotationPanels rotations_;
  detail::PoseStrip strip_;
  double largest_error_ = std::numeric_limits<double>::infinity();  // that the diagrams show, SI units
  std::vector<std::string> notes_;
  FigureSize size_ = kSize;
  std::string script_;
};

}  // namespace

ShownComponent find_component(const World& world, const std::string& name, const SourceLocation& where) {
  std::vector<std::string> known;
  for (const World::Body& body : world.bodies)
    for (int i = 0; i < BodySlice::kMovingSize; ++i) {
      known.push_back(body.name + (i < 3 ? "." : ".v") + "xyz"[i % 3]);
      if (known.back() == name) return {body.group, body.slice().first + i, name + (i < 3 ? " [m]" : " [m/s]")};
    }
  for (const World::ExtraState& state : world.states) {
    known.push_back(state.name);
    if (known.back() == name) return {state.group, state.offset, name};
  }
  const std::vector<std::string_view> views(known.begin(), known.end());
  throw InputError(where, "there is no component '" + name + "' to show" + did_you_mean(name, views));
}

RowMotion make_row_motion(const MotionRecord& record) {
  RowMotion motion;
  for (std::size_t g = 0; g < record.world().groups.size(); ++g)
    motion.curves.push_back(make_curve(record, static_cast<int>(g)));
  for (const World::Body& body : record.world().bodies)
    motion.poses.push_back(body.rotation ? make_poses(record, body) : std::vector<Pose>());
  return motion;
}

Figure compare_figure(const Comparison& comparison, const World& world, const std::vector<RowMotion>& motions,
                      const std::optional<ShownComponent>& component) {
  return CompareFigure(comparison, world, motions, component).build();
}

}  // namespace trajet
