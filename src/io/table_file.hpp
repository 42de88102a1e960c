#pragma once

#include <string>

#include "trajet/law/lookup_table.hpp"

namespace trajet::detail {

/// Reads two columns of numbers, separated by comma, semicolon or blanks, after an optional line of titles.
/// Throws FileError if the file cannot be read, InputError that points into it if it is wrong.
LookupTable read_table(const std::string& path);

}  // namespace trajet::detail
