#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace trajet::detail {

using Json = nlohmann::ordered_json;

/// JSON as a person would lay it out: vectors and matrices on one line, everything else one line per member.
std::string json_text(const Json& json);

}  // namespace trajet::detail
