#pragma once

#include <cstddef>
#include <string_view>

namespace trajet {

/// Names are letters of any script, digits and `_`, the first one no digit. Beyond ASCII a letter is what starts a name
/// in XML 1.0, 2.3, but for raised and lowered digits; texts are UTF-8.
///
/// The length in bytes of the letter with which a text begins; 0 if it begins with none.
std::size_t letter_length(std::string_view text);
/// The same of a letter, digit or combining mark: what may follow in a name.
std::size_t name_character_length(std::string_view text);
/// The same of the name with which a text begins.
std::size_t name_length(std::string_view text);

}  // namespace trajet
