#pragma once

#include <memory>
#include <optional>
#include <string>

#include "scene_numbers.hpp"
#include "trajet/scene/surface.hpp"

namespace trajet {

/// Gives a surface the restitution of a definition, if there is one: a number or a formula of the speed of approach
/// `u`. `what` names it in messages: "obstacle 'ground'". Throws InputError at what is wrong with it.
void set_restitution(const std::optional<Expression>& formula, const std::string& what, const SceneNumbers& numbers,
                     Surface& surface);

/// The same of its friction, as far as the definition tells it.
void set_friction(const std::shared_ptr<const FrictionDefinition>& definition, const std::string& what,
                  const SceneNumbers& numbers, Surface& surface);

}  // namespace trajet
