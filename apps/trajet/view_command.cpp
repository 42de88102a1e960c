#include <fmt/format.h>
#include <stdlib.h>

#include <filesystem>

#include "output_names.hpp"
#include "trajet/io/output_file.hpp"
#include "view_page.hpp"

namespace trajet {

namespace {

/// A new folder in the system's one for temporary files.
std::filesystem::path make_temporary_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "trajet-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw FileError("cannot create a folder for the page: " + pattern);
  return pattern;
}

}  // namespace

int view_command(const ViewArguments& arguments) {
  if (!page_unavailable().empty()) throw FileError(page_unavailable());
  if (arguments.watch) {
    if (!arguments.out.empty()) throw InputError({"--watch"}, "the page is served, not written: leave out --out");
    serve_live_page(arguments);
  }
  check_outputs(arguments.scene, {{"--out", arguments.out, {".html", ".htm"}}});
  const ViewPage page = make_view_page(arguments, {});
  std::string path = arguments.out;
  if (path.empty()) path = make_temporary_folder() / std::filesystem::path(arguments.scene).stem().concat(".html");
  OutputFile file(path);
  file.write(page.html);
  file.finish();
  const bool is_open = !arguments.no_open && path != "-" && open_in_browser(path);
  if (!arguments.quiet && path != "-") {
    OutputFile out("-");
    out.write(fmt::format("{}{}\n", path, is_open ? "" : ": open it in a browser"));
    out.finish();
  }
  return exit_code(page.status);
}

}  // namespace trajet
