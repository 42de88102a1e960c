#include "obstacle_maker.hpp"

#include <utility>

#include "drive_maker.hpp"
#include "restitution_maker.hpp"
#include "scene_numbers.hpp"
#include "solid_maker.hpp"

namespace trajet {

void make_obstacles(const Scene& scene, const ParameterSet& parameters, World& world) {
  const SceneNumbers numbers(parameters.symbols);
  Symbols starting(&parameters.symbols);
  starting.set_constant("t", world.epoch);
  const SceneNumbers at_start(starting);
  world.obstacles.reserve(scene.obstacles.size());
  for (const ObstacleDefinition& obstacle : scene.obstacles) {
    std::vector<World::Obstacle> made = make_obstacles(obstacle, numbers, at_start);
    set_restitution(obstacle, parameters.symbols, numbers, made, world.warnings);
    const auto drive = make_drive(obstacle, parameters.symbols, at_start, world.epoch);
    for (World::Obstacle& each : made) {
      each.drive = drive;
      world.obstacles.push_back(std::move(each));
    }
  }
}

}  // namespace trajet
