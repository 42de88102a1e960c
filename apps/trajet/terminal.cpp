#include "terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <limits>

namespace trajet {

bool is_terminal(std::FILE* stream) { return isatty(fileno(stream)) != 0; }

int terminal_width(std::FILE* stream) {
  constexpr int kUsual = 80;
  winsize size{};
  return ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kUsual;
}

int text_width(std::FILE* stream) {
  return is_terminal(stream) ? terminal_width(stream) : std::numeric_limits<int>::max();
}

bool wants_color(std::FILE* stream) {
  const char* no_color = std::getenv("NO_COLOR");
  return (no_color == nullptr || *no_color == '\0') && is_terminal(stream);
}

std::string styled(std::string_view text, Style style, bool color) {
  if (!color || style == Style::plain) return std::string(text);
  const char* begin = style == Style::bold     ? "\033[1m"
                      : style == Style::green  ? "\033[32m"
                      : style == Style::yellow ? "\033[33m"
                                               : "\033[31m";
  return begin + std::string(text) + "\033[0m";
}

}  // namespace trajet
