#include <fmt/format.h>

#include <optional>

#include "commands.hpp"
#include "message.hpp"
#include "output_names.hpp"
#include "plot_file.hpp"
#include "run_monitor.hpp"
#include "scene_source.hpp"
#include "terminal.hpp"
#include "text_table.hpp"
#include "trajet/io/compare_report.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/sim/observer_list.hpp"
#include "trajet/study/compare.hpp"
#include "trajet/viz/compare_figure.hpp"

namespace trajet {

namespace {

/// Shows how far a comparison is; Ctrl-C, SIGTERM and SIGHUP end it with the rows so far. Keeps the motions for the
/// figure, if there is one.
class CompareMonitor : public CompareObserver {
 public:
  explicit CompareMonitor(bool keeps_motions)
      : keeps_motions_(keeps_motions), row_observers_({keeps_motions ? &record_ : nullptr, &monitor_}) {}

  RunObserver* begin_reference(const std::string& method) override {
    monitor_.set_label("reference by " + method);
    return &monitor_;
  }
  RunObserver* begin_row(const ComparisonRow& row, std::size_t index, std::size_t count) override {
    keep_motion();
    row_ = index;
    motions_.resize(count);
    monitor_.set_label(fmt::format("{} ({} of {})", row.method, index + 1, count));
    return &row_observers_;
  }

  /// Removes the line of progress.
  void clear() { monitor_.clear(); }
  /// What `compare_figure` draws; call it when the comparison is done.
  const std::vector<RowMotion>& motions() {
    keep_motion();
    return motions_;
  }
  bool has_motions() const { return row_.has_value(); }

 private:
  /// That of the row that was run last.
  void keep_motion() {
    if (!keeps_motions_ || !row_) return;
    motions_[*row_] = make_row_motion(record_);
  }

  bool keeps_motions_;
  MotionRecord record_;
  RunMonitor monitor_;
  ObserverList row_observers_;
  std::optional<std::size_t> row_;
  std::vector<RowMotion> motions_;
};

ComparePlan plan(const CompareArguments& arguments) {
  ComparePlan plan;
  plan.methods = arguments.methods;
  if (plan.methods.empty() && arguments.overrides.method) plan.methods = {*arguments.overrides.method};
  plan.step_counts = arguments.steps;
  for (const double rtol : arguments.rtols) plan.rtols.push_back(Expression::number(rtol, {"--rtols"}));
  plan.orientations_where = {"--orientations"};
  for (const std::string& name : arguments.orientations)
    plan.orientations.push_back(orientation_way(name, plan.orientations_where));
  plan.reference = arguments.reference;
  plan.methods_where = {"--methods"};
  plan.reference_where = {"--reference"};
  return plan;
}

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{:.6g}", *value) : "-"; }

constexpr std::size_t kIndent = 2;  // of lines that go on

std::string reference_line(const Comparison& comparison, int width) {
  std::string text = "reference: ";
  if (comparison.reference_name == "exact") {
    text += "exact, the scene's closed forms";
  } else {
    text += comparison.reference_name;
    if (comparison.reference_rtol)
      text += fmt::format(", rtol {:g}, atol {:g}", *comparison.reference_rtol, *comparison.reference_atol);
    if (comparison.reference_step) text += fmt::format(", step {:g} s", *comparison.reference_step);
  }
  return wrap(text + fmt::format("; compared: {}", fmt::join(comparison.components, ", ")), kIndent, width);
}

std::string name(const ComparisonRow& row) {
  return row.orientation.empty() ? row.method : row.method + ", " + row.orientation;
}

std::string setting(const ComparisonRow& row) {
  return row.rtol ? fmt::format("rtol {:g}", *row.rtol) : fmt::format("step {} s", cell(row.step));
}

/// The rows without result, where nobody sees the table.
void warn_of_failures(const Comparison& comparison) {
  for (const ComparisonRow& row : comparison.rows)
    if (!row.succeeded()) tell_warning(fmt::format("{}, {}: no result: {}", name(row), setting(row), row.failure));
}

/// Columns that tell which row it is: method, step, rtol.
constexpr std::size_t kKeys = 3;

std::string table(const Comparison& comparison, bool color, int width) {
  TextTable table{{"method", "step [s]", "rtol", "error: end", "at samples", "at nodes", "position: end", "at samples",
                   "at nodes", "evaluations", "steps", "rejected", "time [ms]"}};
  std::string failures;
  for (const ComparisonRow& row : comparison.rows) {
    if (!row.succeeded()) {
      failures += fmt::format("  {}, {}: {}\n", styled(name(row), Style::red, color), setting(row), row.failure);
      continue;
    }
    table.push_back({name(row), cell(row.step), cell(row.rtol), cell(row.at_end.state), cell(row.at_samples.state),
                     cell(row.at_nodes.state), cell(row.at_end.position), cell(row.at_samples.position),
                     cell(row.at_nodes.position), std::to_string(row.statistics.law_evaluations),
                     std::to_string(row.statistics.steps), std::to_string(row.statistics.rejected_steps),
                     fmt::format("{:.3g}", 1e3 * row.statistics.wall_seconds)});
  }
  std::string text;
  if (table.size() > 1) text += "\n" + format_table(table, {.first_number = 1, .keys = kKeys, .width = width});
  if (!failures.empty()) text += "\nwithout result:\n" + failures;
  return text;
}

/// What becomes of bodies that turn.
std::string rotation_table(const Comparison& comparison, int width) {
  if (!comparison.turns) return {};
  TextTable table{
      {"method", "step [s]", "rtol", "det R", "|q|", "angle [rad]: end", "at samples", "energy", "momentum"}};
  for (const ComparisonRow& row : comparison.rows)
    if (row.succeeded())
      table.push_back({name(row), cell(row.step), cell(row.rtol), cell(row.rotation_at_end.determinant),
                       cell(row.rotation_at_end.norm), cell(row.rotation_at_end.angle_rad),
                       cell(row.rotation_at_samples.angle_rad), cell(row.rotation_at_samples.energy),
                       cell(row.rotation_at_samples.momentum)});
  if (table.size() == 1) return {};
  return "\n" + format_table(table, {.first_number = 1, .keys = kKeys, .width = width}) +
         wrap(
             "\ndet R, |q|: at the end; angle: from the reference's orientation; energy, momentum: largest relative "
             "drift",
             kIndent, width);
}

std::string notes(const Comparison& comparison, int width) {
  std::string text = "\nerrors: largest absolute value over all components, in SI units; position: m\n";
  bool is_cut = false;
  for (const ComparisonRow& row : comparison.rows)
    is_cut = is_cut || (row.succeeded() && row.compared_until != row.elapsed);
  if (is_cut && comparison.reference_name == "exact")
    text += "closed forms hold up to the first bounce: what follows is not compared\n";
  else if (is_cut)
    text += "compared up to the earlier of the two ends, that of the run and that of the reference\n";
  return wrap(text, kIndent, width);
}

int exit_code(const Comparison& comparison) {
  if (comparison.interrupted) return kInterrupted;
  for (const ComparisonRow& row : comparison.rows)
    if (row.succeeded()) return kDone;
  return kNumbersFailed;
}

}  // namespace

int compare_command(const CompareArguments& arguments) {
  if (arguments.json == "-" && arguments.csv == "-")
    throw InputError({"--csv"}, "only one of --json and --csv can go to standard output");
  check_outputs(
      arguments.scene,
      {{"--json", arguments.json, {".json"}}, {"--csv", arguments.csv, {".csv"}}, {"--plot", arguments.plot, {}}});
  std::optional<PlotFile> plot;
  if (!arguments.plot.empty()) plot.emplace(arguments.plot);
  Scene scene = read_named_scene(arguments.scene);
  apply(arguments.overrides, scene);
  const ComparePlan plan = trajet::plan(arguments);
  const World world = check(scene, plan);
  std::optional<ShownComponent> shown;
  if (!arguments.show.empty()) shown = find_component(world, arguments.show, {"--show"});
  // A wrong scene must not cost the user an earlier report: files are opened behind this line.
  std::optional<OutputFile> json, csv;
  if (!arguments.json.empty()) json.emplace(arguments.json);
  if (!arguments.csv.empty()) csv.emplace(arguments.csv);

  CompareMonitor monitor(plot.has_value());
  const Comparison comparison = compare(scene, plan, &monitor);
  monitor.clear();

  if (json) {
    json->write(compare_json(comparison));
    json->finish();
  }
  if (csv) {
    csv->write(compare_csv(comparison));
    csv->finish();
  }
  const bool stdout_has_data = arguments.json == "-" || arguments.csv == "-";
  if (!arguments.quiet && !stdout_has_data) {
    const bool color = wants_color(stdout);
    OutputFile out("-");
    if (!comparison.title.empty()) out.write(styled(comparison.title, Style::bold, color) + "\n");
    const int width = text_width(stdout);
    out.write(reference_line(comparison, width) + table(comparison, color, width) + notes(comparison, width) +
              rotation_table(comparison, width));
    out.finish();
  } else {
    warn_of_failures(comparison);
  }
  if (plot && monitor.has_motions()) {
    plot->open();
    plot->write(compare_figure(comparison, world, monitor.motions(), shown));
  }
  for (const std::string& warning : comparison.warnings) tell_warning(warning);
  return exit_code(comparison);
}

}  // namespace trajet
