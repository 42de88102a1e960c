#pragma once

#include <string>

#include "commands.hpp"
#include "trajet/viz/page.hpp"

namespace trajet {

struct ViewPage {
  std::string html;
  RunStatus status = RunStatus::finished;  ///< of the scene's own method; `interrupted` if any run was
};

/// Runs the scene by its own method and by the further ones, and shows the runs on a page.
/// Throws InputError where the scene is wrong, FileError where a file cannot be read.
ViewPage make_view_page(const ViewArguments& arguments, const PageOptions& options);

/// Tells the user of the size of a page with which a browser will have trouble.
void warn_of_large_page(std::size_t bytes);

/// Opens a page in the user's browser, if the system knows one; whether it could.
bool open_in_browser(const std::string& address);

/// Serves the page on the loopback interface, made anew whenever the scene file changes, until the program is ended.
/// Throws FileError where it cannot.
[[noreturn]] void serve_live_page(const ViewArguments& arguments);

}  // namespace trajet
