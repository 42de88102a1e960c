#include "message.hpp"

#include <fcntl.h>
#include <unistd.h>

#include "scene_source.hpp"
#include "source_excerpt.hpp"
#include "terminal.hpp"

namespace trajet {

void tell_warning(const std::string& text) {
  tell("{} {}\n", styled("warning:", Style::yellow, wants_color(stderr)), text);
}

void tell_error(const std::string& text) { tell("{} {}\n", styled("error:", Style::red, wants_color(stderr)), text); }

void tell_fault(const std::string& what, const SourceLocation& where) {
  constexpr std::string_view kError = "error: ";
  const bool has_place = !where.file.empty() || where.line > 0;
  const std::size_t place = has_place ? what.find(kError) : what.starts_with(kError) ? 0 : std::string::npos;
  if (place == std::string::npos) return tell_error(what);
  const bool color = wants_color(stderr);
  tell("{}{} {}\n", styled(std::string_view(what).substr(0, place), Style::bold, color),
       styled("error:", Style::red, color), std::string_view(what).substr(place + kError.size()));
  if (where.line == 0 || !is_terminal(stderr)) return;
  const SourceExcerpt excerpt = source_excerpt(text_of(where.file), where, terminal_width(stderr));
  if (!excerpt.line.empty()) tell("{}\n{}\n", excerpt.line, styled(excerpt.caret, Style::red, color));
}

void keep_standard_error() {
  if (fcntl(STDERR_FILENO, F_GETFD) != -1) return;
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere < 0 || nowhere == STDERR_FILENO) return;
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

}  // namespace trajet
