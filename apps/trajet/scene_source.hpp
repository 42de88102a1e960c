#pragma once

#include <string>

#include "trajet/scene/scene.hpp"

namespace trajet {

/// The scene that the command line names: a file, `-` for standard input, or else a built-in scene by its name.
/// Throws FileError where there is none, InputError at what is wrong in it.
Scene read_named_scene(const std::string& name);

/// The text of a file, of a built-in scene, or of standard input as it was read, by the name that the command line or a
/// message has for it. Empty where it cannot be had again.
std::string text_of(const std::string& name);

}  // namespace trajet
