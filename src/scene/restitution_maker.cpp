#include "restitution_maker.hpp"

#include <string>

#include "trajet/law/program_builder.hpp"
#include "trajet/portable.hpp"

namespace trajet {

namespace {

RestitutionLaw make_restitution(const ObstacleDefinition& obstacle, const Expression& formula, const Symbols& constants,
                                const SceneNumbers& numbers) {
  const std::string speed = "u";
  if (!ranges::any_of(formula.names(), [&](const std::string& name) { return name == speed; }))
    return numbers.within(formula, 0.0, 1.0, "restitution of obstacle '" + obstacle.name + "'");
  if (constants.find(speed) != nullptr)
    throw InputError(formula.where(), "in a restitution `u` is the speed of approach: call the parameter otherwise");
  Symbols symbols(&constants);
  symbols.set_input(speed, 1);
  ProgramBuilder program(2);
  program.add_output(program.compile_scalar(formula, symbols));
  return RestitutionLaw(program.build());
}

}  // namespace

void set_restitution(const ObstacleDefinition& obstacle, const Symbols& constants, const SceneNumbers& numbers,
                     std::vector<World::Obstacle>& made, std::vector<std::string>& warnings) {
  if (!obstacle.restitution) return;
  for (World::Obstacle& each : made) {
    each.restitution = make_restitution(obstacle, *obstacle.restitution, constants, numbers);
    each.restitution_where = obstacle.restitution->where();
  }
  if (obstacle.on_hit != OnHit::bounce)
    warnings.push_back("obstacle '" + obstacle.name +
                       "' has a restitution, which nothing needs: its on_hit is not \"bounce\"");
}

}  // namespace trajet
