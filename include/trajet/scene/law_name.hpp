#pragma once

#include <string>

#include "trajet/scene/world.hpp"

namespace trajet {

/// A place as sentences have it: "scene.toml:8:17"; empty where it is not known.
std::string place_text(const SourceLocation& where);

/// What people call a formula of a group: "acceleration of body 'ball'".
std::string name_of(const World& world, int group, const World::LawFormula& formula);

/// The same with its place and its text: "acceleration of body 'ball' (scene.toml:8:17: -g/x)".
std::string name_with_place(const World& world, int group, const World::LawFormula& formula);

/// The formula from which a component of a group's rate is computed; of several the last one, nullptr if there is none.
const World::LawFormula* find_formula(const World& world, int group, int component);

}  // namespace trajet
