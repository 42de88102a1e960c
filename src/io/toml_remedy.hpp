#pragma once

#include <string>
#include <string_view>

namespace trajet::detail {

/// What to write instead where a line of a scene is no TOML: "; a formula stands in quotes: \"v0\"". `column` is the
/// byte of the fault in the line, from 0; `fault` what the reader of TOML says of it. Empty where nothing is likely.
std::string toml_remedy(std::string_view line, std::size_t column, std::string_view fault);

}  // namespace trajet::detail
