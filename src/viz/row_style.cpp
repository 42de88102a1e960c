#include "row_style.hpp"

#include <algorithm>
#include <set>

#include "trajet/portable.hpp"

namespace trajet::detail {

std::vector<RowStyle> row_styles(const Comparison& comparison) {
  constexpr Color kColors[] = {0xe69f00, 0x009e73, 0xcc79a7, 0x56b4e9, 0x8c5a2b, 0x7a7a00};
  constexpr int kPoints[] = {9, 11, 13, 4, 8, 10, 12, 6, 1, 2, 3};
  constexpr Color kBlue = 0x0050c8, kBlack = 0x000000;
  std::set<std::string> methods, orientations;
  for (const ComparisonRow& row : comparison.rows) {
    methods.insert(row.method);
    orientations.insert(row.orientation);
  }
  const bool has_ways = orientations.size() > 1;

  std::vector<RowStyle> styles;
  std::size_t others = 0;
  bool has_blue = false;
  for (const ComparisonRow& row : comparison.rows) {
    if (ranges::any_of(styles, [&](const RowStyle& style) { return style.is_of(row); })) continue;
    RowStyle style{row.method, 0, 0, row.method, row.orientation};
    if (has_ways) style.name = methods.size() > 1 ? row.method + ", " + row.orientation : row.orientation;
    if (has_ways && row.orientation == "exact") {
      style.color = kReferenceColor;
      style.point = 7;
    } else if (has_ways ? !has_blue : row.method == "euler") {
      style.color = kBlue;
      style.point = 7;
      has_blue = true;
    } else if (!has_ways && row.method == "rk4") {
      style.color = kBlack;
      style.point = 5;
    } else {
      style.color = kColors[others % std::size(kColors)];
      style.point = kPoints[others++ % std::size(kPoints)];
    }
    styles.push_back(std::move(style));
  }
  return styles;
}

}  // namespace trajet::detail
