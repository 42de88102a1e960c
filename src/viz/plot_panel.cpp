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

bool Range::is_constant() const {
  constexpr double kRounding = 1e-9;
  return extent() <= kRounding * std::max(std::abs(low), std::abs(high));
}

Range Range::padded() const {
  if (is_empty()) return {0.0, 1.0};
  constexpr double kRoom = 0.06;
  const double size = std::max(std::abs(low), std::abs(high));
  const double room = !is_constant() ? kRoom * extent() : size > 0.0 ? 0.5 * size : 1.0;
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
  return fmt::format("set {0}range [1e{1}:1e{2}]\nset {0}tics autofreq\nset format {0} '10^{{%T}}'\n", name,
                     std::floor(std::log10(range.low)),
                     std::max(std::ceil(std::log10(range.high)), std::floor(std::log10(range.low)) + 1.0));
}

std::string number_text(double value, int decimals) {
  const std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool is_zero = digits.find_first_not_of("0.") == std::string::npos;
  return value < 0.0 && !is_zero ? "\u2212" + digits : digits;
}

std::string short_text(double value) {
  const std::string digits = fmt::format("{:.4g}", std::abs(value));
  return value < 0.0 ? "\u2212" + digits : digits;
}

std::optional<int> mark_decimals(double step, double size) {
  constexpr double kLargest = 1e6, kSmallest = 1e-4;
  if (!(size < kLargest && step >= kSmallest)) return std::nullopt;
  return std::max(0, -static_cast<int>(std::floor(std::log10(step * (1.0 + 1e-9)))));
}

std::string axis(const std::string& name, const Range& range, int count) {
  // 1, 2 or 5 times a power of ten
  const double rough = range.extent() / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = power * (rough <= 2.0 * power ? 2.0 : rough <= 5.0 * power ? 5.0 : 10.0);
  const std::optional<int> decimals = mark_decimals(step, std::max(std::abs(range.low), std::abs(range.high)));
  return fmt::format("set {0}range [{1}:{2}]\nset {0}tics {3}\nset format {0} '{4}'\n", name, range.low, range.high,
                     step, decimals ? fmt::format("%.{}f", *decimals) : "%g");
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
