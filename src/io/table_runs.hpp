#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace trajet::detail {

/// A stretch of a text.
struct TextStretch {
  std::size_t begin = 0;  ///< its offset
  std::size_t size = 0;
  int first_line = 1;  ///< the number of the line with which it begins
};

/// A TOML text of which the tables of one array are cut out, to be parsed a few at a time: the reader of TOML keeps a
/// hundred times the text.
struct TableRuns {
  std::vector<TextStretch> runs{};  ///< in the order of the text; each begins with a header `[[key]]`
  std::size_t table_count = 0;      ///< in all of them
  std::string rest{};               ///< the text with empty lines in their place
};

/// Cuts the tables `[[key]]` out of a text, with the tables within them, at most `tables_a_run` to a run. `key` is a
/// bare key. Where a text is no TOML, one of the parts is none, at the same place.
TableRuns cut_table_runs(std::string_view text, std::string_view key, std::size_t tables_a_run);

}  // namespace trajet::detail
