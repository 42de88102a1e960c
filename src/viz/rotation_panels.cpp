#include "rotation_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace trajet::detail {
namespace {

/// Drifts below this are rounding: a quantity of which no row has more is not drawn.
constexpr double kRounding = 1e-13;
constexpr double kLeast = 1e-16;
/// Beyond this a line is cut: the method has failed.
constexpr double kMost = 1e3;

struct Quantity {
  const char* title;
  std::optional<double> (*of)(const RotationDeviation& deviation);
};

constexpr Quantity kQuantities[] = {
    {"|det R − 1|",
     [](const RotationDeviation& deviation) -> std::optional<double> {
       if (!deviation.determinant) return std::nullopt;
       return std::abs(*deviation.determinant - 1.0);
     }},
    {"angle from the reference [rad]", [](const RotationDeviation& deviation) { return deviation.angle_rad; }},
    {"relative drift of energy", [](const RotationDeviation& deviation) { return deviation.energy; }},
    {"relative drift of momentum", [](const RotationDeviation& deviation) { return deviation.momentum; }}};

/// Without those that are 0, as at the start: they have no logarithm.
std::vector<std::vector<double>> points(const ComparisonRow& row, const Quantity& quantity, const ShownClock& clock) {
  std::vector<std::vector<double>> points;
  for (const RotationSample& sample : row.rotation_history)
    if (const auto value = quantity.of(sample.deviation); value && *value > 0.0) {
      if (!(*value <= kMost)) break;
      points.push_back({clock.time(sample.time), std::max(*value, kLeast)});
    }
  return points;
}

}  // namespace

RotationPanels::RotationPanels(const Comparison& comparison, const std::vector<RowStyle>& styles)
    : clock_{comparison.epoch, comparison.duration} {
  if (!comparison.turns) return;
  for (const Quantity& quantity : kQuantities) {
    Panel panel{quantity.title, {}};
    double largest = 0.0;
    for (const RowStyle& style : styles) {
      int dash = 1;
      for (const ComparisonRow& row : comparison.rows) {
        if (!style.is_of(row) || !row.succeeded()) continue;
        std::vector<std::vector<double>> line = points(row, quantity, clock_);
        for (const auto& point : line) largest = std::max(largest, point[1]);
        if (!line.empty()) panel.lines.push_back({std::move(line), style.color, dash++});
      }
    }
    if (largest > kRounding) panels_.push_back(std::move(panel));
  }
}

std::string RotationPanels::script(int bottom, const FigureSize& size) const {
  std::string script =
      "set termoption enhanced\nunset label\nunset key\nset border lw 1.2 lc '#404040'\n"
      "set grid lc '#d8d8d8' lt 1 lw 0.8\nunset logscale\nset logscale y\nunset ylabel\n";
  script += "set xlabel " + quoted(clock_.label()) + "\n";
  constexpr double kLeft = 70.0, kGap = 88.0, kRight = 20.0, kBelow = 62.0, kAbove = 30.0;  // pixels
  const auto count = static_cast<double>(panels_.size());
  const double width = (size.width - kLeft - kRight - (count - 1.0) * kGap) / count;
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    const Panel& panel = panels_[p];
    const double left = kLeft + static_cast<double>(p) * (width + kGap);
    Range times, values;
    times.include(clock_.time(0.0));
    std::string plot;
    for (const Line& line : panel.lines) {
      for (const auto& point : line.points) {
        times.include(point[0]);
        values.include(point[1]);
      }
      const std::string name = fmt::format("rotation{}_{}", p, plot.size());
      script += data_block(name, line.points);
      plot += fmt::format("{}${} with lines lw 1.8 lc '{}' dt {}", plot.empty() ? "" : ", ", name,
                          color_text(line.color), line.dash);
    }
    script += place({left / size.width, (left + width) / size.width, (bottom + kBelow) / size.height,
                     (bottom + height() - kAbove) / size.height});
    script += axis("x", times, 5) + logarithmic_axis("y", values);
    script += fmt::format("set title {} offset 0,-0.6\nplot {}\n", quoted(panel.title), plot);
  }
  return script + "unset title\n";
}

}  // namespace trajet::detail
