#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "message.hpp"
#include "trajet/error.hpp"
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

void add_scene_options(CLI::App& command, RunArguments& arguments) {
  command.add_option("SCENE", arguments.scene, "scene file (TOML), - for standard input, or a built-in scene's name")
      ->required();
  SceneOverrides& overrides = arguments.overrides;
  command
      .add_option("--set", overrides.parameters, "replace a parameter or a key (ball.velocity), NAME=VALUE; repeatable")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command.add_option("--method", overrides.method, "integration method, see 'trajet methods'")->type_name("NAME");
  command.add_option("--orientation", overrides.orientation, "way of carrying orientations, see 'trajet methods'")
      ->type_name("NAME");
  command.add_option("--step", overrides.step, "step of a fixed-step method, \"10 ms\"")->type_name("DT");
  command.add_option("--order", overrides.order, "order of a series method")->type_name("N")->check(positive_number());
  command.add_option("--rtol", overrides.rtol, "relative tolerance")->type_name("X");
  command.add_option("--atol", overrides.atol, "absolute tolerance")->type_name("X");
  command.add_option("--end", overrides.end, "end time, \"5 s\"")->type_name("T");
  command.add_flag("--quiet", arguments.quiet, "no summary");
}

void add_report_options(CLI::App& command, RunArguments& arguments) {
  command.add_option("--json", arguments.json, "write the report there, - for standard output")->type_name("FILE");
  command.add_option("--csv", arguments.csv, "write the samples or rows there, - for standard output")
      ->type_name("FILE");
}

void add_plot_option(CLI::App& command, RunArguments& arguments) {
  command.add_option("--plot", arguments.plot, "draw a figure there, as SVG, PNG or PDF by the end of the name")
      ->type_name("FILE");
}

void add_compare_options(CLI::App& command, CompareArguments& arguments) {
  command.add_option("--methods", arguments.methods, "methods to compare, default: all")
      ->delimiter(',')
      ->type_name("NAME,...");
  command.add_option("--orientations", arguments.orientations, "ways of carrying orientations, each with every method")
      ->delimiter(',')
      ->type_name("NAME,...");
  command.add_option("--steps", arguments.steps, "numbers of steps over the run, for methods of given step")
      ->delimiter(',')
      ->check(positive_number())
      ->type_name("N,...");
  command.add_option("--rtols", arguments.rtols, "relative tolerances, for error-controlled methods")
      ->delimiter(',')
      ->check(positive_number())
      ->type_name("X,...");
  command.add_option("--show", arguments.show, "what --plot draws against time: ball.z, ball.vx or a state")
      ->type_name("NAME");
  command
      .add_option("--reference", arguments.reference, "what to compare with: exact (the scene's [exact]) or a method")
      ->type_name("NAME");
}

/// An option that there is not gets a better answer than CLI11's too: with the nearest one.
std::string unknown_option(const CLI::App& app) {
  const CLI::App* command = &app;
  for (const CLI::App* each : app.get_subcommands()) command = each;
  const std::vector<std::string> unexpected = app.remaining(true);
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

/// `trajet help run` is `trajet run --help`.
std::vector<std::string> with_help_spelt_out(std::vector<std::string> words) {
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.resize(std::min<std::size_t>(words.size(), 1));
  words.push_back("--help");
  return words;
}

/// An unknown command gets a better answer than CLI11's; options are left to it.
void check_command_name(const std::vector<std::string_view>& commands, const std::vector<std::string>& words) {
  if (words.empty()) return;
  const std::string_view word = words.front();
  for (const std::string_view command : commands)
    if (word == command) return;
  if (word.starts_with('-')) return;
  throw InputError({"trajet"},
                   "unknown command '" + std::string(word) + "', see 'trajet --help'" + did_you_mean(word, commands));
}

int run_program(int argc, char** argv) {
  CLI::App app("trajet: the motion of particles and rigid solids, with the exact time and place of every impact");
  app.name("trajet");
  app.set_version_flag("-V,--version", std::string("trajet ") + kVersion);
  app.require_subcommand(1);

  RunArguments arguments;
  std::string example;
  CLI::App& run = *app.add_subcommand("run", "compute one motion");
  add_scene_options(run, arguments);
  add_report_options(run, arguments);
  add_plot_option(run, arguments);
  run.add_option("--html", arguments.html, "write a page that plays the motion there, - for standard output")
      ->type_name("FILE");
  run.add_option("--glb", arguments.glb, "write a glTF animation there, - for standard output")->type_name("FILE");
  run.add_option("--fps", arguments.fps, "keys a second of the animation, default: 60")
      ->check(positive_number())
      ->type_name("N");
  ViewArguments viewed;
  CLI::App& view = *app.add_subcommand("view", "look at the motion in a browser");
  add_scene_options(view, viewed);
  view.add_option("--methods", viewed.methods, "further methods to show beside it, separated by commas")
      ->delimiter(',')
      ->type_name("NAME,...");
  view.add_option("--orientations", viewed.orientations, "further ways of carrying orientations to show beside it")
      ->delimiter(',')
      ->type_name("NAME,...");
  view.add_option("--out", viewed.out, "write the page there, - for standard output")->type_name("FILE");
  view.add_flag("--no-open", viewed.no_open, "do not open a browser");
  view.add_flag("--watch", viewed.watch, "serve the page, and make it anew whenever the scene file changes");
  CLI::App& check = *app.add_subcommand("check", "validate a scene without running it");
  add_scene_options(check, arguments);
  CompareArguments comparison;
  CLI::App& compare = *app.add_subcommand("compare", "measure several methods against a reference");
  add_scene_options(compare, comparison);
  add_report_options(compare, comparison);
  add_plot_option(compare, comparison);
  add_compare_options(compare, comparison);
  CLI::App& methods = *app.add_subcommand("methods", "list the integration methods");
  CLI::App& verify = *app.add_subcommand("verify", "compute published numbers anew and compare");
  CLI::App& examples = *app.add_subcommand("examples", "list the built-in scenes, or print one");
  examples.add_option("NAME", example, "the scene to print");

  std::vector<std::string> words = with_help_spelt_out({argv + 1, argv + argc});
  check_command_name({"run", "view", "check", "compare", "methods", "examples", "verify", "help"}, words);
  try {
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    app.parse(words);
  } catch (const CLI::ExtrasError&) {
    throw InputError({"trajet"}, unknown_option(app));
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return kWrongCommandLine;
  }
  if (run) return run_command(arguments);
  if (view) return view_command(viewed);
  if (check) return check_command(arguments);
  if (compare) return compare_command(comparison);
  if (methods) return methods_command();
  if (verify) return verify_command();
  return examples_command(example);
}

}  // namespace
}  // namespace trajet

int main(int argc, char** argv) {
  trajet::keep_standard_error();
  try {
    return trajet::run_program(argc, argv);
  } catch (const trajet::InputError& error) {
    trajet::tell("{}\n", error.what());
    // A fault whose place is an option or the program's name stands in the command line, not in the scene.
    const trajet::SourceLocation& place = error.where();
    const bool is_program = place.file.str() == "trajet" && place.line == 0;
    return is_program || place.file.str().starts_with("--") ? trajet::kWrongCommandLine : trajet::kWrongScene;
  } catch (const trajet::FileError& error) {
    trajet::tell("{}{}\n", error.has_place() ? "" : "error: ", error.what());
    return trajet::kFileFailed;
  } catch (const std::exception& error) {
    trajet::tell("error: the program failed: {}\n", error.what());
    return trajet::kNumbersFailed;
  }
}
