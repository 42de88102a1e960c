#include "compare_notes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "trajet/portable.hpp"

namespace trajet::detail {

namespace {

constexpr std::size_t kMostNotes = 8;
/// Characters of a line, and lines of a note: what is longer is told by the table of the comparison.
constexpr std::size_t kLongestLine = 130;
constexpr int kMostLines = 3;

/// Adds a text as lines that break at blanks.
void add_lines(std::vector<std::string>& lines, std::string text) {
  for (int count = 1; text.size() > kLongestLine; ++count) {
    const std::size_t blank = text.rfind(' ', kLongestLine);
    if (blank == std::string::npos || text.find_first_not_of(' ') > blank) break;
    lines.push_back(text.substr(0, blank));
    if (count == kMostLines) {
      lines.back() += " …";
      return;
    }
    text = "    " + text.substr(blank + 1);
  }
  lines.push_back(std::move(text));
}

}  // namespace

std::vector<std::string> compare_notes(const Comparison& comparison, const std::vector<RowStyle>& styles,
                                       double largest_error,
                                       const std::function<std::string(const ComparisonRow&)>& title) {
  std::vector<std::string> texts;
  for (const ComparisonRow& row : comparison.rows) {
    if (!row.succeeded()) {
      const auto style = ranges::find_if(styles, [&](const RowStyle& each) { return each.is_of(row); });
      const auto has_same = [&](const ComparisonRow& other) {
        return style->is_of(other) && !other.succeeded() && other.failure == row.failure;
      };
      const auto first = ranges::find_if(comparison.rows, has_same);
      if (&*first != &row) continue;  // a method fails of one cause with all its steps
      const bool is_alone = std::find_if(first + 1, comparison.rows.end(), has_same) == comparison.rows.end();
      texts.push_back((is_alone ? title(row) : style->name) + ": no result: " + row.failure);
    } else if (row.at_samples.state && !(*row.at_samples.state <= largest_error)) {
      texts.push_back(fmt::format("{}: an error of {:.2g}, beyond the diagrams", title(row), *row.at_samples.state));
    }
  }
  const std::size_t count = texts.size();
  if (count > kMostNotes) {
    texts.resize(kMostNotes - 1);
    texts.push_back(
        fmt::format("and {} more of this kind: the table of the comparison has them all", count - texts.size()));
  }
  std::vector<std::string> lines;
  for (std::string& text : texts) add_lines(lines, std::move(text));
  return lines;
}

std::string error_unit(const Comparison& comparison) {
  std::vector<std::string> units;
  for (const std::string& component : comparison.components) {
    const std::size_t dot = component.rfind('.');
    const std::string part = dot == std::string::npos ? "" : component.substr(dot);
    if (part != ".r" && part != ".v") return "SI units";
    units.emplace_back(part == ".r" ? "m" : "m/s");
  }
  ranges::sort(units);
  units.erase(std::unique(units.begin(), units.end()), units.end());
  return fmt::format("{}", fmt::join(units, ", "));
}

}  // namespace trajet::detail
