#include "trajet/viz/compare_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "plot_panel.hpp"
#include "trajet/law/did_you_mean.hpp"

namespace trajet {

namespace {

using detail::Frame;
using detail::quoted;
using detail::Range;

constexpr std::size_t kMostMotions = 6;
constexpr const char* kReferenceColor = "#d01010";
constexpr FigureSize kSize{1240, 760};
/// Errors below this are rounding, and zero has no logarithm.
constexpr double kSmallestError = 1e-17;

struct MethodStyle {
  std::string color;
  int point;  // gnuplot's point type
};

/// The course's colours for its two methods, a palette that colour-blind eyes can tell apart for the others [Okabe and
/// Ito]; the point types do the rest.
MethodStyle style(const std::string& method, std::size_t index) {
  constexpr const char* kColors[] = {"#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#8c5a2b", "#7a7a00"};
  constexpr int kPoints[] = {9, 11, 13, 4, 8, 10, 12, 6, 1, 2, 3};
  if (method == "euler") return {"#0050c8", 7};
  if (method == "rk4") return {"#000000", 5};
  return {kColors[index % std::size(kColors)], kPoints[index % std::size(kPoints)]};
}

/// The components that the panel of motions shows, and its axes.
struct View {
  struct Body {
    int group;
    int offset;
  };
  std::vector<Body> owners;     // all are drawn alike: each body, or the one group of states
  std::vector<int> components;  // behind the owner's offset; one: against time
  std::vector<std::string> labels;
};

class CompareFigure {
 public:
  CompareFigure(const Comparison& comparison, const World& world, const std::vector<RowCurves>& curves,
                const std::optional<ShownComponent>& component)
      : comparison_(comparison), world_(world), curves_(curves), component_(component) {
    for (const ComparisonRow& row : comparison.rows)
      if (!styles_.contains(row.method)) styles_.emplace(row.method, style(row.method, other_count_++));
  }

  Figure build() {
    choose_view();
    script_ = fmt::format(
        "set multiplot\nset label 1 {} at screen 0.5, screen 0.968 center font ',21'\n"
        "set label 2 {} at screen 0.5, screen 0.936 center tc '#505050'\n"
        "set border lw 1.2 lc '#404040'\nset grid lc '#d8d8d8' lt 1 lw 0.8\n",
        quoted(comparison_.title.empty() ? comparison_.scene : comparison_.title), quoted(subtitle()));
    add_motions({0.085, 0.50, 0.11, motions_top()});
    script_ += "unset label 1\nunset label 2\nset logscale xy\nset format xy '10^{%T}'\nset termoption enhanced\n";
    add_work({0.575, 0.79, 0.56, 0.86}, "law evaluations", true);
    add_work({0.575, 0.79, 0.11, 0.42}, "time [ms]", false);
    add_legend({0.8, 0.99, 0.11, 0.86});
    script_ += "unset multiplot\n";
    return {std::move(script_), kSize};
  }

 private:
  std::string subtitle() const {
    const std::string reference =
        comparison_.reference_name == "exact" ? "the closed form" : comparison_.reference_name;
    return "reference (red): " + reference + "; error: maximum over the samples of all components (m, m/s)";
  }

  std::string setting(const ComparisonRow& row) const {
    if (row.rtol) return fmt::format("{}, rtol {:g}", row.method, *row.rtol);
    return fmt::format("{}, {} steps", row.method, row.statistics.steps);
  }

  /// The reference on a grid as fine as the picture.
  std::vector<std::vector<double>> reference_states(int group, std::vector<double>& times) const {
    constexpr int kPoints = 400;
    double until = comparison_.start_time;
    for (const ComparisonRow& row : comparison_.rows)
      if (std::abs(row.compared_until - comparison_.start_time) > std::abs(until - comparison_.start_time))
        until = row.compared_until;
    std::vector<std::vector<double>> states;
    Eigen::VectorXd q;
    for (int k = 0; k <= kPoints; ++k) {
      times.push_back(comparison_.start_time + (until - comparison_.start_time) * k / kPoints);
      comparison_.reference->state(group, times.back(), q);
      states.emplace_back(q.begin(), q.end());
    }
    return states;
  }

  void choose_view() {
    if (component_) {
      view_.owners.push_back({component_->group, 0});
      view_.components.push_back(component_->index);
      view_.labels.push_back(component_->label);
      return;
    }
    if (world_.bodies.empty()) {
      view_.owners.push_back({world_.states.front().group, 0});
      for (std::size_t s = 0; s < world_.states.size() && s < 2; ++s)
        if (world_.states[s].group == world_.states.front().group) {
          view_.components.push_back(world_.states[s].offset);
          view_.labels.push_back(world_.states[s].name);
        }
      return;
    }
    std::array<bool, 3> moves{};
    for (const World::Body& body : world_.bodies) {
      view_.owners.push_back({body.group, body.offset});
      std::vector<double> times;
      const auto states = reference_states(body.group, times);
      for (std::size_t i = 0; i < 3; ++i) {
        Range range;
        for (const auto& state : states) range.include(state[static_cast<std::size_t>(body.offset) + i]);
        moves[i] = moves[i] || range.extent() > 0.0;
      }
    }
    for (int i = 0; i < 3; ++i)
      if (moves[static_cast<std::size_t>(i)]) {
        view_.components.push_back(i);
        view_.labels.push_back(std::string(1, "xyz"[i]) + " [m]");
      }
    if (view_.components.empty()) {
      view_.components = {0};
      view_.labels = {"x [m]"};
    }
  }

  /// Rows of the view: the time first where there is one component only.
  std::vector<std::vector<double>> points(const std::vector<double>& times,
                                          const std::vector<std::vector<double>>& states, int offset) {
    std::vector<std::vector<double>> rows;
    for (std::size_t p = 0; p < times.size(); ++p) {
      rows.emplace_back();
      if (view_.components.size() == 1) rows.back().push_back(times[p]);
      for (const int i : view_.components) rows.back().push_back(states[p][static_cast<std::size_t>(offset + i)]);
      for (std::size_t k = 0; k < rows.back().size(); ++k) ranges_[k].include(rows.back()[k]);
    }
    return rows;
  }

  double error(std::size_t row) const { return comparison_.rows[row].at_samples.state.value_or(0.0); }

  /// All rows if there are few; else of each method the one with the largest error, of the methods with the largest
  /// ones.
  std::vector<std::size_t> rows_to_draw() const {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < comparison_.rows.size(); ++i)
      if (comparison_.rows[i].succeeded()) rows.push_back(i);
    if (rows.size() <= kMostMotions) return rows;
    std::ranges::stable_sort(rows, [this](std::size_t a, std::size_t b) { return error(a) > error(b); });
    std::vector<std::size_t> chosen;
    for (const std::size_t row : rows)
      if (chosen.size() < kMostMotions && std::ranges::none_of(chosen, [&](std::size_t other) {
            return comparison_.rows[other].method == comparison_.rows[row].method;
          }))
        chosen.push_back(row);
    return chosen;
  }

  /// Below the legend of the motions, a line for each and one for the reference.
  double motions_top() const {
    constexpr double kLine = 25.0 / kSize.height;
    return 0.895 - kLine * static_cast<double>(1 + rows_to_draw().size());
  }

  void add_motions(const Frame& frame) {
    const bool is_3d = view_.components.size() == 3;
    std::string plot;
    const auto add = [&](const std::string& name, const std::string& with, const std::string& title) {
      plot += fmt::format("{}${} {} {}", plot.empty() ? "" : ", ", name, with,
                          title.empty() ? "notitle" : "title " + quoted(title));
    };
    // the reference lies beneath
    for (std::size_t o = 0; o < view_.owners.size(); ++o) {
      const auto [group, offset] = view_.owners[o];
      std::vector<double> times;
      const auto states = reference_states(group, times);
      const std::string name = fmt::format("reference{}", o);
      script_ += detail::data_block(name, points(times, states, offset));
      add(name, fmt::format("with lines lw 4 lc '{}'", kReferenceColor), o == 0 ? comparison_.reference_name : "");
    }
    constexpr const char* kDashes[] = {"dt 1", "dt (12,5)", "dt (3,4)"};
    std::map<std::string, std::size_t> count;  // of the rows of each method so far
    for (const std::size_t r : rows_to_draw()) {
      const ComparisonRow& row = comparison_.rows[r];
      const char* dash = kDashes[count[row.method]++ % std::size(kDashes)];
      const MethodStyle& look = styles_.at(row.method);
      for (std::size_t o = 0; o < view_.owners.size(); ++o) {
        const auto [group, offset] = view_.owners[o];
        const Curve& curve = curves_[r][static_cast<std::size_t>(group)];
        const std::string name = fmt::format("row{}_{}", r, o);
        script_ += detail::data_block(name, points(curve.times, curve.states, offset));
        add(name, fmt::format("with lines lw 2 lc '{}' {}", look.color, dash), o == 0 ? setting(row) : "");
      }
    }
    script_ += is_3d ? detail::place_3d(frame) : detail::place(frame);
    constexpr const char* kAxes[] = {"x", "y", "z"};
    std::vector<std::string> labels = view_.labels;
    if (labels.size() == 1) labels.insert(labels.begin(), "time [s]");
    for (std::size_t k = 0; k < labels.size(); ++k)
      script_ += detail::axis(kAxes[k], ranges_[k].padded(), is_3d ? 4 : 5) +
                 fmt::format("set {}label {}{}\n", kAxes[k], quoted(labels[k]), k == 2 ? " rotate by 90" : "");
    script_ += fmt::format("set key at screen {}, screen {} left bottom Left reverse vertical maxrows 10 samplen 2\n",
                           frame.left, frame.top + 0.008);
    script_ += (is_3d ? "splot " : "plot ") + plot + "\nunset zlabel\n";
  }

  /// The error against what it costs, one line for each method.
  void add_work(const Frame& frame, const std::string& label, bool is_first) {
    std::string plot;
    Range costs, errors;
    for (const auto& [method, look] : styles_) {
      std::vector<std::vector<double>> rows;
      for (const ComparisonRow& row : comparison_.rows) {
        if (row.method != method || !row.succeeded() || !row.at_samples.state) continue;
        const double cost =
            is_first ? static_cast<double>(row.statistics.law_evaluations) : 1e3 * row.statistics.wall_seconds;
        rows.push_back({std::max(cost, is_first ? 1.0 : 1e-6), std::max(*row.at_samples.state, kSmallestError)});
        costs.include(rows.back()[0]);
        errors.include(rows.back()[1]);
      }
      if (rows.empty()) continue;
      std::ranges::sort(rows);
      const std::string name = fmt::format("work{}_{}", is_first ? 0 : 1, plot.size());
      script_ += detail::data_block(name, rows);
      plot += fmt::format("{}${} with linespoints lw 1.8 lc '{}' pt {} ps 0.9 title {}", plot.empty() ? "" : ", ", name,
                          look.color, look.point, quoted(method));
    }
    if (plot.empty()) return;
    script_ += detail::place(frame);
    script_ += detail::logarithmic_axis("x", costs) + detail::logarithmic_axis("y", errors);
    script_ += fmt::format("set xlabel {}\nset ylabel 'error'\n", quoted(label));
    script_ += "unset key\nplot " + plot + "\n";
  }

  /// The methods, in a panel of their own: beside a diagram gnuplot would break the list at its height.
  void add_legend(const Frame& frame) {
    std::string plot;
    for (const auto& [method, look] : styles_) {
      const bool is_drawn = std::ranges::any_of(comparison_.rows, [&](const ComparisonRow& row) {
        return row.method == method && row.succeeded() && row.at_samples.state;
      });
      if (is_drawn)
        plot += fmt::format("{}NaN with linespoints lw 1.8 lc '{}' pt {} ps 0.9 title {}", plot.empty() ? "" : ", ",
                            look.color, look.point, quoted(method));
    }
    if (plot.empty()) return;
    script_ += detail::place(frame) +
               "unset logscale\nunset border\nunset tics\nunset grid\nunset xlabel\nunset ylabel\n"
               "set xrange [0:1]\nset yrange [0:1]\n"
               "set key at graph 0, graph 1 left top Left reverse vertical maxrows 40 samplen 2.5\nplot " +
               plot + "\n";
  }

  const Comparison& comparison_;
  const World& world_;
  const std::vector<RowCurves>& curves_;
  const std::optional<ShownComponent>& component_;
  std::map<std::string, MethodStyle> styles_;
  std::size_t other_count_ = 0;
  View view_;
  std::array<Range, 3> ranges_;
  std::string script_;
};

}  // namespace

ShownComponent find_component(const World& world, const std::string& name, const SourceLocation& where) {
  std::vector<std::string> known;
  for (const World::Body& body : world.bodies)
    for (int i = 0; i < 6; ++i) {
      known.push_back(body.name + (i < 3 ? "." : ".v") + "xyz"[i % 3]);
      if (known.back() == name) return {body.group, body.offset + i, name + (i < 3 ? " [m]" : " [m/s]")};
    }
  for (const World::ExtraState& state : world.states) {
    known.push_back(state.name);
    if (known.back() == name) return {state.group, state.offset, name};
  }
  const std::vector<std::string_view> views(known.begin(), known.end());
  throw InputError(where, "there is no component '" + name + "' to show" + did_you_mean(name, views));
}

Figure compare_figure(const Comparison& comparison, const World& world, const std::vector<RowCurves>& curves,
                      const std::optional<ShownComponent>& component) {
  return CompareFigure(comparison, world, curves, component).build();
}

}  // namespace trajet
