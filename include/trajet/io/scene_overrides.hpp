#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trajet/scene/scene.hpp"

namespace trajet {

/// What a command line changes in a scene. Values are written as in scene files: numbers, quantities, expressions.
struct SceneOverrides {
  std::vector<std::string> parameters{};  ///< NAME=VALUE each
  std::optional<std::string> method{};
  std::optional<std::string> step{};
  std::optional<int> order{};
  std::optional<std::string> rtol{};
  std::optional<std::string> atol{};
  std::optional<std::string> end{};
  std::optional<std::string> orientation{};
};

/// The way of carrying orientations of that name or alias. Throws InputError at `where`, with the nearest name.
OrientationWay orientation_way(const std::string& name, const SourceLocation& where);

/// Replaces those parts of the scene. A `step` takes the place of `steps`.
///
/// Throws InputError whose place is the option: `--set NAME`, `--end`.
void apply(const SceneOverrides& overrides, Scene& scene);

}  // namespace trajet
