#pragma once

#include <string>
#include <vector>

#include "drawing.hpp"
#include "trajet/study/compare.hpp"

namespace trajet::detail {

inline constexpr Color kReferenceColor = 0xd01010;

/// What rows of a comparison that differ in their steps or tolerances alone have in common: method and way of carrying
/// orientations.
struct RowStyle {
  std::string name;
  Color color;
  int point;  // gnuplot's point type

  bool is_of(const ComparisonRow& row) const { return row.method == method && row.orientation == orientation; }
  std::string method, orientation;
};

/// The styles of all rows, in their order.
///
/// The course's colours: blue for `euler`, black for `rk4`; where ways of carrying orientations are compared, red for
/// the closed form and blue for the first other one. Else a palette that colour-blind eyes can tell apart
/// [OkabeIto2008]; the point types do the rest.
std::vector<RowStyle> row_styles(const Comparison& comparison);

}  // namespace trajet::detail
