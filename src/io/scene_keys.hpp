#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "trajet/law/dimension.hpp"
#include "trajet/law/expression.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet::detail {

/// A key of a scene that holds a formula, or a word.
struct SceneKey {
  std::optional<Dimension> dimension{};                ///< of the formula; none: any
  std::function<void(Expression)> set{};               ///< of a formula
  std::function<void(const std::string&)> set_word{};  ///< of a word: throws InputError where it is none of the key's
};

/// The key THING.KEY of a body, an obstacle, an extra state or an event, or KEY of [time] and [method]:
/// `ball.velocity`, `ground.restitution`, `ground.on_hit`, `time.end`. Throws InputError at `where`, with the nearest
/// name, if there is none.
SceneKey find_key(Scene& scene, std::string_view name, const SourceLocation& where);

}  // namespace trajet::detail
