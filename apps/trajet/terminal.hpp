#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace trajet {

bool is_terminal(std::FILE* stream);
/// Columns; 80 where the terminal does not say.
int terminal_width(std::FILE* stream);

/// Columns that a text for people may take: those of a terminal; elsewhere as many as it likes.
int text_width(std::FILE* stream);

/// Whether colours are welcome on a stream: a terminal, and NO_COLOR unset or empty (https://no-color.org).
bool wants_color(std::FILE* stream);

enum class Style { plain, bold, green, yellow, red };

/// `text` between the escape sequences of the style, or just `text` where colours are not welcome.
std::string styled(std::string_view text, Style style, bool color);

}  // namespace trajet
