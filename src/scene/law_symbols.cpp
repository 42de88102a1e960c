#include "law_symbols.hpp"

#include "body_maker.hpp"
#include "scene_symbols.hpp"

namespace trajet {

Symbols group_symbols(const World& world, int group, const Symbols& outer, ProgramBuilder& builder) {
  Symbols symbols(&outer);
  symbols.set_node("t", builder.clock(world.epoch));
  for (const int index : world.groups[static_cast<std::size_t>(group)].bodies) {
    const World::Body& body = world.bodies[static_cast<std::size_t>(index)];
    add_body_symbols(symbols, body.name + ".", 1 + body.offset);
    add_rotation_symbols(symbols, body.name + ".", body, builder);
  }
  for (const World::ExtraState& state : world.states)
    if (state.group == group) symbols.set_input(state.name, 1 + state.offset);
  return symbols;
}

Symbols own_symbols(const World::Body& body, const Symbols& group_scope, ProgramBuilder& builder) {
  Symbols own(&group_scope);
  add_body_symbols(own, "", 1 + body.offset);
  add_rotation_symbols(own, "", body, builder);
  return own;
}

}  // namespace trajet
