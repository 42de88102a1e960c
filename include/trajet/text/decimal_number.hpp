#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "trajet/portable.hpp"

namespace trajet {

/// A decimal number as a text has it at its begin.
struct DecimalNumber {
  double value;        ///< the nearest double; 0 or infinity where it is out of range
  Extended exact;      ///< with the digits that a double loses
  std::size_t length;  ///< of its text
  bool is_out_of_range;
};

/// Reads digits, a point and an exponent, whatever the locale; a minus, no plus; `inf` and `nan` too. Nothing where the
/// text begins with no number.
std::optional<DecimalNumber> leading_number(std::string_view text);

/// The finite number that is the whole text, or nothing.
std::optional<double> finite_number(std::string_view text);

}  // namespace trajet
