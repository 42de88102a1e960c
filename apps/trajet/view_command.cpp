#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "commands.hpp"
#include "run_monitor.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/io/report_json.hpp"
#include "trajet/io/scene_file.hpp"
#include "trajet/sim/run.hpp"
#include "trajet/viz/page.hpp"

namespace trajet {

namespace {

/// A new folder in the system's one for temporary files.
std::filesystem::path make_temporary_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "trajet-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw FileError("cannot create a folder for the page: " + pattern);
  return pattern;
}

/// Opens a page in the user's browser, if the system knows one; whether it could.
bool open_in_browser(const std::string& address) {
  const bool has_display = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  if (!has_display) return false;
  const pid_t child = fork();
  if (child == 0) {
    execlp("xdg-open", "xdg-open", address.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

int view_command(const ViewArguments& arguments) {
  if (!page_unavailable().empty()) throw FileError(page_unavailable());
  Scene scene = read_scene(arguments.scene);
  apply(arguments.overrides, scene);
  check(scene);

  std::deque<MotionRecord> motions;  // a deque: pages refer to its elements
  std::vector<PageRun> runs;
  RunStatus status = RunStatus::finished;
  const auto add_run = [&](const Scene& variant) {
    MotionRecord& motion = motions.emplace_back();
    RunMonitor monitor({&motion});
    const RunResult result = run(variant, &monitor);
    if (result.status == RunStatus::failed) fmt::print(stderr, "error: {}\n", result.failure);
    runs.push_back({motion, report_json(result)});
    return result.status;
  };
  status = add_run(scene);
  for (const std::string& method : arguments.methods) {
    Scene variant = scene;
    SceneOverrides overrides;
    overrides.method = method;
    apply(overrides, variant);
    add_run(variant);
  }

  std::string path = arguments.out;
  if (path.empty()) path = make_temporary_folder() / std::filesystem::path(arguments.scene).stem().concat(".html");
  OutputFile file(path);
  file.write(page_html(runs));
  file.finish();
  const bool is_open = !arguments.no_open && path != "-" && open_in_browser(path);
  if (!arguments.quiet && path != "-") {
    OutputFile out("-");
    out.write(fmt::format("{}{}\n", path, is_open ? "" : ": open it in a browser"));
    out.finish();
  }
  return exit_code(status);
}

}  // namespace trajet
