#pragma once

#include "trajet/law/program_builder.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// What laws, rates and events of a group may use: the names of `outer`, time, and all that moves in the group. What
/// they compute becomes part of the builder's program where it is used.
Symbols group_symbols(const World& world, int group, const Symbols& outer, ProgramBuilder& builder);

/// The names of a body's own laws, beside those of its group.
Symbols own_symbols(const World::Body& body, const Symbols& group_scope, ProgramBuilder& builder);

}  // namespace trajet
