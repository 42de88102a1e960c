#include "command_line.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "completion.hpp"
#include "trajet/error.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/text/decimal_number.hpp"
#include "trajet/text/did_you_mean.hpp"
#include "trajet/version.hpp"

namespace trajet {
namespace {

CLI::Validator positive_number() {
  const auto check = [](const std::string& text) {
    const std::optional<double> value = finite_number(text);
    return value && *value > 0.0 ? std::string() : "a positive number expected, got '" + text + "'";
  };
  return {check, "", "positive"};
}

CLI::Validator not_negative() {
  const auto check = [](const std::string& text) {
    const std::optional<double> value = finite_number(text);
    return value && *value >= 0.0 ? std::string() : "a number from 0 on expected, got '" + text + "'";
  };
  return {check, "", "not negative"};
}

/// Takes the blanks around a word away.
CLI::Validator trimmed() {
  const auto trim = [](std::string& text) {
    CLI::detail::trim(text);
    return std::string();
  };
  return {trim, "", "trimmed"};
}

/// An option with one word of a kind. Completions know kinds by their names (completion.cpp).
template <class Value>
CLI::Option& add_word(CLI::App& command, const char* name, Value& value, const char* kind, const char* description) {
  return *command.add_option(name, value, description)->type_name(kind)->transform(trimmed());
}

/// An option with words of a kind, separated by commas.
template <class Value>
CLI::Option& add_list(CLI::App& command, const char* name, Value& values, const std::string& kind,
                      const char* description) {
  return *command.add_option(name, values, description)->delimiter(',')->type_name(kind + ",...")->transform(trimmed());
}

void add_file(CLI::App& command, const char* name, std::string& file, const char* description) {
  command.add_option(name, file, description)->type_name("FILE");
}

void add_repeatable(CLI::App& command, const char* name, std::vector<std::string>& texts, const char* kind,
                    const char* description) {
  command.add_option(name, texts, description)->type_name(kind)->allow_extra_args(false);
}

void add_scene_options(CLI::App& command, std::string& scene, SceneOverrides& overrides, bool& quiet) {
  command.add_option("SCENE", scene, "scene file (TOML), - for standard input, or a built-in scene's name")->required();
  add_repeatable(command, "--set", overrides.parameters, "NAME=VALUE",
                 "replace a parameter or a key (ball.velocity); repeatable");
  add_word(command, "--method", overrides.method, "METHOD", "integration method, see 'trajet methods'");
  add_word(command, "--orientation", overrides.orientation, "WAY",
           "way of carrying orientations, see 'trajet methods'");
  add_word(command, "--step", overrides.step, "DT", "step of a fixed-step method, \"10 ms\"");
  add_word(command, "--order", overrides.order, "N", "order of a series method").check(positive_number());
  add_word(command, "--rtol", overrides.rtol, "X", "relative tolerance");
  add_word(command, "--atol", overrides.atol, "X", "absolute tolerance");
  add_word(command, "--end", overrides.end, "T", "end time, \"5 s\"");
  command.add_flag("--quiet", quiet, "no summary");
}

void add_scene_options(CLI::App& command, RunArguments& arguments) {
  add_scene_options(command, arguments.scene, arguments.overrides, arguments.quiet);
}

void add_report_options(CLI::App& command, RunArguments& arguments) {
  add_file(command, "--json", arguments.json, "write the report there, - for standard output");
  add_file(command, "--csv", arguments.csv, "write the samples or rows there, - for standard output");
  add_file(command, "--plot", arguments.plot, "draw a figure there, as SVG, PNG or PDF by the end of the name");
}

/// What CLI11 says of words that are wrong, as a fault of ours at the option.
InputError fault_of(const CLI::ParseError& error, const std::string& command) {
  const std::string text = error.what(), see = ", see 'trajet " + command + "--help'";
  const auto split = [&text](const std::string& mark) {
    const std::size_t place = text.find(mark);
    return std::pair(text.substr(0, place), place == std::string::npos ? "" : text.substr(place + mark.size()));
  };
  if (error.get_name() == "RequiredError") return {{"trajet"}, split(" is required").first + " is missing" + see};
  const auto [option, fault] = split(": ");
  if (error.get_name() == "ValidationError") return {{option}, fault};
  if (error.get_name() == "ArgumentMismatch")
    return {{option}, (fault.ends_with("missing") ? "its value is missing" : "once expected, given more often") + see};
  if (error.get_name() == "ConversionError") {  // "Could not convert: --order = 2.5"
    const std::size_t equals = fault.find(" = ");
    return {{fault.substr(0, equals)},
            "a whole number, or of a switch no value expected, got '" +
                (equals == std::string::npos ? "" : fault.substr(equals + 3)) + "'"};
  }
  return {{"trajet"}, text + see};
}

/// `trajet help run` is `trajet run --help`.
std::vector<std::string> with_help_spelt_out(std::vector<std::string> words) {
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.resize(std::min<std::size_t>(words.size(), 1));
  words.push_back("--help");
  return words;
}

}  // namespace

CommandLine::CommandLine()
    : app_("trajet: the motion of particles and rigid solids, with the exact time and place of every impact") {
  app_.name("trajet");
  app_.set_version_flag("-V,--version", std::string("trajet ") + kVersion);
  app_.require_subcommand(1);
  add_run();
  add_view();
  add_scene_options(
      add_command("check", "validate a scene without running it", [this] { return check_command(check_); }), check_);
  add_compare();
  add_sweep();
  add_aim();
  add_lists();
}

CLI::App& CommandLine::add_command(const char* name, const char* description, std::function<int()> run) {
  CLI::App* app = app_.add_subcommand(name, description);
  commands_.push_back({app, std::move(run)});
  return *app;
}

void CommandLine::add_run() {
  CLI::App& command = add_command("run", "compute one motion", [this] { return run_command(run_); });
  add_scene_options(command, run_);
  add_report_options(command, run_);
  add_file(command, "--html", run_.html, "write a page that plays the motion there, - for standard output");
  add_file(command, "--glb", run_.glb, "write a glTF animation there, - for standard output");
  add_word(command, "--fps", run_.fps, "N", "keys a second of the animation, default: 60").check(positive_number());
}

void CommandLine::add_view() {
  CLI::App& command = add_command("view", "look at the motion in a browser", [this] { return view_command(view_); });
  add_scene_options(command, view_);
  add_list(command, "--methods", view_.methods, "METHOD", "further methods to show beside it, separated by commas");
  add_list(command, "--orientations", view_.orientations, "WAY",
           "further ways of carrying orientations to show beside it");
  add_file(command, "--out", view_.out, "write the page there, - for standard output");
  command.add_flag("--no-open", view_.no_open, "do not open a browser");
  command.add_flag("--watch", view_.watch, "serve the page, and make it anew whenever the scene file changes");
}

void CommandLine::add_compare() {
  CLI::App& command = add_command("compare", "measure several methods against a reference",
                                  [this] { return compare_command(compare_); });
  add_scene_options(command, compare_);
  add_report_options(command, compare_);
  add_list(command, "--methods", compare_.methods, "METHOD", "methods to compare, default: all");
  add_list(command, "--orientations", compare_.orientations, "WAY",
           "ways of carrying orientations, each with every method");
  add_list(command, "--steps", compare_.steps, "N", "numbers of steps over the run, for methods of given step")
      .check(positive_number());
  add_list(command, "--rtols", compare_.rtols, "X", "relative tolerances, for error-controlled methods")
      .check(positive_number());
  add_word(command, "--show", compare_.show, "NAME", "what --plot draws against time: ball.z, ball.vx or a state");
  add_word(command, "--reference", compare_.reference, "REFERENCE",
           "what to compare with: exact (the scene's [exact]) or a method");
}

void CommandLine::add_sweep() {
  CLI::App& command = add_command("sweep", "compute many motions: grids and samples of parameters",
                                  [this] { return sweep_command(sweep_); });
  add_scene_options(command, sweep_.scene, sweep_.overrides, sweep_.quiet);
  add_repeatable(command, "--vary", sweep_.vary, "NAME=LOW:HIGH:COUNT", "a grid of a parameter or a key; repeatable");
  add_repeatable(command, "--sample", sweep_.sample, "NAME=normal(MEAN,SD)",
                 "random values, also uniform(LOW,HIGH), lognormal(MEAN,SD), truncated(MEAN,SD,LOW,HIGH); repeatable");
  add_repeatable(command, "--correlate", sweep_.correlate, "NAME,NAME=R", "correlation of two samples; repeatable");
  add_word(command, "--count", sweep_.count, "N", "number of samples, default: 1000").check(positive_number());
  add_word(command, "--seed", sweep_.seed, "S", "seed of the samples, default: 0").check(not_negative());
  add_word(command, "--design", sweep_.design, "DESIGN", "of samples: random, lhs or sobol");
  add_word(command, "--report", sweep_.report, "LIST", "what to report: t, ball.x, hit, impact(1).t, max(ball.z), ...");
  add_file(command, "--out", sweep_.out, "write the table there, as CSV (- for standard output) or HDF5 (.h5)");
  add_file(command, "--summary", sweep_.summary, "write what it comes to there as JSON, - for standard output");
  add_word(command, "--threads", sweep_.threads, "N", "default: as many as the machine has").check(positive_number());
  add_word(command, "--until", sweep_.until, "COND",
           "end when the share is known so well: \"ci(hit == 'target') < 0.1%\"");
  command.add_flag("--resume", sweep_.resume, "go on with the table of a sweep that was ended");
  add_word(command, "--shard", sweep_.shard, "I/N", "compute part I of N, I from 1; 'trajet merge' joins them");
  add_word(command, "--only", sweep_.only, "INDEX", "run that one motion, with the options of 'trajet run'");
  add_file(command, "--json", sweep_.json, "with --only: write its report there");
  add_file(command, "--csv", sweep_.csv, "with --only: write its samples there");
  add_file(command, "--html", sweep_.html, "with --only: write its page there");
  add_file(command, "--glb", sweep_.glb, "with --only: write its animation there");
  add_file(command, "--plot", sweep_.plot, "draw a figure there, as SVG, PNG or PDF by the end of the name");
  CLI::App& merge =
      add_command("merge", "join the tables of the shards of a sweep", [this] { return merge_command(merge_); });
  merge.add_option("FILE", merge_.files, "tables that 'trajet sweep --shard' has written")->required();
  merge.add_option("--out", merge_.out, "write the whole table there, - for standard output")
      ->type_name("FILE")
      ->required();
}

void CommandLine::add_aim() {
  CLI::App& command =
      add_command("aim", "solve for parameters so that a body hits a target", [this] { return aim_command(aim_); });
  add_scene_options(command, aim_.scene, aim_.overrides, aim_.quiet);
  add_repeatable(command, "--vary", aim_.vary, "NAME=LOW:HIGH",
                 "look for a parameter or a key in that range; repeatable");
  add_word(command, "--hit", aim_.hit, "OBSTACLE", "hit the centre of that obstacle, which may move");
  add_word(command, "--at", aim_.at, "X,Y,Z", "hit that point instead");
  add_word(command, "--body", aim_.body, "NAME", "what shall hit, where the scene has several bodies");
  add_repeatable(command, "--with", aim_.with, "COND",
                 "take solutions only that fulfil this at the hit: \"speed > 20\", \"max(z) < 3\"; repeatable");
  add_word(command, "--minimise,--minimize", aim_.minimise, "EXPR",
           "take the one solution only where this is least at the hit: time, speed, ...");
  add_file(command, "--json", aim_.json, "write the solutions there, - for standard output");
}

void CommandLine::add_lists() {
  add_command("methods", "list the integration methods", [] { return methods_command(); });
  add_command("schema", "print the JSON Schema of scene files, for editors", [] { return schema_command(); });
  add_command("verify", "compute published numbers anew and compare", [] { return verify_command(); });
  add_command("examples", "list the built-in scenes, or print one", [this] {
    return examples_command(example_);
  }).add_option("EXAMPLE", example_, "the scene to print");
  add_command("completion", "print what completes commands and options in a shell",
              [this] { return completion_command(shell_, app_); })
      .add_option("SHELL", shell_, "bash, zsh or fish")
      ->required();
}

void CommandLine::check_name(const std::string& word) const {
  if (word.starts_with('-')) return;  // left to CLI11
  std::vector<std::string> names{"help"};
  for (const Command& command : commands_) names.push_back(command.app->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end()) return;
  throw InputError({"trajet"}, "unknown command '" + word + "', see 'trajet --help'" +
                                   did_you_mean(word, std::vector<std::string_view>(names.begin(), names.end())));
}

std::string CommandLine::unknown_option() const {
  const CLI::App* command = &app_;
  for (const CLI::App* each : app_.get_subcommands()) command = each;
  const std::vector<std::string> unexpected = app_.remaining(true);
  std::vector<std::string> names;
  for (const CLI::Option* option : command->get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (std::string word : unexpected) {
    word = word.substr(0, word.find('='));
    if (!word.starts_with('-') || word == "-") continue;
    return "unknown option '" + word + "', see 'trajet " + command->get_name() + " --help'" +
           did_you_mean(word, std::vector<std::string_view>(names.begin(), names.end()));
  }
  return "'" + (unexpected.empty() ? "" : unexpected.front()) + "' is one argument too many, see 'trajet " +
         command->get_name() + " --help'";
}

int CommandLine::run(std::vector<std::string> words) {
  if (!words.empty()) check_name(words.front());
  words = with_help_spelt_out(std::move(words));
  try {
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    app_.parse(words);
  } catch (const CLI::ExtrasError&) {
    throw InputError({"trajet"}, unknown_option());
  } catch (const CLI::Success& success) {  // --help, --version
    std::ostringstream text;
    const int code = app_.exit(success, text, text);
    OutputFile out("-");
    out.write(text.str());
    out.finish();
    return code;
  } catch (const CLI::ParseError& error) {
    std::string command;
    for (const CLI::App* each : app_.get_subcommands()) command = each->get_name() + " ";
    throw fault_of(error, command);
  }
  for (const Command& command : commands_)
    if (*command.app) return command.run();
  return kWrongCommandLine;
}

}  // namespace trajet
