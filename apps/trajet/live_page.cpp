#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "loopback_server.hpp"
#include "run_monitor.hpp"
#include "scene_source.hpp"
#include "trajet/io/output_file.hpp"
#include "view_page.hpp"

namespace trajet {

namespace {

/// The page of a scene as its file is now.
class LivePage {
 public:
  explicit LivePage(const ViewArguments& arguments) : arguments_(arguments) {}

  /// Looks at the file, and makes the page anew if it has changed.
  void update() {
    // An editor that empties the file and then fills it may do both within one tick of the file's time.
    std::error_code missing;
    const std::pair state(std::filesystem::last_write_time(arguments_.scene, missing),
                          std::filesystem::file_size(arguments_.scene, missing));
    if (version_ > 0 && state == state_) return;
    state_ = state;
    ++version_;
    PageOptions options;
    options.live_version = version_;
    try {
      html_ = make_view_page(arguments_, options).html;
    } catch (const InputError& error) {
      html_ = error_page_html(error, text_of(error.where().file), options);
    } catch (const FileError& error) {
      html_ = error_page_html(InputError({}, error.what()), {}, options);
    }
    // A run takes Ctrl-C for itself; here it ends the program.
    let_signals_end_program();
  }

  const std::string& html() const { return html_; }
  std::string version() const { return std::to_string(version_); }

 private:
  const ViewArguments& arguments_;
  std::pair<std::filesystem::file_time_type, std::uintmax_t> state_;  // of the scene's file
  long version_ = 0;
  std::string html_;
};

}  // namespace

void serve_live_page(const ViewArguments& arguments) {
  LoopbackServer server;
  LivePage page(arguments);
  page.update();
  const bool is_open = !arguments.no_open && open_in_browser(server.address());
  OutputFile out("-");
  out.write(fmt::format("{}{}; Ctrl-C ends\n", server.address(), is_open ? "" : ": open it in a browser"));
  out.finish();
  server.serve([&](const std::string& path) -> Answer {
    page.update();
    if (path == "/") return {page.html(), "text/html; charset=utf-8"};
    if (path == "/version") return {page.version(), "text/plain; charset=utf-8"};
    return {};
  });
}

}  // namespace trajet
