#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "trajet/law/dimension.hpp"

namespace trajet::detail {

/// In which form a scene file gives a value.
enum class ValueForm {
  text,
  flag,          ///< true or false
  whole_number,  ///< at least 1
  word,          ///< one of Key::words
  names,         ///< an array of texts
  scalar,        ///< a number, a quantity or a formula
  vector,        ///< three of them, or one formula
  formula,       ///< a scalar or a vector
  scalars,       ///< an array of scalars: Key::count
  vectors,       ///< an array of vectors: Key::count
  orientation,   ///< a table, kOrientationKeys
  formulas,      ///< a table of formulas by name
  setting,       ///< a table with one key, `set`, that is such a table
  named_points,  ///< a table of vectors by name
  parts,         ///< an array of tables, kPartKeys and the keys of the part's shape
  closed_forms,  ///< a table: formulas and orientations by name, the names also as tables of their parts
  table,         ///< a table with keys of its own
  tables,        ///< an array of them
};

/// A key of a table of a scene file: what readers know, and what the schema says.
struct Key {
  std::string_view name;
  ValueForm form;
  std::string_view meaning;  ///< for people, one line, without the unit
  std::optional<Dimension> dimension{};
  std::vector<std::string_view> words{};  ///< of ValueForm::word
  int count = 0;                          ///< of arrays: exactly so many; 0: any number, at least one
  bool is_required = false;
  std::optional<ValueForm> other_form{};  ///< that is read too
};

/// A table of a scene file.
using Keys = std::span<const Key>;

/// Of the scene itself.
Keys scene_keys();
Keys time_keys();
Keys method_keys();
Keys state_keys();
Keys event_keys();
Keys pair_keys();
/// Of a body, whatever its shape.
Keys body_keys();
/// Of an obstacle, whatever its shape.
Keys obstacle_keys();
/// Of a part of a compound, whatever its shape.
Keys part_keys();
Keys orientation_keys();
/// Of a surface: of bodies, obstacles and pairs.
Keys friction_keys();
/// Of shapes: which shape has which, its kind says.
Keys shape_keys();

using Names = std::vector<std::string_view>;
Names names(Keys keys);
Names operator+(Names a, const Names& b);
/// The words of a key.
std::span<const std::string_view> words(Keys keys, std::string_view name);

/// A shape as scene files know it.
struct ShapeKind {
  std::string_view name;
  Names keys;  ///< all that it may have, beside those of every body or obstacle
  Names required;
};

/// The shapes of bodies, of obstacles and of the parts of compounds.
std::vector<ShapeKind> body_shapes();
std::vector<ShapeKind> obstacle_shapes();
std::vector<ShapeKind> part_shapes();

}  // namespace trajet::detail
