#include "table_file.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "trajet/error.hpp"
#include "trajet/text/decimal_number.hpp"

namespace trajet::detail {
namespace {

bool is_separator(char c) { return c == ',' || c == ';' || c == ' ' || c == '\t' || c == '\r'; }

/// Cuts a line into its fields. Several blanks count as one separator.
std::vector<std::string_view> fields(std::string_view line) {
  std::vector<std::string_view> result;
  std::size_t i = 0;
  while (true) {
    while (i < line.size() && is_separator(line[i])) ++i;
    if (i == line.size()) return result;
    const std::size_t begin = i;
    while (i < line.size() && !is_separator(line[i])) ++i;
    result.push_back(line.substr(begin, i - begin));
  }
}

}  // namespace

LookupTable read_table(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    throw FileError("cannot read the table '" + path + "'" +
                    (std::filesystem::exists(path) ? "" : ": there is no such file"));
  std::vector<double> x, y;
  int line_number = 0;
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    const std::vector<std::string_view> columns = fields(line);
    if (columns.empty()) continue;
    const std::optional<double> first = finite_number(columns[0]);
    const std::optional<double> second = columns.size() == 2 ? finite_number(columns[1]) : std::nullopt;
    const bool is_title = line_number == 1 && !first;
    if (is_title) continue;
    const SourceLocation place{path, line_number, 1};
    if (!first || !second) throw InputError(place, "two numbers are expected on a line of a table");
    if (!x.empty() && !(*first > x.back()))
      throw InputError(place, "the first column of a table must rise from line to line");
    x.push_back(*first);
    y.push_back(*second);
  }
  if (file.bad()) throw FileError("cannot read the table '" + path + "'");
  if (x.size() < 2) throw InputError({path, line_number, 1}, "a table needs at least two lines of numbers");
  return LookupTable(x, y);
}

}  // namespace trajet::detail
