#include "plot_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trajet::detail {

void Range::include(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

Range Range::padded() const {
  if (is_empty()) return {0.0, 1.0};
  constexpr double kRoom = 0.06;
  const double size = std::max(std::abs(low), std::abs(high));
  // rounding of a constant is no variation
  const double room = extent() > 1e-9 * size ? kRoom * extent() : size > 0.0 ? 0.5 * size : 1.0;
  return {low - room, high + room};
}

std::string place(const Frame& frame) {
  return fmt::format(
      "set origin 0,0\nset size 1,1\nset lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset bmargin at screen "
      "{:.4f}\nset tmargin at screen "
      "{:.4f}\n",
      frame.left, frame.right, frame.bottom, frame.top);
}

std::string logarithmic_axis(const std::string& name, const Range& range) {
  return fmt::format("set {0}range [1e{1}:1e{2}]\nset {0}tics autofreq\n", name, std::floor(std::log10(range.low)),
                     std::max(std::ceil(std::log10(range.high)), std::floor(std::log10(range.low)) + 1.0));
}

std::string axis(const std::string& name, const Range& range, int count) {
  // 1, 2 or 5 times a power of ten
  const double rough = range.extent() / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = power * (rough <= 2.0 * power ? 2.0 : rough <= 5.0 * power ? 5.0 : 10.0);
  return fmt::format("set {0}range [{1}:{2}]\nset {0}tics {3}\n", name, range.low, range.high, step);
}

std::string data_block(const std::string& name, const std::vector<std::vector<double>>& rows) {
  std::string text = "$" + name + " << EOD\n";
  for (const std::vector<double>& row : rows) {
    const char* separator = "";
    for (const double value : row) {
      text += fmt::format("{}{:.7g}", separator, value);
      separator = " ";
    }
    text += "\n";
  }
  return text + "EOD\n";
}

}  // namespace trajet::detail
