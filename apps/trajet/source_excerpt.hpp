#pragma once

#include <string>
#include <string_view>

#include "trajet/error.hpp"

namespace trajet {

/// A line of a user's text as a message shows it, and below it a caret under the place.
struct SourceExcerpt {
  std::string line{};
  std::string caret{};
};

/// The line of `text` that `where` names, with its number; of a line that is wider than `width` columns, the part
/// around the place. Empty where the text has no such line.
SourceExcerpt source_excerpt(std::string_view text, const SourceLocation& where, int width);

}  // namespace trajet
