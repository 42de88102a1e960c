#pragma once

#include <string>
#include <string_view>

namespace trajet::detail {

/// What to write for a function that other languages have, ": write log(x)"; empty for any other word.
std::string remedy_for_function(std::string_view name);

/// What to write for a constant or a unit that other languages have in formulas; empty for any other word.
std::string remedy_for_name(std::string_view name);

}  // namespace trajet::detail
