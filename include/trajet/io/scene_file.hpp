#pragma once

#include <string>

#include "trajet/scene/scene.hpp"

namespace trajet {

/// Reads a scene file: docs/formats/scene.md. Throws FileError if it cannot be read, InputError that points at the line
/// and column of what is wrong in it: syntax, keys, types, units, names. What the expressions mean is checked by
/// `check`.
Scene read_scene(const std::string& path);

/// The same for a text; `file` names it in errors.
Scene parse_scene(std::string text, const std::string& file);

}  // namespace trajet
