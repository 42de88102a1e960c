#include "view_page.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <deque>

#include "message.hpp"
#include "run_monitor.hpp"
#include "scene_source.hpp"
#include "trajet/io/report_json.hpp"
#include "trajet/portable.hpp"
#include "trajet/sim/observer_list.hpp"
#include "trajet/sim/run.hpp"

namespace trajet {

ViewPage make_view_page(const ViewArguments& arguments, const PageOptions& options) {
  Scene scene = read_named_scene(arguments.scene);
  apply(arguments.overrides, scene);
  check(scene);

  std::deque<MotionRecord> motions;  // a deque: pages refer to its elements
  std::vector<PageRun> runs;
  const auto add_run = [&](const Scene& variant) {
    MotionRecord& motion = motions.emplace_back();
    RunMonitor monitor;
    ObserverList observers({&motion, &monitor});
    const RunResult result = run(variant, &observers);
    if (result.status == RunStatus::failed) tell_error(result.method + ": " + result.failure);
    runs.push_back({motion, [text = report_json(result)](const auto& write) { write(text); }});
    return result.status;
  };
  for (const std::string& way : arguments.orientations) orientation_way(way, {"--orientations"});
  ViewPage page;
  page.status = add_run(scene);
  const auto add_variant = [&](const SceneOverrides& overrides) {
    Scene variant = scene;
    apply(overrides, variant);
    if (add_run(variant) == RunStatus::interrupted) page.status = RunStatus::interrupted;
  };
  for (const std::string& method : arguments.methods) add_variant({.method = method});
  const auto turns = [](const World::Body& body) { return body.rotation.has_value(); };
  if (!arguments.orientations.empty() && ranges::none_of(motions.front().world().bodies, turns))
    throw InputError({"--orientations"}, "no body of the scene turns");
  for (const std::string& way : arguments.orientations) add_variant({.orientation = way});
  PageOptions with_text = options;
  with_text.scene_text = text_of(arguments.scene);
  page.html = page_html(runs, with_text);
  warn_of_large_page(page.html.size());
  return page;
}

void warn_of_large_page(std::size_t bytes) {
  constexpr double kMegabyte = 1e6;
  constexpr double kLarge = 50.0 * kMegabyte;
  const auto size = static_cast<double>(bytes);
  if (size > kLarge)
    tell_warning(
        fmt::format("the page has {:.0f} MB, which a browser may be slow to show: it holds every step of the run",
                    size / kMegabyte));
}

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

}  // namespace trajet
