#pragma once

#include <functional>
#include <string_view>

#include "trajet/law/dimension.hpp"
#include "trajet/law/expression.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet::detail {

/// A key of a scene that holds a formula.
struct SceneKey {
  Dimension dimension;
  std::function<void(Expression)> set;
};

/// The key THING.KEY of a body, an obstacle or an extra state: `ball.velocity`, `ground.restitution`. Throws InputError
/// at `where`, with the nearest name, if there is none.
SceneKey find_key(Scene& scene, std::string_view name, const SourceLocation& where);

}  // namespace trajet::detail
