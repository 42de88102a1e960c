#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trajet {

/// The text without the blanks and tabs around it.
std::string_view trimmed(std::string_view text);

/// The parts of a text between separators that stand outside parentheses, brackets and quotation marks, without the
/// blanks around them.
std::vector<std::string> outer_parts(std::string_view text, char separator);

}  // namespace trajet
