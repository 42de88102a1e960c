#include "trajet/text/decimal_number.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <string>

namespace trajet {

namespace {

/// What a number too small or too large for a double rounds to; from_chars leaves that open.
double zero_or_infinity(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double number = 0.0;
  stream >> number;  // fails where the number is too large
  return stream.fail() ? std::copysign(std::numeric_limits<double>::infinity(), text.front() == '-' ? -1.0 : 1.0)
                       : number;
}

}  // namespace

std::optional<DecimalNumber> leading_number(std::string_view text) {
  const char* const begin = text.data();
  DecimalNumber number{0.0, 0.0, 0, false};
  const auto [end, error] = std::from_chars(begin, begin + text.size(), number.value);
  if (error == std::errc::invalid_argument) return std::nullopt;
  number.length = static_cast<std::size_t>(end - begin);
  number.is_out_of_range = error == std::errc::result_out_of_range;
  if (number.is_out_of_range) number.value = zero_or_infinity(std::string(begin, end));
  number.exact = number.value;
  if (std::isnormal(number.value)) std::from_chars(begin, end, number.exact);
  return number;
}

std::optional<double> finite_number(std::string_view text) {
  const std::optional<DecimalNumber> number = leading_number(text);
  if (!number || number->length != text.size() || number->is_out_of_range || !std::isfinite(number->value))
    return std::nullopt;
  return number->value;
}

}  // namespace trajet
