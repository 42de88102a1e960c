#pragma once

#include "trajet/scene/scene.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// Checks a scene completely without running it: names, dimensions, values. Throws InputError that points at the place.
void check(const Scene& scene);

/// Computes the motion of a scene. Throws InputError where the scene is wrong; numerical failure is a status of the
/// result.
RunResult run(const Scene& scene, RunObserver* observer = nullptr);
/// The same for a scene that has its numbers already.
RunResult run(const World& world, RunObserver* observer = nullptr);

}  // namespace trajet
