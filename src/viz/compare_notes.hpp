#pragma once

#include <functional>
#include <string>
#include <vector>

#include "row_style.hpp"
#include "trajet/study/compare.hpp"

namespace trajet::detail {

/// An error that is so many times the reference's largest component says no more than that the method has failed.
inline constexpr double kMostError = 1e3;

/// Lines at the foot of a comparison's figure, none too long for it: which rows have no result, and why; whose errors
/// are larger than `largest_error`, which the diagrams do not show. `title` names a row.
std::vector<std::string> compare_notes(const Comparison& comparison, const std::vector<RowStyle>& styles,
                                       double largest_error,
                                       const std::function<std::string(const ComparisonRow&)>& title);

/// The units that an error may have: `m`, `m, m/s`, or where the comparison does not know them `SI units`.
std::string error_unit(const Comparison& comparison);

}  // namespace trajet::detail
