#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "commands.hpp"
#include "message.hpp"
#include "output_names.hpp"
#include "plot_file.hpp"
#include "progress_line.hpp"
#include "run_monitor.hpp"
#include "scene_source.hpp"
#include "sweep_arguments.hpp"
#include "sweep_ranks.hpp"
#include "sweep_setup.hpp"
#include "sweep_summary.hpp"
#include "sweep_tally.hpp"
#include "terminal.hpp"
#include "trajet/ensemble/share_interval.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/io/sweep_csv.hpp"
#include "trajet/io/sweep_file.hpp"
#include "trajet/io/sweep_hdf5.hpp"
#include "trajet/io/sweep_results.hpp"
#include "trajet/portable.hpp"
#include "trajet/version.hpp"
#include "trajet/viz/sweep_figure.hpp"

namespace trajet {
namespace {

/// The centers of the targets that stand still and have one.
std::map<std::string, Vector3> aims_of(const Scene& scene) {
  std::map<std::string, Vector3> aims;
  const World world = make_world(scene);
  for (const World::Obstacle& obstacle : world.obstacles) {
    const ShapeDefinition& shape = ranges::find(scene.obstacles, obstacle.name, &ObstacleDefinition::name)->shape;
    const bool has_center = !std::holds_alternative<PlaneShape>(shape) &&
                            !std::holds_alternative<TerrainShape>(shape) &&
                            !std::holds_alternative<CompoundShape>(shape);
    if (has_center && !obstacle.drive) aims.emplace(obstacle.name, obstacle.p_WB);
  }
  return aims;
}

/// The table that grows: HDF5 files are made of a complete one.
std::string table_name(const std::string& out) { return is_hdf5_name(out) ? out + ".csv" : out; }

/// What becomes of the rows of a sweep: the table, what it comes to, how far it is.
class SweepKeeper {
 public:
  SweepKeeper(const SweepSetup& setup, const SweepArguments& arguments)
      : setup_(setup),
        header_(sweep_header(setup.sweep, setup.column_count)),
        results_(header_, arguments.out.empty() ? "-" : arguments.out, aims_of(setup.sweep.scene())) {
    const std::string header_line = csv_line(header_);
    if (!arguments.out.empty() && is_stream(arguments.out)) {
      stream_.emplace(arguments.out);
      stream_->write(header_line);
    } else if (!arguments.out.empty()) {
      file_.emplace(table_name(arguments.out), setup.fingerprint, header_line, arguments.resume);
      tally_ = file_->found();
      is_complete_ = file_->is_complete();
      file_->each_line([&](std::string_view line) { take_back(read_csv_row(line, header_.quantities.size())); });
      const std::uint64_t all = setup.last - setup.first;
      if (tally_.count > all || (is_complete_ && tally_.count < all && !setup.until))
        throw FileError(arguments.out + " is complete, and of another sweep");
    }
  }

  /// The first motion that is not computed yet.
  std::uint64_t next() const { return setup_.first + tally_.count; }

  /// False where enough has been seen.
  bool take(SweepBlock&& block) {
    lines_.clear();
    for (const SweepRow& row : block.rows) {
      append_csv_line(row, setup_.column_count, lines_);
      results_.add(row);
      if (!row.failure.empty() && first_failure_.empty())
        first_failure_ = fmt::format("motion {}: {}", row.index, row.failure);
    }
    const SweepTally tally = tally_of(block, setup_);
    if (stream_) stream_->write(lines_);
    if (file_) file_->append(lines_, tally);
    tally_.add(tally);
    new_count_ += tally.count;
    if (progress_.is_due()) show();
    return !is_enough();
  }

  /// Rows that others have computed, as lines of the table.
  void take_lines(const std::string& lines, const SweepTally& tally) {
    file_->append(lines, tally);
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);) results_.add(read_csv_row(line, header_.quantities.size()));
    tally_.add(tally);
  }

  bool is_enough() const {
    if (!setup_.until) return false;
    const ShareInterval interval = anytime_share_interval(tally_.condition, tally_.count);
    return tally_.count > 0 && 0.5 * (interval.high - interval.low) < setup_.until->half_width;
  }
  bool is_complete() const { return is_complete_ || next() == setup_.last || is_enough(); }

  void finish() {
    progress_.clear();
    if (stream_) stream_->finish();
    if (file_ && is_complete()) file_->finish();
  }

  const SweepResults& results() const { return results_; }
  const SweepTally& tally() const { return tally_; }
  const std::string& first_failure() const { return first_failure_; }

 private:
  /// A row that was there. A table that is complete has no journal any more: what was hit is then told by the rows.
  void take_back(const SweepRow& row) {
    results_.add(row);
    if (!is_complete_) return;
    const auto hit = ranges::find(header_.columns, "hit");
    if (hit == header_.columns.end()) return;
    const Cell& cell = row.cells[static_cast<std::size_t>(hit - header_.columns.begin())];
    if (const auto* word = std::get_if<std::string>(&cell)) ++tally_.hits[*word];
  }

  void show() {
    const double seconds = progress_.seconds();
    const double rate = static_cast<double>(new_count_) / seconds;
    const auto all = static_cast<double>(setup_.last - setup_.first);
    const double left = all - static_cast<double>(tally_.count);
    // what is done is the share of the time, not of the motions: some may have been there
    const double done = seconds / (seconds + left / rate);
    progress_.show(fmt::format("{} of {} motions, {:.3g} a second", tally_.count, setup_.last - setup_.first, rate),
                   done);
  }

  const SweepSetup& setup_;
  SweepHeader header_;
  SweepResults results_;
  std::optional<OutputFile> stream_;
  std::optional<SweepFile> file_;
  SweepTally tally_;
  bool is_complete_ = false;  // it was, before anything was computed
  std::uint64_t new_count_ = 0;
  std::string lines_;  // kept for its memory
  std::string first_failure_;
  ProgressLine progress_;
};

void write_text(const std::string& path, const std::string& text) {
  OutputFile file(path);
  file.write(text);
  file.finish();
}

/// One motion of the sweep, with everything that `trajet run` can report of it.
int replay(const SweepArguments& arguments, const SweepSetup& setup) {
  if (*arguments.only >= setup.sweep.plan().count())
    throw InputError({"--only"}, fmt::format("motions have the numbers 0 to {}", setup.sweep.plan().count() - 1));
  RunArguments run;
  run.scene = arguments.scene;
  run.json = arguments.json;
  run.csv = arguments.csv;
  run.html = arguments.html;
  run.glb = arguments.glb;
  run.plot = arguments.plot;
  run.quiet = arguments.quiet;
  return run_scene(run, [&] { return setup.sweep.variant(*arguments.only); });
}

/// Several processes share a table, and each computes a part of it.
void check_for_ranks(const SweepArguments& arguments) {
  if (!arguments.only && (arguments.out.empty() || is_stream(arguments.out)))
    throw InputError({"--out"}, "under mpirun a file is expected, which all processes can reach");
  if (!arguments.until.empty()) throw InputError({"--until"}, "is known of one process alone: not under mpirun");
}

/// Whether that file was completed by an earlier sweep: beside one that was not lies what it is made of.
bool is_written(const std::string& out) {
  const std::string table = table_name(out);
  const bool has_table = table != out && std::filesystem::exists(table);
  return std::filesystem::exists(out) && !has_table && !std::filesystem::exists(table + ".journal") &&
         !SweepParts::exist(table);
}

SweepOrigin origin_of(const SweepArguments& arguments, const SweepSetup& setup) {
  std::string plan;
  const auto add = [&](const char* option, const std::vector<std::string>& texts) {
    for (const std::string& text : texts) plan += fmt::format("{} {}\n", option, text);
  };
  add("--set", arguments.overrides.parameters);
  add("--vary", arguments.vary);
  add("--sample", arguments.sample);
  add("--correlate", arguments.correlate);
  plan += fmt::format("--design {}\n", arguments.design);
  return {{"trajet", kVersion},
          {"scene", arguments.scene},
          {"scene_text", text_of(arguments.scene)},
          {"plan", plan},
          {"count", fmt::format("{}", setup.sweep.plan().count())},
          {"seed", fmt::format("{}", arguments.seed)}};
}

void check_options(const SweepArguments& arguments) {
  const std::pair<const char*, const std::string*> of_one[] = {
      {"--json", &arguments.json}, {"--csv", &arguments.csv}, {"--html", &arguments.html}, {"--glb", &arguments.glb}};
  for (const auto& [option, value] : of_one)
    if (!value->empty() && !arguments.only)
      throw InputError({option}, "is the report of one motion: it goes with --only; the table of all is --out");
  const std::pair<const char*, bool> of_all[] = {
      {"--out", !arguments.out.empty()}, {"--summary", !arguments.summary.empty()}, {"--resume", arguments.resume}};
  for (const auto& [option, is_given] : of_all)
    if (is_given && arguments.only) throw InputError({option}, "is of all motions: --only replays one");
  if (arguments.resume && (arguments.out.empty() || is_stream(arguments.out)))
    throw InputError({"--resume"}, "goes on with a file: --out FILE.csv expected");
  if (arguments.out == "-" && arguments.summary == "-")
    throw InputError({"--summary"}, "only one of --out and --summary can go to standard output");
  check_outputs(arguments.scene, {{"--out", arguments.out, {".csv", ".h5", ".hdf5"}},
                                  {"--summary", arguments.summary, {".json"}},
                                  {"--plot", arguments.plot, {}}});
}

}  // namespace

int sweep_command(const SweepArguments& arguments) {
  check_options(arguments);
  const std::optional<Rank> rank = rank_of_environment();
  if (rank) check_for_ranks(arguments);
  const SweepSetup setup = make_sweep(arguments);
  if (arguments.only) return rank && rank->number > 0 ? kDone : replay(arguments, setup);
  std::optional<PlotFile> plot;
  if (!arguments.plot.empty()) plot.emplace(arguments.plot);

  if (is_hdf5_name(arguments.out)) {
    require_hdf5();
    if (arguments.resume && is_written(arguments.out)) {
      tell("{} is complete\n", arguments.out);
      return kDone;
    }
  }
  const bool is_there = arguments.resume && is_written(table_name(arguments.out));
  if (rank && is_there && rank->number > 0) return kDone;

  let_signals_end_runs();
  std::optional<SweepParts> parts;
  if (rank && !is_there) {
    parts.emplace(setup, table_name(arguments.out), *rank, arguments.resume);
    const bool is_done = parts->compute(std::max(arguments.threads, 1), is_end_wanted);
    if (rank->number > 0) return is_done ? kDone : kInterrupted;
    if (!is_done || !parts->wait(is_end_wanted)) {
      tell_error("interrupted; --resume goes on");
      return kInterrupted;
    }
  }
  SweepKeeper keeper(setup, arguments);
  if (parts)
    parts->each(keeper.next(),
                [&](const std::string& lines, const SweepTally& tally) { keeper.take_lines(lines, tally); });
  else if (!keeper.is_complete())
    run_sweep(
        setup.sweep, {.first = keeper.next(), .last = setup.last, .threads = arguments.threads},
        [&](SweepBlock&& block) { return keeper.take(std::move(block)); }, is_end_wanted);
  keeper.finish();
  if (parts) parts->remove();

  if (is_hdf5_name(arguments.out) && keeper.is_complete()) {
    write_sweep_hdf5(arguments.out, keeper.results(), origin_of(arguments, setup));
    std::filesystem::remove(table_name(arguments.out));
  }
  const SweepSummary summary = keeper.results().summary(keeper.tally());
  const Scene& scene = setup.sweep.scene();
  if (!arguments.summary.empty())
    write_text(arguments.summary,
               sweep_summary_json({scene.file, scene.title, arguments.design, arguments.seed}, summary));
  if (plot) {
    plot->open();
    plot->write(sweep_figure({.title = scene.title.empty() ? scene.file : scene.title,
                              .header = keeper.results().header(),
                              .axis_count = setup.sweep.plan().axes.size(),
                              .is_sampled = !setup.sweep.plan().samples.empty(),
                              .rows = [&](const auto& use) { keeper.results().each_row(use); }},
                             summary));
  }
  if (!arguments.quiet && arguments.out != "-" && arguments.summary != "-") {
    OutputFile out("-");
    out.write(sweep_text(scene.title, summary, wants_color(stdout), text_width(stdout)));
    out.finish();
  }
  for (const std::string& warning : scene.warnings) tell_warning(warning);
  if (!keeper.first_failure().empty())
    tell_warning(fmt::format("{} of {} motions failed, the first of them: {}", keeper.tally().failed,
                             keeper.tally().count, keeper.first_failure()));
  if (keeper.is_complete()) return kDone;
  tell_error(fmt::format("interrupted after {} of {} motions{}", keeper.tally().count, setup.last - setup.first,
                         arguments.out.empty() || is_stream(arguments.out) ? "" : "; --resume goes on"));
  return kInterrupted;
}

}  // namespace trajet
