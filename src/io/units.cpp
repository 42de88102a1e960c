#include "trajet/io/units.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <string>

namespace trajet {

namespace {

constexpr std::string_view kOperators = "+-*/^<>=!&|,()[]";

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// What a number too small or too large for a double rounds to.
double zero_or_infinity(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double number = 0.0;
  stream >> number;  // fails where the number is too large
  return stream.fail() ? std::numeric_limits<double>::infinity() : number;
}

}  // namespace

std::optional<QuantityText> split_quantity(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  const char* const begin = text.data();
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (text.empty() || (text.front() != '.' && (text.front() < '0' || text.front() > '9'))) return std::nullopt;

  QuantityText quantity;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), quantity.number);
  if (error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) quantity.number = zero_or_infinity(std::string(text.data(), end));
  quantity.exact_number = quantity.number;
  if (std::isnormal(quantity.number)) std::from_chars(text.data(), text.data() + text.size(), quantity.exact_number);
  if (negative) {
    quantity.number = -quantity.number;
    quantity.exact_number = -quantity.exact_number;
  }
  quantity.number_text = std::string_view(begin, static_cast<std::size_t>(end - begin));

  quantity.unit = text.substr(static_cast<std::size_t>(end - text.data()));
  if (quantity.unit.empty() || !is_blank(quantity.unit.front())) return std::nullopt;
  while (is_blank(quantity.unit.front())) quantity.unit.remove_prefix(1);
  if (kOperators.find(quantity.unit.front()) != std::string_view::npos) return std::nullopt;
  for (const std::string_view word : {"and", "or"}) {
    const std::string_view rest = quantity.unit.substr(std::min(word.size(), quantity.unit.size()));
    if (quantity.unit.starts_with(word) && !rest.empty() && (is_blank(rest.front()) || rest.front() == '('))
      return std::nullopt;
  }
  return quantity;
}

}  // namespace trajet
