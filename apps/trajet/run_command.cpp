#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "memory_reserve.hpp"
#include "message.hpp"
#include "output_names.hpp"
#include "plot_file.hpp"
#include "run_keeper.hpp"
#include "run_monitor.hpp"
#include "scene_source.hpp"
#include "summary.hpp"
#include "terminal.hpp"
#include "trajet/io/csv_writer.hpp"
#include "trajet/io/gltf.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/io/report_json.hpp"
#include "trajet/portable.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/observer_list.hpp"
#include "trajet/sim/run.hpp"
#include "trajet/viz/page.hpp"
#include "trajet/viz/run_figure.hpp"
#include "view_page.hpp"

namespace trajet {

int exit_code(RunStatus status) {
  switch (status) {
    case RunStatus::finished:
    case RunStatus::stopped:
      return kDone;
    case RunStatus::failed:
      return kNumbersFailed;
    case RunStatus::interrupted:
      return kInterrupted;
  }
  return kNumbersFailed;
}

namespace {

/// Throws InputError where the animation of a run of that duration (s) would have too many keys.
void check_animation(double duration, double fps) {
  if (duration * fps <= kMostAnimationKeys) return;
  // rounded down: what is proposed shall do
  const double most = kMostAnimationKeys / duration;
  const double unit = std::pow(10.0, std::floor(std::log10(most)) - 2.0);
  throw InputError({"--fps"}, fmt::format("{:.6g} keys a second for {:.6g} s are more keys than the {:.6g} that an "
                                          "animation may have: --fps {:.3g} or less, or an earlier --end expected",
                                          fps, duration, kMostAnimationKeys, std::floor(most / unit) * unit));
}

}  // namespace

int run_command(const RunArguments& arguments) {
  return run_scene(arguments, [&] {
    Scene scene = read_named_scene(arguments.scene);
    apply(arguments.overrides, scene);
    return scene;
  });
}

int run_scene(const RunArguments& arguments, const std::function<Scene()>& read) {
  const auto to_stdout = {arguments.json == "-", arguments.csv == "-", arguments.html == "-", arguments.glb == "-"};
  const auto stdout_count = ranges::count(to_stdout, true);
  if (stdout_count > 1)
    throw InputError({"--csv"}, "only one of --json, --csv, --html and --glb can go to standard output");
  check_outputs(arguments.scene, {{"--json", arguments.json, {".json"}},
                                  {"--csv", arguments.csv, {".csv"}},
                                  {"--html", arguments.html, {".html", ".htm"}},
                                  {"--glb", arguments.glb, {".glb"}},
                                  {"--plot", arguments.plot, {}}});
  if (!arguments.html.empty() && !page_unavailable().empty()) throw FileError(page_unavailable());
  std::optional<PlotFile> plot;
  if (!arguments.plot.empty()) plot.emplace(arguments.plot);
  // A wrong scene must not cost the user an earlier report: files are opened behind these lines.
  const World world = make_world(read());
  if (!arguments.glb.empty()) check_animation(std::abs(world.duration), arguments.fps);

  std::optional<OutputFile> json, csv, html, glb;
  std::optional<CsvWriter> csv_writer;
  if (!arguments.json.empty()) json.emplace(arguments.json);
  if (!arguments.csv.empty()) csv_writer.emplace(csv.emplace(arguments.csv));
  if (!arguments.html.empty()) html.emplace(arguments.html);
  if (!arguments.glb.empty()) glb.emplace(arguments.glb);
  if (plot) plot->open();

  const std::string& beside = html ? arguments.html : glb ? arguments.glb : arguments.json;
  RunKeeper keeper(world, beside, html || glb, plot.has_value());
  const RunResult result = [&] {
    RunMonitor monitor;
    std::vector<RunObserver*> observers = keeper.observers();
    observers.insert(observers.end(), {csv_writer ? &*csv_writer : nullptr, &monitor});
    ObserverList list(std::move(observers));
    return run(world, &list);
  }();
  const RunRecords& records = keeper.records(result);

  bool is_all_written = true;
  const auto write = [&](const char* option, const auto& output) {
    const auto tell_of_memory = [&] {  // others may need less
      tell_error(std::string(option) + ": memory has run out, the file is not complete");
      is_all_written = false;
    };
    try {
      output();
    } catch (const std::bad_alloc&) {
      tell_of_memory();
    } catch (const FileError&) {
      if (!is_out_of_memory()) throw;
      tell_of_memory();
    }
  };
  if (csv) csv->finish();
  if (json)
    write("--json", [&] {
      write_report_json(result, records, [&](std::string_view part) { json->write(part); });
      json->finish();
    });
  if (html)
    write("--html", [&] {
      const auto report = [&](const auto& write_part) { write_report_json(result, records, write_part); };
      std::size_t size = 0;
      write_page({{keeper.motion(), report}}, {.scene_text = text_of(arguments.scene)}, [&](std::string_view part) {
        size += part.size();
        html->write(part);
      });
      warn_of_large_page(size);
      html->finish();
    });
  if (glb)
    write("--glb", [&] {
      write_gltf(keeper.motion(), result, records, arguments.fps, [&](std::string_view part) { glb->write(part); });
      glb->finish();
    });
  if (plot) write("--plot", [&] { plot->write(run_figure(result, keeper.motion_in_memory())); });
  if (!arguments.quiet && stdout_count == 0) {
    OutputFile out("-");
    out.write(summary(result, keeper.first_records(), wants_color(stdout), text_width(stdout)));
    out.finish();
  }
  for (const std::string& warning : result.warnings) tell_warning(warning);
  if (result.status == RunStatus::failed) tell_error(result.failure);
  return is_all_written ? exit_code(result.status) : kNumbersFailed;
}

}  // namespace trajet
