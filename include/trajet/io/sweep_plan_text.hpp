#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trajet/ensemble/sweep_plan.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet {

/// A plan of motions as users write it.
struct SweepPlanTexts {
  std::vector<std::string> vary{};       ///< NAME=LOW:HIGH:COUNT each
  std::vector<std::string> sample{};     ///< NAME=normal(MEAN,SD) each
  std::vector<std::string> correlate{};  ///< NAME,NAME=COEFFICIENT each
  std::optional<std::uint64_t> count{};  ///< of samples; none: 1000
  std::uint64_t seed = 0;
  std::string design = "random";  ///< random, lhs or sobol
};

/// The plan, for that scene. Throws InputError whose place is the option, `--vary theta`; adds warnings to the scene as
/// `read_range` does.
SweepPlan read_sweep_plan(const SweepPlanTexts& texts, Scene& scene);

}  // namespace trajet
