#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "trajet/law/dimension.hpp"
#include "trajet/law/expression.hpp"
#include "trajet/scene/scene.hpp"
#include "value_reader.hpp"

namespace trajet::detail {

/// A key of a scene that holds a formula, or something else: a word, a table, an array.
struct SceneKey {
  std::optional<Dimension> dimension{};            ///< of the formula; none: any
  std::function<void(Expression)> set{};           ///< of a formula
  std::function<void(const TableReader&)> read{};  ///< of something else: from a table that has this key alone
};

/// The key THING.KEY of a body, an obstacle, an extra state or an event, or KEY of [time] and [method]:
/// `ball.velocity`, `ground.restitution`, `ground.on_hit`, `time.end`; keys of tables within: `ball.points.tip`,
/// `ball.parts[0].mass`; of pairs by their number, `pair[0].friction`; closed forms, `exact.ball.r`. Throws InputError
/// at `where`, with the nearest name, if there is none.
SceneKey find_key(Scene& scene, std::string_view name, const SourceLocation& where);

}  // namespace trajet::detail
