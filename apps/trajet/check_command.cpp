#include <fmt/format.h>

#include "commands.hpp"
#include "message.hpp"
#include "scene_source.hpp"
#include "trajet/io/output_file.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

int check_command(const RunArguments& arguments) {
  Scene scene = read_named_scene(arguments.scene);
  apply(arguments.overrides, scene);
  for (const std::string& warning : make_world(scene).warnings) tell_warning(warning);
  if (arguments.quiet) return kDone;
  OutputFile out("-");
  out.write(fmt::format("{}: valid; bodies: {}, obstacles: {}, extra states: {}, events: {}\n", arguments.scene,
                        scene.bodies.size(), scene.obstacles.size(), scene.states.size(), scene.events.size()));
  out.finish();
  return kDone;
}

}  // namespace trajet
