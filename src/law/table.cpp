#include "trajet/law/table.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

namespace trajet {
namespace {

/// The slope at an end point from the slopes s0, s1 of the two nearest intervals of widths h0, h1: the parabola's
/// through the three points, limited so that the cubic stays monotone.
double end_slope(double h0, double h1, double s0, double s1) {
  const double slope = ((2.0 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
  if (slope * s0 <= 0.0) return 0.0;
  if (s0 * s1 <= 0.0 && std::abs(slope) > 3.0 * std::abs(s0)) return 3.0 * s0;
  return slope;
}

/// The slope at an inner point: a weighted harmonic mean of its neighbours', zero at an extremum [FritschButland1984].
double inner_slope(double h0, double h1, double s0, double s1) {
  if (s0 * s1 <= 0.0) return 0.0;
  const double w0 = h0 + 2.0 * h1, w1 = 2.0 * h0 + h1;
  return (w0 + w1) / (w0 / s0 + w1 / s1);
}

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

bool read_number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace

Table::Table(const std::vector<double>& x, const std::vector<double>& y) : last_(x.empty() ? 0.0 : x.back()) {
  const std::size_t n = x.size();
  if (n < 2 || y.size() != n) throw std::invalid_argument("a table needs at least two points");
  std::vector<double> width(n - 1), secant(n - 1), slope(n);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    width[i] = x[i + 1] - x[i];
    secant[i] = (y[i + 1] - y[i]) / width[i];
    if (!(width[i] > 0.0) || !std::isfinite(secant[i])) throw std::invalid_argument("the x of a table must rise");
  }
  slope.front() = n == 2 ? secant[0] : end_slope(width[0], width[1], secant[0], secant[1]);
  slope.back() = n == 2 ? secant[0] : end_slope(width[n - 2], width[n - 3], secant[n - 2], secant[n - 3]);
  for (std::size_t i = 1; i + 1 < n; ++i) slope[i] = inner_slope(width[i - 1], width[i], secant[i - 1], secant[i]);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    // Hermite's cubic: value and slope at both ends
    const double h = width[i], d0 = slope[i], d1 = slope[i + 1], s = secant[i];
    cells_.push_back({x[i], y[i], d0, (3.0 * s - 2.0 * d0 - d1) / h, (d0 + d1 - 2.0 * s) / (h * h)});
  }
}

Table Table::read(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw FileError("cannot read the table " + path);
  std::vector<double> x, y;
  int line_number = 0;
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    const std::vector<std::string_view> columns = fields(line);
    if (columns.empty()) continue;
    double first = 0.0, second = 0.0;
    const bool numbers = columns.size() == 2 && read_number(columns[0], first) && read_number(columns[1], second);
    const bool is_title = x.empty() && line_number == 1 && !numbers && !read_number(columns[0], first);
    if (is_title) continue;
    const SourceLocation place{path, line_number, 1};
    if (!numbers) throw InputError(place, "two numbers are expected on a line of a table");
    if (!x.empty() && !(first > x.back()))
      throw InputError(place, "the first column of a table must rise from line to line");
    x.push_back(first);
    y.push_back(second);
  }
  if (file.bad()) throw FileError("cannot read the table " + path);
  if (x.size() < 2) throw InputError({path, line_number, 1}, "a table needs at least two lines of numbers");
  return Table(x, y);
}

}  // namespace trajet
