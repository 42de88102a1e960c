#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace trajet::detail {

/// The extent of what a panel shows along one axis.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value);
  bool is_empty() const { return !(low <= high); }
  double extent() const { return is_empty() ? 0.0 : high - low; }
  /// What varies by rounding alone, against its size.
  bool is_constant() const;
  /// With some room on both sides, so that no line lies on the frame. What hardly varies gets a range of its own size.
  Range padded() const;
};

/// A rectangle of the figure, in parts of its width and height from the lower left corner: the frame of a panel.
struct Frame {
  double left, right, bottom, top;
};

/// The lines that place the next plot.
std::string place(const Frame& frame);

/// A number as a label: that many digits behind the point, and a minus that is no hyphen.
std::string number_text(double value, int decimals);

/// A number in a sentence: four digits at most, and such a minus.
std::string short_text(double value);

/// How many digits behind the point tell marks apart that lie `step` from each other, on an axis whose numbers are not
/// larger than `size`; none where the numbers want powers of ten.
std::optional<int> mark_decimals(double step, double size);

/// `set xrange [a:b]` for axis "x", and marks on the axis so far apart that about `count` fit.
std::string axis(const std::string& name, const Range& range, int count);

/// The same with a logarithmic scale, over whole decades. The range is positive.
std::string logarithmic_axis(const std::string& name, const Range& range);

/// Rows of numbers as a data block `$name`. An empty row interrupts the line.
std::string data_block(const std::string& name, const std::vector<std::vector<double>>& rows);

}  // namespace trajet::detail
