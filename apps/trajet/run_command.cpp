#include <fmt/format.h>

#include <optional>

#include "commands.hpp"
#include "run_monitor.hpp"
#include "summary.hpp"
#include "terminal.hpp"
#include "trajet/io/csv_writer.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/io/report_json.hpp"
#include "trajet/io/scene_file.hpp"
#include "trajet/sim/run.hpp"

namespace trajet {

namespace {

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

}  // namespace

int run_command(const RunArguments& arguments) {
  if (arguments.json == "-" && arguments.csv == "-")
    throw InputError({"--csv"}, "only one of --json and --csv can go to standard output");
  Scene scene = read_scene(arguments.scene);
  apply(arguments.overrides, scene);
  check(scene);  // a wrong scene must not cost the user an earlier report: files are opened behind this line

  std::optional<OutputFile> json, csv;
  std::optional<CsvWriter> csv_writer;
  if (!arguments.json.empty()) json.emplace(arguments.json);
  if (!arguments.csv.empty()) csv_writer.emplace(csv.emplace(arguments.csv));

  const RunResult result = [&] {
    RunMonitor monitor(csv_writer ? &*csv_writer : nullptr);
    return run(scene, &monitor);
  }();

  if (csv) csv->finish();
  if (json) {
    json->write(report_json(result));
    json->finish();
  }
  const bool stdout_has_data = arguments.json == "-" || arguments.csv == "-";
  if (!arguments.quiet && !stdout_has_data) {
    OutputFile out("-");
    out.write(summary(result, wants_color(stdout)));
    out.finish();
  }
  for (const std::string& warning : result.warnings) fmt::print(stderr, "warning: {}\n", warning);
  if (result.status == RunStatus::failed) fmt::print(stderr, "error: {}\n", result.failure);
  return exit_code(result.status);
}

}  // namespace trajet
