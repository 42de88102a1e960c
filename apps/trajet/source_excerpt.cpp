#include "source_excerpt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace trajet {
namespace {

/// The line of that number, from 1, without its end.
std::string_view line_of(std::string_view text, int number) {
  for (int line = 1; line < number; ++line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (number == 1 && text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text.substr(0, text.find_first_of("\r\n"));
}

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// The characters of a line, and which of them holds the byte `column`, from 1. What a terminal does not print becomes
/// a blank, so that each takes one column.
struct Characters {
  Characters(std::string_view line, int column) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto byte = static_cast<unsigned char>(line[i]);
      if (!continues_character(line[i]) || all.empty())
        all.emplace_back(1, byte < 0x20U || byte == 0x7fU ? ' ' : line[i]);
      else
        all.back() += line[i];
      if (static_cast<int>(i) < column) marked = all.size() - 1;
    }
    if (static_cast<std::size_t>(column) > line.size()) marked = all.size();
  }
  std::vector<std::string> all{};
  std::size_t marked = 0;
};

}  // namespace

SourceExcerpt source_excerpt(std::string_view text, const SourceLocation& where, int width) {
  const std::string_view line = line_of(text, where.line);
  if (line.empty()) return {};
  const Characters characters(line, where.column);
  const std::string margin = fmt::format("{:>5} | ", where.line);
  const std::size_t room =
      static_cast<std::size_t>(width) > margin.size() + 1 ? static_cast<std::size_t>(width) - margin.size() : 1;
  const std::size_t first = characters.marked < room ? 0 : characters.marked - room / 2;
  SourceExcerpt excerpt{margin, std::string(margin.size() - 2, ' ') + "| "};
  for (std::size_t i = first; i < std::min(characters.all.size(), first + room); ++i) excerpt.line += characters.all[i];
  excerpt.caret += std::string(characters.marked - first, ' ') + "^";
  return excerpt;
}

}  // namespace trajet
