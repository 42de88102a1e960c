#include "toml_document.hpp"

#include <algorithm>

namespace trajet::detail {

namespace {

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

}  // namespace

TomlDocument::TomlDocument(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text_.starts_with(kByteOrderMark)) text_.erase(0, kByteOrderMark.size());
  line_offsets_.push_back(0);
  for (std::size_t i = 0; i < text_.size(); ++i)
    if (text_[i] == '\n') line_offsets_.push_back(i + 1);
  try {
    root_ = toml::parse(text_, file_);
  } catch (const toml::parse_error& error) {
    throw InputError(location(error.source().begin), std::string(error.description()));
  }
}

std::size_t TomlDocument::offset(const toml::source_position& position) const {
  if (position.line < 1 || position.line > line_offsets_.size()) return text_.size();
  std::size_t offset = line_offsets_[position.line - 1];
  for (toml::source_index column = 1; column < position.column && offset < text_.size(); ++column) {
    ++offset;
    while (offset < text_.size() && continues_character(text_[offset])) ++offset;
  }
  return offset;
}

SourceLocation TomlDocument::location(const toml::source_position& position) const {
  if (position.line < 1 || position.line > line_offsets_.size()) return {file_, 1, 1};
  const std::size_t column = offset(position) - line_offsets_[position.line - 1];
  return {file_, static_cast<int>(position.line), static_cast<int>(column) + 1};
}

TomlDocument::TextLocation TomlDocument::text_location(const toml::value<std::string>& value) const {
  const std::size_t begin = offset(value.source().begin);
  const std::string_view written = std::string_view(text_).substr(begin);
  const bool multi_line = written.starts_with("\"\"\"") || written.starts_with("'''");
  const std::size_t skipped = multi_line ? (written.substr(3).starts_with('\n') ? 4 : 3) : 1;
  SourceLocation where = location(value);
  if (!written.substr(std::min(skipped, written.size())).starts_with(value.get())) return {where, false};
  if (skipped == 4) return {{file_, where.line + 1, 1}, true};
  where.column += static_cast<int>(skipped);
  return {where, true};
}

std::vector<TomlEntry> entries_in_file_order(const toml::table& table) {
  std::vector<TomlEntry> entries;
  for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
  const auto position = [](const TomlEntry& entry) {
    const toml::source_position& begin = entry.first->source().begin;
    return std::pair(begin.line, begin.column);
  };
  std::sort(entries.begin(), entries.end(),
            [&](const TomlEntry& a, const TomlEntry& b) { return position(a) < position(b); });
  return entries;
}

std::string_view type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a boolean";
    case toml::node_type::date:
    case toml::node_type::time:
    case toml::node_type::date_time:
      return "a date";
    case toml::node_type::none:
      break;
  }
  return "nothing";
}

}  // namespace trajet::detail
