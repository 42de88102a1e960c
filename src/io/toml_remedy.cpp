#include "toml_remedy.hpp"

#include <algorithm>

#include "trajet/portable.hpp"
#include "trajet/text/decimal_number.hpp"

namespace trajet::detail {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

/// The value, or the element of an array, at a place of a line: what stands between `=`, brackets, braces and commas.
/// Brackets within belong to it: "sqrt(2)".
std::string_view element_at(std::string_view line, std::size_t column) {
  const std::size_t before = line.substr(0, column).find_last_of("=[{,");
  std::string_view rest = line.substr(before == std::string_view::npos ? 0 : before + 1);
  int depth = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i] == '(') ++depth;
    if (rest[i] == ')') --depth;
    if (depth <= 0 && std::string_view(",]}#\n").find(rest[i]) != std::string_view::npos)
      return trimmed(rest.substr(0, i));
  }
  return trimmed(rest);
}

bool is_numbers_and_blanks(std::string_view text) {
  return text.find_first_not_of("0123456789+-.eE \t") == std::string_view::npos &&
         text.find_first_of(kBlanks) != std::string_view::npos;
}

/// "1 2 3" with commas.
std::string with_commas(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(kBlanks), text.size());
    result += (result.empty() ? "" : ", ") + std::string(text.substr(0, end));
    text = trimmed(text.substr(end));
  }
  return result;
}

}  // namespace

std::string toml_remedy(std::string_view line, std::size_t column, std::string_view fault) {
  const auto says = [fault](std::string_view words) { return fault.find(words) != std::string_view::npos; };
  column = std::min(column, line.size());
  if (says("existing array")) return "; write [" + std::string(trimmed(line)) + "]";
  if (says("redefine")) return {};
  if (says("expected '='")) return "; a key and its value are joined by '='";
  if (ranges::count(line, '"') % 2 == 1) return "; the closing quote is missing";
  const std::string_view element = element_at(line, column);
  if (element.empty() || element.front() == '"' || element.front() == '\'') return {};
  const std::string text(element);
  if (says("saw ','") && finite_number(element)) {
    const std::string_view digits = element_at(line, column + 1);
    return finite_number(digits) ? "; a number has a decimal point: write " + text + "." + std::string(digits) : "";
  }
  if (element.front() == '(' && element.back() == ')' && element.find(',') != std::string_view::npos)
    return "; a vector stands in brackets: [" + text.substr(1, text.size() - 2) + "]";
  if (is_numbers_and_blanks(element)) return "; commas stand between numbers: " + with_commas(element);
  if (element.front() == '.') return "; write 0" + text;
  if (element.back() == '.') return "; write " + text + "0";
  if (finite_number(element)) return {};
  return "; a formula or a quantity stands in quotes: \"" + text + "\"";
}

}  // namespace trajet::detail
