#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace trajet {

/// Rows of cells, printed with columns as wide as their widest cell. The first row is the heading.
using TextTable = std::vector<std::vector<std::string>>;

struct TableLayout {
  /// The columns from here on are set to the right, the ones before to the left.
  std::size_t first_number = std::numeric_limits<std::size_t>::max();
  /// So many columns at the left tell what a row is.
  std::size_t keys = 1;
  /// Characters that a line may have. What is too wide goes below, with the keys again.
  int width = std::numeric_limits<int>::max();
};

/// UTF-8 counts by characters.
std::string format_table(const TextTable& table, const TableLayout& layout = {});

/// The lines of a text in lines of at most `width` characters, broken at blanks; what goes on begins with `indent`
/// blanks.
std::string wrap(std::string_view text, std::size_t indent, int width);

}  // namespace trajet
