#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "trajet/error.hpp"

namespace trajet {

/// Writes to standard error. Where nobody can hear it (a full disk, a closed stream) the program goes on: its exit code
/// tells what its message cannot.
template <typename... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

/// "warning: …" and "error: …" on a line, the first word in colour where colours are welcome.
void tell_warning(const std::string& text);
void tell_error(const std::string& text);

/// Tells what is wrong: `what` begins with the place `where`, if that has a file. On a terminal the line of the source
/// follows, with a caret under the place.
void tell_fault(const std::string& what, const SourceLocation& where);

/// Where standard error is closed, points it to nowhere: no file that is opened later takes its number and gets the
/// messages.
void keep_standard_error();

}  // namespace trajet
