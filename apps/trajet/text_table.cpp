#include "text_table.hpp"

#include <algorithm>

#include "trajet/portable.hpp"

namespace trajet {

namespace {

constexpr std::size_t kGap = 2;  // blanks before each column

/// Characters of a UTF-8 text: all bytes but those that continue one.
std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(
      ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::vector<std::size_t> widths_of(const TextTable& table) {
  std::vector<std::size_t> widths(table.front().size());
  for (const auto& row : table)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], characters(row[i]));
  return widths;
}

using Columns = std::vector<std::size_t>;

/// Which columns stand side by side: all, or the keys with as many others as there is room for, at least one.
std::vector<Columns> blocks_of(const std::vector<std::size_t>& widths, const TableLayout& layout) {
  std::vector<Columns> blocks(1);
  std::size_t used = 0;
  const auto add = [&](std::size_t column) {
    blocks.back().push_back(column);
    used += kGap + widths[column];
  };
  const std::size_t keys = std::min(layout.keys, widths.size());
  const auto add_keys = [&] {
    for (std::size_t i = 0; i < keys; ++i) add(i);
  };
  add_keys();
  for (std::size_t i = keys; i < widths.size(); ++i) {
    if (used + kGap + widths[i] > static_cast<std::size_t>(layout.width) && blocks.back().size() > keys) {
      blocks.emplace_back();
      used = 0;
      add_keys();
    }
    add(i);
  }
  return blocks;
}

std::string wrap_line(std::string_view line, std::size_t indent, std::size_t width) {
  std::string text;
  std::string lead;
  while (true) {
    const std::size_t room = width - std::min(lead.size(), width);
    std::size_t end = line.size();
    while (characters(line.substr(0, end)) > room) {
      const std::size_t blank = line.substr(0, end).find_last_of(' ');
      if (blank == std::string_view::npos || line.find_first_not_of(' ') > blank) break;  // a word of that length stays
      end = line.find_last_not_of(' ', blank) + 1;
    }
    text += lead + std::string(line.substr(0, end)) + "\n";
    const std::size_t next = line.find_first_not_of(' ', end);
    if (next == std::string_view::npos) return text;
    line.remove_prefix(next);
    lead.assign(indent, ' ');
  }
}

}  // namespace

std::string format_table(const TextTable& table, const TableLayout& layout) {
  const std::vector<std::size_t> widths = widths_of(table);
  std::string text;
  for (const Columns& columns : blocks_of(widths, layout)) {
    if (!text.empty()) text += "\n";
    for (const auto& row : table) {
      std::string line;
      for (const std::size_t i : columns) {
        const std::string padding(widths[i] - characters(row[i]), ' ');
        line += std::string(kGap, ' ') + (i < layout.first_number ? row[i] + padding : padding + row[i]);
      }
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + "\n";
    }
  }
  return text;
}

std::string wrap(std::string_view text, std::size_t indent, int width) {
  std::string wrapped;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    wrapped += wrap_line(text.substr(0, end), indent, static_cast<std::size_t>(width));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return wrapped;
}

}  // namespace trajet
