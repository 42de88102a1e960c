#include "trajet/viz/sweep_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "plot_panel.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

using detail::Frame;
using detail::quoted;
using detail::Range;

constexpr std::size_t kMostPanels = 4;
constexpr std::uint64_t kMostPoints = 5000;  // more are no other picture
constexpr std::uint64_t kMostCells = 250'000;
constexpr double kOverlap = 1.02;  // of the cells of a map, so that nothing shines through between them
constexpr FigureSize kPanel{560, 380};
constexpr int kTitleHeight = 48;

class SweepFigure {
 public:
  SweepFigure(const ShownSweep& sweep, const SweepSummary& summary) : sweep_(sweep), summary_(summary) {
    choose_columns();
    const auto most_hit = ranges::max_element(summary.hits, {}, &SweepSummary::Hit::count);
    if (sweep.is_sampled && most_hit != summary.hits.end() && most_hit->dispersion) scattered_ = &*most_hit;
    if (scattered_ != nullptr && columns_.size() == kMostPanels) columns_.pop_back();
  }

  Figure build() {
    const std::size_t panels = std::max<std::size_t>(columns_.size() + (scattered_ != nullptr ? 1 : 0), 1);
    across_ = panels == 1 ? 1 : 2;
    down_ = static_cast<int>(panels + 1) / across_;
    if (panels == 1) down_ = 1;
    size_ = {kPanel.width * across_, kPanel.height * down_ + kTitleHeight};
    script_ = fmt::format(
        "set multiplot\nset label 1 {} at screen 0.5, screen {:.4f} center font ',21'\n"
        "set border lw 1.2 lc '#404040'\nset grid lc '#d8d8d8' lt 1 lw 0.8\nunset key\n",
        quoted(sweep_.title), 1.0 - 24.0 / size_.height);
    int panel = 0;
    for (const SweepSummary::Column* column : columns_) {
      const Frame frame = frame_of(panel++);
      if (sweep_.is_sampled || sweep_.axis_count == 0)
        add_histogram(*column, frame);
      else if (sweep_.axis_count == 1)
        add_line(*column, frame);
      else
        add_map(*column, frame);
      script_ += "unset label 1\n";
    }
    if (scattered_ != nullptr) add_scatter(frame_of(panel));
    if (panels == 1 && columns_.empty() && scattered_ == nullptr)
      script_ += "set xrange [0:1]\nset yrange [0:1]\nplot NaN\n";
    script_ += "unset multiplot\n";
    return {std::move(script_), size_, sweep_.title};
  }

 private:
  /// Those that say something: numbers that vary.
  void choose_columns() {
    for (const SweepSummary::Column& column : summary_.columns)
      if (columns_.size() < kMostPanels && column.numbers.max() > column.numbers.min()) columns_.push_back(&column);
  }

  Frame frame_of(int panel) const {
    const double width = 1.0 / across_, height = static_cast<double>(kPanel.height) / size_.height;
    const double left = width * (panel % across_),
                 top = 1.0 - static_cast<double>(kTitleHeight) / size_.height - height * (panel / across_);
    return {left + 0.16 * width, left + 0.95 * width, top - 0.82 * height, top - 0.03 * height};
  }

  std::size_t stream_of(const std::string& column) const {
    const auto place = ranges::find(sweep_.header.columns, column);
    return sweep_.header.quantities.size() + static_cast<std::size_t>(place - sweep_.header.columns.begin());
  }

  std::string next_block() { return fmt::format("rows{}", ++last_block_); }

  void add_axes(const std::string& x, const Range& x_range, const std::string& y, const Range& y_range,
                const Frame& frame) {
    script_ += detail::place(frame) + detail::axis("x", x_range, 5) + detail::axis("y", y_range, 5);
    script_ += fmt::format("set xlabel {}\nset ylabel {}\n", quoted(x), quoted(y));
  }

  /// Each so-manieth row, so that at most `most` are used.
  void each_shown_row(std::uint64_t most, const std::function<void(std::span<const double>)>& use) const {
    const std::uint64_t stride = summary_.tally.count / most + 1;
    std::uint64_t n = 0;
    sweep_.rows([&](std::span<const double> row) {
      if (n++ % stride == 0) use(row);
    });
  }

  void add_line(const SweepSummary::Column& column, const Frame& frame) {
    const std::size_t stream = stream_of(column.name);
    std::vector<std::vector<double>> points;
    Range x;
    each_shown_row(kMostPoints, [&](std::span<const double> row) {
      x.include(row[0]);
      if (std::isnan(row[stream]))
        points.emplace_back();
      else
        points.push_back({row[0], row[stream]});
    });
    const std::string name = next_block();
    script_ += detail::data_block(name, points);
    add_axes(sweep_.header.quantities[0], x, column.name, range_of(column), frame);
    script_ += fmt::format("plot ${} with {} lw 2 pt 7 ps 0.4 lc '#1f4fbf'\n", name,
                           points.size() > 60 ? "lines" : "linespoints");
  }

  static Range range_of(const SweepSummary::Column& column) {
    Range range;
    range.include(column.numbers.min());
    range.include(column.numbers.max());
    return range.padded();
  }

  void add_histogram(const SweepSummary::Column& column, const Frame& frame) {
    const std::size_t stream = stream_of(column.name);
    const double low = column.numbers.min(), high = column.numbers.max();
    // bins of twice the interquartile range over the cube root of the count (Freedman and Diaconis 1981)
    const double quartiles = column.quantiles[4] - column.quantiles[2];
    const double ideal = 2.0 * quartiles / std::cbrt(static_cast<double>(column.numbers.count()));
    const double bins = std::clamp(std::ceil((high - low) / ideal), 5.0, 80.0);
    const auto bin_count = static_cast<std::size_t>(std::isnan(bins) ? 20.0 : bins);
    const double width = (high - low) / static_cast<double>(bin_count);
    std::vector<double> counts(bin_count);
    sweep_.rows([&](std::span<const double> row) {
      if (std::isnan(row[stream])) return;
      const auto bin = static_cast<std::size_t>((row[stream] - low) / width);
      counts[std::min(bin, bin_count - 1)] += 1.0;
    });
    std::vector<std::vector<double>> boxes;
    Range y;
    y.include(0.0);
    for (std::size_t i = 0; i < bin_count; ++i) {
      const double share = 100.0 * counts[i] / static_cast<double>(column.numbers.count());
      boxes.push_back({low + width * (static_cast<double>(i) + 0.5), share, width});
      y.include(1.05 * share);
    }
    const std::string name = next_block();
    script_ += detail::data_block(name, boxes);
    Range x;
    x.include(low);
    x.include(high);
    add_axes(column.name, x.padded(), "share of the motions [%]", y, frame);
    script_ += fmt::format("plot ${} with boxes fillstyle solid 0.55 lw 1 lc '#1f4fbf'\n", name);
  }

  void add_map(const SweepSummary::Column& column, const Frame& frame) {
    const std::size_t stream = stream_of(column.name);
    Range x, y;
    std::vector<double> xs, ys;
    each_shown_row(kMostCells, [&](std::span<const double> row) {
      x.include(row[1]);
      y.include(row[0]);
      xs.push_back(row[1]);
      ys.push_back(row[0]);
    });
    const auto steps = [](std::vector<double> values) {
      std::sort(values.begin(), values.end());
      values.erase(std::unique(values.begin(), values.end()), values.end());
      return std::max<std::size_t>(values.size(), 2) - 1;
    };
    const double half_x = kOverlap * 0.5 * x.extent() / static_cast<double>(steps(std::move(xs)));
    const double half_y = kOverlap * 0.5 * y.extent() / static_cast<double>(steps(std::move(ys)));
    std::vector<std::vector<double>> cells;
    each_shown_row(kMostCells, [&](std::span<const double> row) {
      if (!std::isnan(row[stream])) cells.push_back({row[1], row[0], half_x, half_y, row[stream]});
    });
    for (Range* range : {&x, &y}) {
      const double half = range == &x ? half_x : half_y;
      const double low = range->low - half, high = range->high + half;
      range->include(low);
      range->include(high);
    }
    const std::string name = next_block();
    script_ += detail::data_block(name, cells);
    Frame narrow = frame;
    narrow.right -= 0.17 * (frame.right - frame.left);
    add_axes(sweep_.header.quantities[1], x, sweep_.header.quantities[0], y, narrow);
    script_ += fmt::format(
        "set palette defined (0 '#0d0887', 1 '#7e03a8', 2 '#cc4778', 3 '#f89540', 4 '#f0f921')\n"
        "set cbrange [{:.17g}:{:.17g}]\nset cblabel {}\n"
        "plot ${} using 1:2:3:4:5 with boxxyerror fillstyle solid noborder lc palette\nunset cblabel\n",
        column.numbers.min(), column.numbers.max(), quoted(column.name), name);
  }

  /// A point in the plane of the ellipse, in its own axes turned so that they are near those of the world.
  struct Plane {
    Vector3 origin, right, up;
    std::vector<double> of(const Vector3& p) const { return {right.dot(p - origin), up.dot(p - origin)}; }
  };

  static Plane plane_of(const Dispersion& spread) {
    const Vector3 normal = spread.major.cross(spread.minor);
    const Vector3 up = std::abs(normal.z()) < 0.7 ? Vector3(0, 0, 1) : Vector3(0, 1, 0);
    const Vector3 right = up.cross(normal).normalized();
    return {spread.mean, right, normal.cross(right)};
  }

  void add_scatter(const Frame& frame) {
    const Dispersion& spread = *scattered_->dispersion;
    const Plane plane = plane_of(spread);
    std::array<std::size_t, 3> place{};
    for (std::size_t i = 0; i < 3; ++i) place[i] = stream_of(std::string("impact(1).") + "xyz"[i]);
    Range x, y;
    std::vector<std::vector<double>> points;
    each_shown_row(kMostPoints, [&](std::span<const double> row) {
      const Vector3 p(row[place[0]], row[place[1]], row[place[2]]);
      if (!p.allFinite()) return;
      points.push_back(plane.of(p));
    });
    std::vector<std::vector<double>> ellipses;
    for (const double share : {0.5, 0.95}) {
      // of a normal scatter in a plane, the share 1 - exp(-k²/2) lies within k deviations
      const double k = std::sqrt(-2.0 * std::log(1.0 - share));
      for (int i = 0; i <= 120; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 120.0;
        ellipses.push_back(plane.of(spread.mean + k * (spread.major_deviation * std::cos(angle) * spread.major +
                                                       spread.minor_deviation * std::sin(angle) * spread.minor)));
        x.include(ellipses.back()[0]);
        y.include(ellipses.back()[1]);
      }
      ellipses.emplace_back();
    }
    // as long on both axes
    const double half = 0.75 * std::max(x.extent(), y.extent());
    for (Range* range : {&x, &y}) *range = {-half, half};
    const std::string cloud = next_block(), ellipse = next_block();
    script_ += detail::data_block(cloud, points) + detail::data_block(ellipse, ellipses);
    add_axes("first impacts on " + scattered_->name + " [m]", x, "from their mean [m]", y, frame);
    script_ += fmt::format(
        "set size ratio -1\nplot ${} with points pt 7 ps 0.35 lc '#8097c8', ${} with lines lw 2 lc '#c02020'\n"
        "set size noratio\n",
        cloud, ellipse);
  }

  const ShownSweep& sweep_;
  const SweepSummary& summary_;
  std::vector<const SweepSummary::Column*> columns_;
  const SweepSummary::Hit* scattered_ = nullptr;
  std::string script_;
  FigureSize size_;
  int across_ = 1, down_ = 1;
  int last_block_ = 0;
};

}  // namespace

Figure sweep_figure(const ShownSweep& sweep, const SweepSummary& summary) {
  return SweepFigure(sweep, summary).build();
}

}  // namespace trajet
