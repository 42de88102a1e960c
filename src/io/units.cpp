#include "trajet/io/units.hpp"

#include <algorithm>
#include <string>

#include "trajet/text/decimal_number.hpp"

namespace trajet {

namespace {

constexpr std::string_view kOperators = "+-*/^<>=!&|,()[]";

bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

std::optional<QuantityText> split_quantity(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  const char* const begin = text.data();
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (text.empty() || (text.front() != '.' && (text.front() < '0' || text.front() > '9'))) return std::nullopt;

  const std::optional<DecimalNumber> number = leading_number(text);
  if (!number) return std::nullopt;
  QuantityText quantity{.number = number->value, .exact_number = number->exact};
  if (negative) {
    quantity.number = -quantity.number;
    quantity.exact_number = -quantity.exact_number;
  }
  quantity.unit = text.substr(number->length);
  quantity.number_text = std::string_view(begin, static_cast<std::size_t>(quantity.unit.data() - begin));

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
