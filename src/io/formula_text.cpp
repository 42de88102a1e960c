#include "formula_text.hpp"

#include <charconv>
#include <cmath>

namespace trajet::detail {

namespace {

/// The place `offset` bytes behind `where`; unknown stays unknown.
SourceLocation advanced(SourceLocation where, std::size_t offset) {
  if (where.line > 0) where.column += static_cast<int>(offset);
  return where;
}

Expression read_quantity(const QuantityText& quantity, const SourceLocation& where, const SourceLocation& where_unit,
                         std::optional<Dimension> expected) {
  Unit unit;
  try {
    unit = parse_unit(quantity.unit);
  } catch (const InputError& error) {
    throw InputError(where_unit, error.message());
  }
  if (expected && !interchangeable(unit.dimension, *expected))
    throw InputError(where_unit, describe(*expected) + " expected, got " + describe(unit.dimension));
  const double value = quantity.number * unit.numerator / unit.denominator;
  if (!std::isfinite(value)) throw InputError(where, "the quantity is too large for a double");
  return Expression::number(value, where);
}

bool is_unit(std::string_view text) {
  try {
    parse_unit(text);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// "500m/s": a number with a unit right behind it is no expression either; say what is missing.
void refuse_missing_blank(std::string_view text, const SourceLocation& where) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end == text.data() + text.size()) return;
  const auto length = static_cast<std::size_t>(end - text.data());
  const std::string_view rest = text.substr(length);
  const bool is_name = (rest.front() >= 'a' && rest.front() <= 'z') || (rest.front() >= 'A' && rest.front() <= 'Z');
  if (is_name && is_unit(rest))
    throw InputError(advanced(where, length), "a blank is missing between number and unit, write \"" +
                                                  std::string(text.substr(0, length)) + " " + std::string(rest) + "\"");
}

}  // namespace

Expression read_formula(std::string_view text, const SourceLocation& where, std::span<const std::string> dashed_names,
                        std::optional<Dimension> expected) {
  if (const std::optional<QuantityText> quantity = split_quantity(text)) {
    const auto unit_offset = static_cast<std::size_t>(quantity->unit.data() - text.data());
    return read_quantity(*quantity, where, advanced(where, unit_offset), expected);
  }
  refuse_missing_blank(text, where);
  return Expression::parse(text, where, dashed_names);
}

}  // namespace trajet::detail
