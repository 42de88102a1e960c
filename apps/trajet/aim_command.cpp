#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "aim_arguments.hpp"
#include "aim_summary.hpp"
#include "commands.hpp"
#include "message.hpp"
#include "output_names.hpp"
#include "run_monitor.hpp"
#include "scene_source.hpp"
#include "terminal.hpp"
#include "trajet/ensemble/aim.hpp"
#include "trajet/io/aim_json.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/io/variation_text.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

bool names_degrees(std::string_view text) {
  return text.find("deg") != std::string_view::npos || text.find("°") != std::string_view::npos;
}

/// Line number `line`, from 1, of a text.
std::string_view line_of(std::string_view text, int line) {
  for (; line > 1 && !text.empty(); --line) {
    const std::size_t end = text.find('\n');
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return text.substr(0, text.find('\n'));
}

/// Whether the range, or the scene where it gives the parameter, is in degrees.
bool is_in_degrees(const std::string& range, const std::string& name, const Scene& scene,
                   const std::string& scene_text) {
  if (names_degrees(range.substr(std::min(range.find('='), range.size())))) return true;
  const auto parameter = ranges::find(scene.parameters, name, &NamedExpression::name);
  if (parameter == scene.parameters.end() || parameter->where.line == 0) return false;
  std::string_view line = line_of(scene_text, parameter->where.line);
  line = line.substr(0, line.find('#'));
  const std::size_t equals = line.find('=');
  return equals != std::string_view::npos && names_degrees(line.substr(equals));
}

AimTask task_of(const AimArguments& arguments, std::vector<ShownUnknown>& shown) {
  if (arguments.hit.empty() == arguments.at.empty())
    throw InputError({arguments.hit.empty() ? "--hit" : "--at"},
                     "a target expected: either --hit OBSTACLE or --at X,Y,Z");
  AimTask task;
  task.scene = read_named_scene(arguments.scene);
  const std::string scene_text = text_of(arguments.scene);
  apply(arguments.overrides, task.scene);
  for (const std::string& text : arguments.vary) {
    GridAxis axis = read_range(text, "--vary", task.scene);
    const SourceLocation where{"--vary " + axis.quantity.name};
    if (axis.count != 0)
      throw InputError(where, "the ends of a range expected, LOW:HIGH: numbers of values are for sweeps");
    for (const ShownUnknown& other : shown)
      if (other.name == axis.quantity.name) throw InputError({"--vary"}, "'" + other.name + "' varies twice");
    shown.push_back({axis.quantity.name, is_in_degrees(text, axis.quantity.name, task.scene, scene_text)});
    task.unknowns.push_back({std::move(axis.quantity), axis.low, axis.high});
  }
  if (arguments.hit.empty())
    task.target = read_point(arguments.at, "--at", task.scene);
  else
    task.target = arguments.hit;
  task.body = arguments.body;
  task.conditions = arguments.with;
  task.minimise = arguments.minimise;
  return task;
}

}  // namespace

int aim_command(const AimArguments& arguments) {
  check_outputs(arguments.scene, {{"--json", arguments.json, {".json"}}});
  std::vector<ShownUnknown> shown;
  const AimTask task = task_of(arguments, shown);
  let_signals_end_runs();
  const AimResult result = aim(task, is_end_wanted);

  const auto write = [](const std::string& path, const std::string& text) {
    OutputFile file(path);
    file.write(text);
    file.finish();
  };
  if (!arguments.json.empty()) write(arguments.json, aim_json(task, result));
  if (!arguments.quiet && arguments.json != "-")
    write("-", aim_text(task.scene.title, shown, result, wants_color(stdout), text_width(stdout)));
  for (const std::string& warning : task.scene.warnings) tell_warning(warning);
  if (result.is_family)
    tell_warning(
        "there are more unknowns than conditions: these are some of infinitely many solutions; --minimise EXPR "
        "finds the best one");
  if (result.is_interrupted) {
    tell_error(result.status == AimStatus::found ? "interrupted: there may be more solutions"
                                                 : aim_failure(shown, result));
    return kInterrupted;
  }
  if (result.status == AimStatus::found) return kDone;
  tell_error(aim_failure(shown, result));
  return kNumbersFailed;
}

}  // namespace trajet
