#include "table_runs.hpp"

#include <algorithm>

namespace trajet::detail {

namespace {

/// The offset behind the string that begins at `i` with a quote. One that does not end ends with its line, or with the
/// text.
std::size_t end_of_string(std::string_view text, std::size_t i) {
  const char quote = text[i];
  const bool is_multi_line = text.substr(i, 3) == std::string(3, quote);
  i += is_multi_line ? 3 : 1;
  for (; i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (text[i] == '\n' && !is_multi_line) {
      return i;
    } else if (text[i] == quote && !is_multi_line) {
      return i + 1;
    } else if (text[i] == quote && text.substr(i, 3) == std::string(3, quote)) {
      i += 3;
      for (int extra = 0; extra < 2 && i < text.size() && text[i] == quote; ++extra) ++i;  // of the content
      return i;
    }
  }
  return text.size();
}

/// The offset behind the statement that begins at the line at `i`: behind the line, or where the brackets of a value
/// are open, behind the one on which they close.
std::size_t end_of_statement(std::string_view text, std::size_t i) {
  int depth = 0;
  while (i < text.size()) {
    switch (text[i]) {
      case '"':
      case '\'':
        i = end_of_string(text, i);
        continue;
      case '#':
        i = std::min(text.find('\n', i), text.size());
        continue;
      case '[':
      case '{':
        ++depth;
        break;
      case ']':
      case '}':
        --depth;
        break;
      case '\n':
        if (depth <= 0) return i + 1;
        break;
      default:
        break;
    }
    ++i;
  }
  return text.size();
}

/// What the header of a table says of the array `key`.
enum class Header {
  none,    ///< the line is no header
  other,   ///< another table begins
  table,   ///< `[[key]]`
  within,  ///< a table of one of its tables: `[key.name]`
};

Header header(std::string_view line, std::string_view key) {
  constexpr std::string_view kBlanks = " \t";
  const auto skip_blanks = [&] { line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size())); };
  skip_blanks();
  if (!line.starts_with('[')) return Header::none;
  const bool is_of_array = line.starts_with("[[");
  line.remove_prefix(is_of_array ? 2 : 1);
  skip_blanks();
  if (!line.starts_with(key)) return Header::other;
  line.remove_prefix(key.size());
  skip_blanks();
  if (line.starts_with('.')) return Header::within;
  return is_of_array && line.starts_with("]]") ? Header::table : Header::other;
}

}  // namespace

TableRuns cut_table_runs(std::string_view text, std::string_view key, std::size_t tables_a_run) {
  TableRuns result;
  std::size_t tables_in_run = 0;  // 0: outside of any
  int line = 1;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = end_of_statement(text, begin);
    const std::string_view statement = text.substr(begin, end - begin);
    const Header kind = header(statement, key);
    if (kind == Header::table) {
      if (tables_in_run == 0 || tables_in_run == tables_a_run) {
        result.runs.push_back({begin, 0, line});
        tables_in_run = 0;
      }
      ++tables_in_run;
      ++result.table_count;
    } else if (kind == Header::other) {
      tables_in_run = 0;
    }
    const auto line_count = std::count(statement.begin(), statement.end(), '\n');
    if (tables_in_run > 0) {
      result.runs.back().size += statement.size();
      result.rest.append(static_cast<std::size_t>(line_count), '\n');
    } else {
      result.rest += statement;
    }
    line += static_cast<int>(line_count);
    begin = end;
  }
  return result;
}

}  // namespace trajet::detail
