#include "obstacle_maker.hpp"

#include <utility>

#include "drive_maker.hpp"
#include "scene_numbers.hpp"
#include "solid_maker.hpp"
#include "surface_maker.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

bool is_in_pair(const Scene& scene, const std::string& name) {
  return ranges::any_of(scene.pairs,
                        [&](const PairDefinition& pair) { return pair.first == name || pair.second == name; });
}

}  // namespace

bool may_turn_bodies(const Scene& scene, const World& world) {
  const auto sticks = [](const auto& each) { return each.on_hit == OnHit::stick; };
  const bool pair_sticks = ranges::any_of(scene.pairs, sticks);
  return ranges::any_of(world.obstacles, [&](const World::Obstacle& each) {
    return each.drive && each.drive->turns && (pair_sticks || sticks(each.surface));
  });
}

void make_obstacles(const Scene& scene, const ParameterSet& parameters, World& world) {
  const SceneNumbers numbers(parameters.symbols);
  Symbols starting(&parameters.symbols);
  starting.set_constant("t", world.epoch);
  const SceneNumbers at_start(starting);
  world.obstacles.reserve(scene.obstacles.size());
  for (const ObstacleDefinition& obstacle : scene.obstacles) {
    std::vector<World::Obstacle> made = make_obstacles(obstacle, numbers, at_start);
    Surface surface{.on_hit = obstacle.on_hit};
    set_restitution(obstacle.restitution, "obstacle '" + obstacle.name + "'", numbers, surface);
    set_friction(obstacle.friction, "obstacle '" + obstacle.name + "'", numbers, surface);
    if (obstacle.restitution && obstacle.on_hit != OnHit::bounce && !is_in_pair(scene, obstacle.name))
      world.warnings.push_back("obstacle '" + obstacle.name +
                               "' has a restitution, which nothing needs: its on_hit is not \"bounce\"");
    const auto drive = make_drive(obstacle, parameters.symbols, at_start, world.epoch);
    for (World::Obstacle& each : made) {
      each.drive = drive;
      each.surface = surface;
      world.obstacles.push_back(std::move(each));
    }
  }
}

}  // namespace trajet
