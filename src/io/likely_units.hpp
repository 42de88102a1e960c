#pragma once

#include <string>
#include <string_view>

namespace trajet::detail {

/// `; did you mean nautical_mile?` for a name that is no unit here, or one that says something else than it seems to;
/// empty where nothing is near.
std::string likely_unit(std::string_view name);

}  // namespace trajet::detail
