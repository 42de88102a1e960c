#include "formula_text.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "table_file.hpp"
#include "trajet/portable.hpp"
#include "trajet/text/decimal_number.hpp"

namespace trajet::detail {

namespace {

/// The place `offset` bytes behind `where`; unknown stays unknown.
SourceLocation advanced(SourceLocation where, std::size_t offset) {
  if (where.line > 0) where.column += static_cast<int>(offset);
  return where;
}

/// The unit that a text names, if it names one.
std::optional<Unit> unit_of(std::string_view text) {
  try {
    return parse_unit(text);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "3 S" where a time is meant: the same letters in the other case, if that is a unit of the right dimension.
std::string unit_in_other_case(std::string_view unit, const Dimension& expected) {
  std::string other(unit);
  for (char& c : other) {
    if (c >= 'a' && c <= 'z') {
      c = static_cast<char>(c - 'a' + 'A');
    } else if (c >= 'A' && c <= 'Z') {
      c = static_cast<char>(c - 'A' + 'a');
    }
  }
  const std::optional<Unit> found = unit_of(other);
  return found && interchangeable(found->dimension, expected) ? "; did you mean '" + other + "'?" : "";
}

/// "3,5 s" and "3,5": what other languages write for 3.5.
void refuse_decimal_comma(std::string_view text, const SourceLocation& where) {
  std::size_t i = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  const std::size_t whole = i;
  while (i < text.size() && is_digit(text[i])) ++i;
  if (i == whole || i == text.size() || text[i] != ',') return;
  const std::size_t comma = i++;
  while (i < text.size() && is_digit(text[i])) ++i;
  if (i == comma + 1 || (i < text.size() && text[i] != ' ')) return;
  throw InputError(advanced(where, comma), "a number has a decimal point: write " + std::string(text.substr(0, comma)) +
                                               "." + std::string(text.substr(comma + 1, i - comma - 1)));
}

/// A part of a list without the blanks around it, and without the quotes that a scene file has around a quantity.
std::string_view without_quotes(std::string_view part) {
  const auto trim = [&part] {
    part.remove_prefix(std::min(part.find_first_not_of(" \t"), part.size()));
    part.remove_suffix(part.size() - std::min(part.find_last_not_of(" \t") + 1, part.size()));
  };
  trim();
  if (part.size() < 2 || part.front() != '"' || part.back() != '"') return part;
  part = part.substr(1, part.size() - 2);
  trim();
  return part;
}

/// The parts of "[a, b, c]" between brackets and commas of the outermost level; none where the text is no such list.
std::vector<std::string_view> parts_of_list(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  if (begin == std::string_view::npos || text[begin] != '[' || text[end] != ']') return {};
  std::vector<std::string_view> parts;
  int depth = 0;
  std::size_t first = begin + 1;
  for (std::size_t i = begin; i <= end; ++i) {
    if (text[i] == '[' || text[i] == '(') ++depth;
    if (text[i] == ']' || text[i] == ')') --depth;
    if (depth == 0 && i < end) return {};  // "[…] + […]"
    if (depth > 1 || (depth == 1 && text[i] != ',')) continue;
    parts.push_back(text.substr(first, i - first));
    first = i + 1;
  }
  return parts;
}

}  // namespace

void FormulaReader::add_name(std::string_view name) {
  names_.emplace_back(name);
  if (name.find('-') != std::string_view::npos) dashed_names_.emplace_back(name);
}

bool FormulaReader::is_name(std::string_view text) const { return ranges::find(names_, text) != names_.end(); }

Expression FormulaReader::quantity(const QuantityText& quantity, const SourceLocation& where,
                                   const SourceLocation& where_unit, std::optional<Dimension> expected) const {
  const std::string unit_text(quantity.unit);
  const std::string product = is_name(unit_text) ? "; for the value of " + unit_text + " write " +
                                                       std::string(quantity.number_text) + "*" + unit_text
                                                 : "";
  Unit unit;
  try {
    unit = parse_unit(quantity.unit);
  } catch (const InputError& error) {
    throw InputError(where_unit, error.message() + product);
  }
  const double value = quantity.number * unit.numerator / unit.denominator;
  const Expression result =
      Expression::quantity({value, quantity.exact_number * unit.exact_factor}, unit.dimension, where);
  if (expected) {
    const Measure measure{.kind = Measure::Kind::known,
                          .dimension = unit.dimension,
                          .is_written = true,
                          .is_frequency = unit.dimension == kFrequency};
    const std::string fault = dimension_fault(measure, *expected);
    if (!fault.empty())
      throw InputError(where_unit, fault + (product.empty() ? unit_in_other_case(quantity.unit, *expected) : product));
  }
  if (!std::isfinite(value)) throw InputError(where, "the quantity is too large for a double");
  return result;
}

/// "500m/s": a number with a unit right behind it is no expression either; say what is missing.
void FormulaReader::refuse_missing_blank(std::string_view text, const SourceLocation& where) const {
  const std::optional<DecimalNumber> number = leading_number(text);
  if (!number || number->is_out_of_range || number->length == text.size()) return;
  const std::size_t length = number->length;
  const std::string rest(text.substr(length)), digits(text.substr(0, length));
  if (!is_letter(rest.front())) return;
  if (is_name(rest))
    throw InputError(advanced(where, length),
                     "an operator is missing between number and name, write " + digits + "*" + rest);
  if (unit_of(rest))
    throw InputError(advanced(where, length),
                     "a blank is missing between number and unit, write \"" + digits + " " + rest + "\"");
}

std::optional<Expression> FormulaReader::vector_of_quantities(std::string_view text, const SourceLocation& where,
                                                              std::optional<Dimension> expected) const {
  std::vector<std::string_view> parts = parts_of_list(text);
  for (std::string_view& part : parts) part = without_quotes(part);
  const auto is_quantity = [](std::string_view part) { return split_quantity(part).has_value(); };
  if (parts.size() != 3 || ranges::none_of(parts, is_quantity)) return std::nullopt;
  const auto component = [&](std::size_t i) {
    const auto offset = static_cast<std::size_t>(parts[i].data() - text.data());
    return read(parts[i], advanced(where, offset), expected);
  };
  const Expression x = component(0);  // one after the other: the first fault is the one reported
  const Expression y = component(1);
  const Expression z = component(2);
  return Expression::vector(x, y, z);
}

Expression FormulaReader::read(std::string_view text, const SourceLocation& where,
                               std::optional<Dimension> expected) const {
  if (const std::optional<QuantityText> quantity = split_quantity(text)) {
    const auto unit_offset = static_cast<std::size_t>(quantity->unit.data() - text.data());
    return this->quantity(*quantity, where, advanced(where, unit_offset), expected);
  }
  if (std::optional<Expression> vector = vector_of_quantities(text, where, expected)) return *std::move(vector);
  refuse_decimal_comma(text, where);
  refuse_missing_blank(text, where);
  return Expression::parse(text, where, dashed_names_);
}

void FormulaReader::read_tables(const Expression& formula) {
  for (const Expression::TableUse& use : formula.tables()) {
    if (tables_.contains(use.name)) continue;
    const std::filesystem::path path = std::filesystem::path(scene_file_).parent_path() / use.name;
    try {
      tables_[use.name] = std::make_shared<const LookupTable>(read_table(path.string()));
    } catch (const FileError& error) {
      throw FileError(use.where, error.what());
    }
  }
}

}  // namespace trajet::detail
