#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trajet/io/scene_overrides.hpp"
#include "trajet/io/sweep_plan_text.hpp"

namespace trajet {

/// What `trajet sweep` takes from the command line.
struct SweepArguments : SweepPlanTexts {
  std::string scene{};
  SceneOverrides overrides{};
  std::string report{};  ///< expressions, separated by commas; empty: those that suit the scene
  std::string out{};     ///< file name, `-` for standard output, empty for none
  std::string summary{};
  std::string plot{};
  std::string until{};
  std::string shard{};  ///< I/N
  std::optional<std::uint64_t> only{};
  int threads = 0;
  bool resume = false;
  bool quiet = false;
  std::string json{}, csv{}, html{}, glb{};  ///< of the one motion of `only`
};

/// Joins the tables of shards.
struct MergeArguments {
  std::vector<std::string> files{};
  std::string out{};
};

}  // namespace trajet
