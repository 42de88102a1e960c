#pragma once

#include <functional>
#include <string>
#include <vector>

#include "aim_arguments.hpp"
#include "sweep_arguments.hpp"
#include "trajet/io/scene_overrides.hpp"
#include "trajet/scene/scene.hpp"
#include "trajet/sim/run_result.hpp"

namespace CLI {
class App;
}

namespace trajet {

/// How the program ends; docs/formats/report.md lists what each code means.
enum ExitCode : int {
  kDone = 0,
  kWrongCommandLine = 2,
  kWrongScene = 3,
  kNumbersFailed = 4,
  kFileFailed = 5,
  kInterrupted = 130,
};

/// The exit code for how a run has ended.
int exit_code(RunStatus status);

/// What the commands that work on a scene take from the command line.
struct RunArguments {
  std::string scene;
  SceneOverrides overrides;
  std::string json;   ///< file name, `-` for standard output, empty for none
  std::string csv;    ///< likewise
  std::string html;   ///< likewise
  std::string glb;    ///< likewise
  double fps = 60.0;  ///< keys a second of the glb
  std::string plot;   ///< file name that ends in .svg, .png or .pdf, empty for none
  bool quiet = false;
};

/// What `trajet compare` takes beside that.
struct CompareArguments : RunArguments {
  std::vector<std::string> methods;
  std::vector<std::string> orientations;
  std::vector<long> steps;
  std::vector<double> rtols;
  std::string reference;
  std::string show;  ///< component that the figure shows, empty for the path
};

/// What `trajet view` takes from the command line.
struct ViewArguments : RunArguments {
  std::vector<std::string> methods;       ///< further runs, shown beside the first
  std::vector<std::string> orientations;  ///< likewise, by the scene's method: ways of carrying orientations
  std::string out;                        ///< file name, `-` for standard output, empty for a temporary file
  bool no_open = false;
  bool watch = false;  ///< serve the page, and make it anew when the scene file changes
};

// One function per command. They throw InputError and FileError; `main` turns these into exit codes.
int run_command(const RunArguments& arguments);
/// The same for a scene that comes from elsewhere than the arguments' names.
int run_scene(const RunArguments& arguments, const std::function<Scene()>& read);
int aim_command(const AimArguments& arguments);
int sweep_command(const SweepArguments& arguments);
int merge_command(const MergeArguments& arguments);
int view_command(const ViewArguments& arguments);
int check_command(const RunArguments& arguments);
int compare_command(const CompareArguments& arguments);
/// Computes published numbers anew and prints ours beside them; kNumbersFailed if one differs.
int verify_command();
int methods_command();
/// Prints the JSON Schema of scene files.
int schema_command();
/// Lists the built-in scenes, or prints the one of that name.
int examples_command(const std::string& name);
/// Prints what makes a shell complete the options of `app`.
int completion_command(const std::string& shell, const CLI::App& app);

}  // namespace trajet
