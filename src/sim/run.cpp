#include "trajet/sim/run.hpp"

#include <chrono>

#include "simulation.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

void check(const Scene& scene) { static_cast<void>(make_world(scene)); }

RunResult run(const Scene& scene, RunObserver* observer) { return run(make_world(scene), observer); }

RunResult run(const World& world, RunObserver* observer) {
  const auto begin = std::chrono::steady_clock::now();
  RunObserver unobserved;
  RunResult result = Simulation(world, observer != nullptr ? *observer : unobserved).run();
  result.statistics.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace trajet
