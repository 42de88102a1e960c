#pragma once

#include <string>
#include <string_view>

namespace trajet::detail {

/// A text as a field of CSV: between quotation marks, these doubled, where it holds what would end it (RFC 4180).
inline std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

}  // namespace trajet::detail
