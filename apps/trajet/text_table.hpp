#pragma once

#include <string>
#include <vector>

namespace trajet {

/// Rows of cells, printed with columns as wide as their widest cell. The first row is the heading.
using TextTable = std::vector<std::vector<std::string>>;

/// The columns from `first_number` on are set to the right, the ones before to the left. UTF-8 counts by characters.
std::string format_table(const TextTable& table, std::size_t first_number = static_cast<std::size_t>(-1));

}  // namespace trajet
