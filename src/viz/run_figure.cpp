#include "trajet/viz/run_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "path_panel.hpp"
#include "plot_panel.hpp"
#include "pose_strip.hpp"
#include "shown_clock.hpp"
#include "trajet/portable.hpp"
#include "trajet/viz/curve.hpp"

namespace trajet {

namespace {

using detail::quoted;
using detail::Range;

constexpr std::size_t kMostBodies = 3;
constexpr std::size_t kMostStates = 4;
constexpr std::size_t kMostImpactLines = 40;
/// Of a line below the title, pixels.
constexpr int kNoteHeight = 20;
/// Paths in space that are so many times as wide as high lie below the other panels.
constexpr double kWide = 1.7;

/// A vector that is drawn of a body against time.
struct Quantity {
  const char* label;
  const char* color;
  bool is_rate;  // read from the rates of the state
  int index;     // in the state, of its first component
};

double component(const Curve& curve, std::size_t point, bool is_rate, int index) {
  return (is_rate ? curve.rates : curve.states)[point][static_cast<std::size_t>(index)];
}

/// The largest component of a vector along a curve, 0 without a curve.
double largest(const Curve& curve, bool is_rate, int index) {
  double result = 0.0;
  for (std::size_t point = 0; point < curve.times.size(); ++point)
    for (int i = 0; i < 3; ++i) result = std::max(result, std::abs(component(curve, point, is_rate, index + i)));
  return result;
}

/// What is smaller than this, against what it is measured by, is rounding.
constexpr double kRounding = 1e-12;

/// What there is to tell of a body against time, in the course's colours; the fourth one it leaves free. Without what
/// is 0 throughout, or by rounding alone not 0: what would not change the quantity before it within the run.
std::vector<Quantity> quantities_of(const World::Body& body, const Curve& curve) {
  const double duration = curve.times.empty() ? 0.0 : std::abs(curve.times.back() - curve.times.front());
  const BodySlice slice = body.slice();
  const double position = largest(curve, false, slice.position_index()) + detail::look(body).radius();
  const double velocity = largest(curve, false, slice.velocity_index());
  const double acceleration = largest(curve, true, slice.velocity_index());
  const bool moves = velocity * duration > kRounding * position;
  const bool accelerates =
      acceleration * duration > kRounding * std::max(velocity, position / std::max(duration, 1e-300));
  std::vector<Quantity> quantities;
  if (moves || !body.rotation || curve.times.empty())
    quantities = {{"position [m]", "#0050c8", false, slice.position_index()},
                  {"velocity [m/s]", "#008a20", false, slice.velocity_index()}};
  if (accelerates || curve.times.empty())
    quantities.push_back({"acceleration [m/s²]", "#d01010", true, slice.velocity_index()});
  if (body.rotation) {
    const bool is_in_world = body.rotation->layout.frame == Frame::world;
    quantities.push_back({is_in_world ? "ω, world [rad/s]" : "ω, body's frame [rad/s]", "#b06000", false,
                          slice.angular_velocity_index()});
  }
  return quantities;
}

/// The value of a vector that does not change along a curve but by rounding, as its first point has it.
std::optional<Vector3> constant_value(const Curve& curve, const Quantity& quantity) {
  const double size = largest(curve, quantity.is_rate, quantity.index);
  Vector3 value = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    Range range;
    for (std::size_t point = 0; point < curve.times.size(); ++point)
      range.include(component(curve, point, quantity.is_rate, quantity.index + i));
    if (!(range.extent() <= kRounding * size)) return std::nullopt;
    if (!range.is_empty()) value[i] = component(curve, 0, quantity.is_rate, quantity.index + i);
    if (std::abs(value[i]) <= kRounding * size) value[i] = 0.0;
  }
  return value;
}

/// Components differ by their dashes, which survive a copier and any eye.
constexpr const char* kDashes[] = {"dt 1", "dt (14,6)", "dt (3,5)"};
constexpr const char* kStateColor = "#6a3d9a";

std::vector<Curve> make_curves(const MotionRecord& record) {
  std::vector<Curve> curves;
  for (std::size_t g = 0; g < record.world().groups.size(); ++g)
    curves.push_back(make_curve(record, static_cast<int>(g)));
  return curves;
}

/// Builds the script panel by panel.
class RunFigure {
 public:
  RunFigure(const RunResult& result, const MotionRecord& record)
      : result_(result),
        world_(record.world()),
        curves_(make_curves(record)),
        paths_(result, record, curves_),
        strip_(clock(), world_.up) {
    // a run that ends at its start has nothing to show against time
    const bool moves = ranges::any_of(curves_, [](const Curve& curve) { return !curve.times.empty(); });
    if (moves || paths_.is_empty()) body_count_ = std::min(world_.bodies.size(), kMostBodies);
    for (std::size_t b = 0; b < body_count_; ++b) {
      const Curve& curve = curve_of(world_.bodies[b]);
      Plotted plotted{b, quantities_of(world_.bodies[b], curve)};
      const bool is_constant = ranges::all_of(
          plotted.quantities, [&](const Quantity& quantity) { return constant_value(curve, quantity).has_value(); });
      if (is_constant && moves && !paths_.is_empty())
        notes_.push_back(constants(plotted));
      else
        plotted_.push_back(std::move(plotted));
    }
    state_count_ = std::min(world_.states.size(), kMostStates);
    for (std::size_t b = 0; b < body_count_; ++b) {
      const World::Body& body = world_.bodies[b];
      const std::vector<Pose> poses = make_poses(record, body);
      const detail::Look shown = detail::look(body);
      const bool is_one_line = shown.points.size() == 1;
      if (body.rotation && poses.size() > 1 && !shown.is_empty() && !is_one_line)
        strip_.add_row(body.name + ", seen from its centre", shown, poses, detail::body_color(world_, b));
    }
  }

  Figure build() {
    const bool has_paths = !paths_.is_empty();
    std::size_t rows = state_count_;
    for (const Plotted& plotted : plotted_) rows = std::max(rows, plotted.quantities.size());
    columns_ = plotted_.size() + (state_count_ > 0 ? 1 : 0);
    // wide paths lie below; what is against time stands beside them otherwise, one column for each body
    const bool paths_lie = has_paths && columns_ > 0 && paths_.aspect() > kWide;
    if (paths_lie && columns_ == 1 && plotted_.size() == 1) {
      quantity_columns_ = 2;
      rows = (rows + 1) / 2;
    }
    if (columns_ > 0) columns_ = std::max(columns_, quantity_columns_);
    if (has_paths && !paths_lie) ++columns_;
    const int width = static_cast<int>(columns_ == 1 ? 760 : 560 * columns_);
    if (paths_lie) path_height_ = std::clamp(static_cast<int>((width - 170) / paths_.aspect()) + 120, 280, 560);
    figure_.title = title();
    figure_.size = {width, static_cast<int>(32 + 230 * std::max<std::size_t>(rows, 2)) + head_height() + path_height_ +
                               strip_.height()};
    figure_.script = fmt::format("set multiplot\nset label 1 {} at screen 0.5, screen {:.4f} center font ',21'\n",
                                 quoted(title()), 1.0 - 24.0 / figure_.size.height);
    add_subtitle();
    figure_.script +=
        "set border lw 1.2 lc '#404040'\nset grid lc '#d8d8d8' lt 1 lw 0.8\nset style line 9 lc '#909090' lw 1.2 dt "
        "(2,4)\n";
    for (std::size_t column = 0; column < plotted_.size(); ++column) add_body(plotted_[column], column);
    if (state_count_ > 0) add_states(plotted_.size());
    if (has_paths) {
      figure_.script += paths_.script(
          paths_lie ? below(strip_.height() + 12, path_height_ - 44) : path_frame(columns_ - 1), figure_.size);
      end_panel();
    }
    if (!strip_.is_empty()) figure_.script += strip_.script(below(8, strip_.height() - 12), figure_.size);
    figure_.script += "unset multiplot\n";
    return std::move(figure_);
  }

 private:
  /// A body with what is drawn of it against time.
  struct Plotted {
    std::size_t body;
    std::vector<Quantity> quantities;
  };

  std::string title() const { return result_.title.empty() ? result_.scene : result_.title; }

  const Curve& curve_of(const World::Body& body) const { return curves_[static_cast<std::size_t>(body.group)]; }

  /// What stands in the place of curves that are all constant.
  std::string constants(const Plotted& plotted) const {
    const World::Body& body = world_.bodies[plotted.body];
    std::string text = world_.bodies.size() > 1 ? body.name + ": " : "";
    const char* separator = "";
    for (const Quantity& quantity : plotted.quantities) {
      const Vector3 value = constant_value(curve_of(body), quantity).value_or(Vector3::Zero());
      const std::string label = quantity.label;
      const std::size_t unit = label.find(" [");
      text += fmt::format("{}{} = ({}, {}, {}) {}", separator, label.substr(0, unit), detail::short_text(value.x()),
                          detail::short_text(value.y()), detail::short_text(value.z()),
                          label.substr(unit + 2, label.size() - unit - 3));
      separator = "; ";
    }
    return text + ", constant";
  }

  /// Pixels of the titles, above all panels.
  int head_height() const { return 78 + kNoteHeight * static_cast<int>(notes_.size()); }

  void add_subtitle() {
    std::string text = "method " + result_.method;
    if (world_.bodies.size() > kMostBodies)
      text += fmt::format("; the first {} of {} bodies against time", body_count_, world_.bodies.size());
    if (world_.states.size() > state_count_)
      text += fmt::format("; the first {} of {} states", state_count_, world_.states.size());
    if (!result_.impacts.empty()) text += fmt::format("; impacts: {}", result_.impacts.size());
    std::string lines = quoted(text);
    for (const std::string& note : notes_) lines += ".\"\\n\"." + quoted(note);
    figure_.script += fmt::format("set label 2 {} at screen 0.5, screen {:.4f} center tc '#505050'\n", lines,
                                  1.0 - 48.0 / figure_.size.height);
  }

  /// The frame of the panel in a column, `row` of `rows` from the top.
  detail::Frame frame(std::size_t column, std::size_t row, std::size_t rows) const {
    const double width = 1.0 / static_cast<double>(columns_), pixel_x = 1.0 / figure_.size.width,
                 pixel_y = 1.0 / figure_.size.height;
    const double top = 1.0 - head_height() * pixel_y;
    const double height = (top - (16.0 + strip_.height() + path_height_) * pixel_y) / static_cast<double>(rows);
    const double left = width * static_cast<double>(column);
    const double panel_top = top - height * static_cast<double>(row);
    return {left + 104.0 * pixel_x, left + width - 22.0 * pixel_x, panel_top - height + 52.0 * pixel_y,
            panel_top - 22.0 * pixel_y};
  }

  /// A frame as wide as the figure, in pixels from its lower edge.
  detail::Frame below(int bottom, int height) const {
    const double pixel_x = 1.0 / figure_.size.width, pixel_y = 1.0 / figure_.size.height;
    return {24.0 * pixel_x, 1.0 - 24.0 * pixel_x, bottom * pixel_y, (bottom + height) * pixel_y};
  }

  /// That of the paths, which in space brings its own room for the axes' labels.
  detail::Frame path_frame(std::size_t column) const {
    detail::Frame whole = frame(column, 0, 1);
    if (!paths_.is_in_space()) return whole;
    whole.left -= 84.0 / figure_.size.width;
    whole.right += 10.0 / figure_.size.width;
    whole.bottom -= 40.0 / figure_.size.height;
    return whole;
  }

  /// A plot of lines against time.
  void add_time_panel(const detail::Frame& frame, const std::string& label, const Range& times, const Range& values,
                      bool is_last, const std::string& lines) {
    std::string& script = figure_.script;
    script += detail::place(frame) + detail::axis("x", times, 6) + detail::axis("y", values.padded(), 5);
    script += fmt::format("set ylabel {}\nset xlabel {}\n", quoted(label), quoted(is_last ? clock().label() : ""));
    script += "set key at graph 1, graph 1 right bottom Left reverse horizontal samplen 3\n";
    script += "plot " + lines + "\nunset arrow\n";
    end_panel();
  }

  /// Vertical lines at the times of a body's impacts.
  std::string impact_lines(const std::string& body) const {
    std::string script;
    std::size_t count = 0;
    for (const Impact& impact : result_.impacts)
      if (impact.body == body && count++ < kMostImpactLines)
        script +=
            fmt::format("set arrow from {0}, graph 0 to {0}, graph 1 nohead ls 9 back\n", clock().time(impact.elapsed));
    return script;
  }

  /// The title stands in the first panel's labels; the others must not print it again.
  void end_panel() {
    if (prints_title_) figure_.script += "unset label 1\nunset label 2\n";
    prints_title_ = false;
  }

  detail::ShownClock clock() const { return {world_.epoch, world_.duration}; }

  Range times(const Curve& curve) const {
    Range range;
    for (const double t : curve.times) range.include(clock().time(t));
    if (range.extent() == 0.0) return {clock().time(0.0), clock().time(0.0) + 1.0};
    return range;
  }

  /// Which coordinates are not 0, or by rounding alone, in everything that is drawn of a body; all if none is.
  std::array<bool, 3> moving_coordinates(const Plotted& plotted) const {
    const Curve& curve = curve_of(world_.bodies[plotted.body]);
    std::array<bool, 3> moves{};
    for (const Quantity& quantity : plotted.quantities) {
      const double rounding = kRounding * largest(curve, quantity.is_rate, quantity.index);
      for (std::size_t p = 0; p < curve.times.size(); ++p)
        for (int i = 0; i < 3; ++i)
          moves[static_cast<std::size_t>(i)] |=
              std::abs(component(curve, p, quantity.is_rate, quantity.index + i)) > rounding;
    }
    if (moves == std::array<bool, 3>{}) moves.fill(true);
    return moves;
  }

  void add_body(const Plotted& plotted, std::size_t column) {
    const World::Body& body = world_.bodies[plotted.body];
    const Curve& curve = curve_of(body);
    const std::vector<Quantity>& quantities = plotted.quantities;
    const std::array<bool, 3> moves = moving_coordinates(plotted);
    const bool is_alone = ranges::count(moves, true) == 1;

    for (std::size_t q = 0; q < quantities.size(); ++q) {
      const Quantity& quantity = quantities[q];
      std::vector<std::vector<double>> rows;
      Range values;
      for (std::size_t p = 0; p < curve.times.size(); ++p) {
        rows.push_back({clock().time(curve.times[p])});
        for (int i = 0; i < 3; ++i) {
          const double value = component(curve, p, quantity.is_rate, quantity.index + i);
          rows.back().push_back(value);
          if (moves[static_cast<std::size_t>(i)]) values.include(value);
        }
      }
      const std::string name = fmt::format("body{}_{}", plotted.body, q);
      figure_.script += detail::data_block(name, rows);
      std::string lines;
      for (std::size_t i = 0; i < 3; ++i)
        if (moves[i])
          lines += fmt::format("{}${} using 1:{} with lines lw 2.4 lc '{}' {} title '{}'", lines.empty() ? "" : ", ",
                               name, i + 2, quantity.color, kDashes[is_alone ? 0 : i], "xyz"[i]);
      figure_.script += impact_lines(body.name);
      const std::string owner = world_.bodies.size() > 1 ? body.name + ": " : "";
      const std::size_t rows_of_panels = (quantities.size() + quantity_columns_ - 1) / quantity_columns_;
      add_time_panel(frame(column + q % quantity_columns_, q / quantity_columns_, rows_of_panels),
                     owner + quantity.label, times(curve), values, q + quantity_columns_ >= quantities.size(), lines);
    }
  }

  void add_states(std::size_t column) {
    for (std::size_t s = 0; s < state_count_; ++s) {
      const World::ExtraState& state = world_.states[s];
      const Curve& curve = curves_[static_cast<std::size_t>(state.group)];
      std::vector<std::vector<double>> rows;
      Range values;
      for (std::size_t p = 0; p < curve.times.size(); ++p) {
        rows.push_back({clock().time(curve.times[p]), component(curve, p, false, state.offset)});
        values.include(rows.back()[1]);
      }
      const std::string name = fmt::format("state{}", s);
      figure_.script += detail::data_block(name, rows);
      add_time_panel(frame(column, s, state_count_), state.name, times(curve), values, s + 1 == state_count_,
                     fmt::format("${} using 1:2 with lines lw 2.4 lc '{}' notitle", name, kStateColor));
    }
  }

  const RunResult& result_;
  const World& world_;
  std::vector<Curve> curves_;
  detail::PathPanel paths_;
  detail::PoseStrip strip_;
  std::vector<Plotted> plotted_;
  std::vector<std::string> notes_;  // lines below the title
  std::size_t body_count_ = 0;
  std::size_t state_count_ = 0;
  std::size_t columns_ = 1;           // of panels one above another
  std::size_t quantity_columns_ = 1;  // of a body
  int path_height_ = 0;               // pixels; of wide paths, below the others
  bool prints_title_ = true;
  Figure figure_;
};

}  // namespace

Figure run_figure(const RunResult& result, const MotionRecord& record) { return RunFigure(result, record).build(); }

}  // namespace trajet
