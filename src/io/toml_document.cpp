#include "toml_document.hpp"

#include <algorithm>

#include "toml_remedy.hpp"
#include "trajet/portable.hpp"
#include "trajet/text/decimal_number.hpp"

namespace trajet::detail {

namespace {

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

/// The length of the line end with which a text begins, 0 if it does not.
std::size_t line_end_length(std::string_view text) {
  return text.starts_with("\r\n") ? 2 : text.starts_with('\n') ? 1 : 0;
}

/// An escape sequence of a TOML string: its length, and the number of bytes of the content that it stands for.
struct Escape {
  std::size_t length;
  std::size_t bytes;
};

/// The escape sequence with which `written` begins; `first` is the byte of the content that comes next.
Escape escape_at(std::string_view written, char first) {
  const char kind = written.size() > 1 ? written[1] : ' ';
  if (kind == 'u' || kind == 'U') {
    const auto lead = static_cast<unsigned char>(first);
    return {kind == 'u' ? 6U : 10U, lead < 0x80 ? 1U : lead < 0xe0 ? 2U : lead < 0xf0 ? 3U : 4U};
  }
  constexpr std::string_view kBlanks = " \t\r\n";
  if (kBlanks.find(kind) == std::string_view::npos) return {2, 1};
  // the line goes on behind the blanks
  const std::size_t end = written.find_first_not_of(kBlanks, 1);
  return {end == std::string_view::npos ? written.size() : end, 0};
}

}  // namespace

TomlDocument::TomlDocument(std::string_view text, TextName file, int first_line)
    : text_(text), file_(std::move(file)), first_line_(first_line) {
  line_offsets_.push_back(0);
  for (std::size_t i = 0; i < text_.size(); ++i)
    if (text_[i] == '\n') line_offsets_.push_back(i + 1);
  try {
    root_ = toml::parse(text_);
  } catch (const toml::parse_error& error) {
    const SourceLocation where = location(error.source().begin);
    const std::string_view line = text_.substr(line_offsets_[static_cast<std::size_t>(where.line - first_line_)]);
    // "Error while parsing string: …", after whose colon stands what is wrong
    std::string fault(error.description());
    constexpr std::string_view kHead = "Error while parsing ";
    if (fault.starts_with(kHead)) fault = "this is no TOML: " + fault.substr(kHead.size());
    throw InputError(
        where, fault + toml_remedy(line.substr(0, line.find('\n')), static_cast<std::size_t>(where.column) - 1, fault));
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
  if (position.line < 1 || position.line > line_offsets_.size()) return {file_, first_line_, 1};
  const std::size_t column = offset(position) - line_offsets_[position.line - 1];
  return {file_, first_line_ + static_cast<int>(position.line) - 1, static_cast<int>(column) + 1};
}

Extended TomlDocument::exact_number(const toml::node& node, double number) const {
  const std::string_view written = text_.substr(offset(node.source().begin));
  std::string digits;
  for (const char c : written.substr(0, written.find_first_not_of("0123456789+-.eE_")))
    if (c != '_' && !(c == '+' && digits.empty())) digits += c;
  const std::optional<DecimalNumber> read = leading_number(digits);
  return read && read->length == digits.size() && read->value == number ? read->exact : Extended(number);
}

std::vector<TextPosition> TomlDocument::content_positions(const toml::value<std::string>& value) const {
  const std::string& content = value.get();
  const std::size_t begin = offset(value.source().begin);
  const std::string_view written = text_.substr(begin);
  const bool is_multi_line = written.starts_with("\"\"\"") || written.starts_with("'''");
  const bool has_escapes = written.starts_with('"');
  std::size_t i = is_multi_line ? 3 : 1;
  if (is_multi_line) i += line_end_length(written.substr(i));

  std::vector<TextPosition> positions;
  const SourceLocation start = location(value);
  TextPosition position{start.line, start.column};
  std::size_t counted = 0;
  const auto here = [&] {
    for (; counted < i; ++counted) {
      ++position.column;
      if (written[counted] == '\n') position = {position.line + 1, 1};
    }
    return position;
  };
  while (positions.size() < content.size() && i < written.size()) {
    std::size_t bytes = 1;
    std::size_t length = 1;
    if (has_escapes && written[i] == '\\') {
      const Escape escape = escape_at(written.substr(i), content[positions.size()]);
      bytes = escape.bytes;
      length = escape.length;
    } else if (written[i] == '\r' && content[positions.size()] == '\n') {
      length = line_end_length(written.substr(i));
    }
    positions.insert(positions.end(), bytes, here());
    i += length;
  }
  positions.resize(content.size(), here());
  positions.push_back(here());
  return positions;
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
