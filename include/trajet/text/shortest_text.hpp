#pragma once

#include <charconv>
#include <string>

namespace trajet {

/// The shortest decimal text that reads back as the same number, whatever the locale; `inf`, `-inf` and `nan` too.
inline std::string shortest_text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

}  // namespace trajet
