#include "json_text.hpp"

#include <algorithm>

#include "trajet/portable.hpp"

namespace trajet::detail {

namespace {

/// Whether a value stands on one line: numbers, strings, and arrays of them.
bool is_short(const Json& json) {
  if (!json.is_structured() || json.empty()) return true;
  return json.is_array() &&
         ranges::none_of(json, [](const Json& item) { return item.is_object() || item.is_string(); });
}

void append(std::string& text, const Json& json, std::size_t indent) {
  if (is_short(json)) {
    // A file name may hold bytes that are no UTF-8.
    text += json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return;
  }
  text += json.is_object() ? "{" : "[";
  const char* separator = "\n";
  for (const auto& [key, value] : json.items()) {
    text += separator + std::string(indent + 2, ' ');
    if (json.is_object()) text += Json(key).dump() + ": ";
    append(text, value, indent + 2);
    separator = ",\n";
  }
  text += "\n" + std::string(indent, ' ') + (json.is_object() ? "}" : "]");
}

}  // namespace

std::string json_text(const Json& json) {
  std::string text;
  append(text, json, 0);
  return text + "\n";
}

}  // namespace trajet::detail
