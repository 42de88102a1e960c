#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "loopback_server.hpp"
#include "run_monitor.hpp"
#include "trajet/io/output_file.hpp"
#include "view_page.hpp"

namespace trajet {

namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The page of a scene as its file is now.
class LivePage {
 public:
  explicit LivePage(const ViewArguments& arguments) : arguments_(arguments) {}

  /// Looks at the file, and makes the page anew if it has changed.
  void update() {
    std::error_code missing;
    const auto written = std::filesystem::last_write_time(arguments_.scene, missing);
    if (version_ > 0 && written == written_) return;
    written_ = written;
    ++version_;
    PageOptions options;
    options.is_live = true;
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
  std::filesystem::file_time_type written_;
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
