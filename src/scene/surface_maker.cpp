#include "surface_maker.hpp"

#include "trajet/law/program_builder.hpp"
#include "trajet/portable.hpp"

namespace trajet {

namespace {

RestitutionLaw make_restitution(const Expression& formula, const std::string& what, const SceneNumbers& numbers) {
  const std::string speed = "u";
  if (!ranges::any_of(formula.names(), [&](const std::string& name) { return name == speed; }))
    return numbers.within(formula, 0.0, 1.0, "restitution of " + what);
  if (numbers.constants().find(speed) != nullptr)
    throw InputError(formula.where(), "in a restitution `u` is the speed of approach: call the parameter otherwise");
  Symbols symbols(&numbers.constants());
  symbols.set_input(speed, 1);
  ProgramBuilder program(2);
  program.add_output(program.compile_scalar(formula, symbols));
  return RestitutionLaw(program.build());
}

}  // namespace

void set_restitution(const std::optional<Expression>& formula, const std::string& what, const SceneNumbers& numbers,
                     Surface& surface) {
  if (!formula) return;
  surface.restitution = make_restitution(*formula, what, numbers);
  surface.restitution_where = formula->where();
}

void set_friction(const std::shared_ptr<const FrictionDefinition>& definition, const std::string& what,
                  const SceneNumbers& numbers, Surface& surface) {
  if (!definition) return;
  const auto set = [&](const std::optional<Expression>& given, const char* key, double& value) {
    if (given) value = numbers.not_negative(*given, std::string(key) + " of " + what);
  };
  set(definition->friction, "friction", surface.friction);
  set(definition->rolling_friction, "rolling_friction", surface.rolling_friction);
  set(definition->spinning_friction, "spinning_friction", surface.spinning_friction);
  if (definition->tangential_restitution)
    surface.tangential_restitution =
        numbers.within(*definition->tangential_restitution, -1.0, 1.0, "tangential_restitution of " + what);
  if (definition->impact) surface.impact = *definition->impact;
}

}  // namespace trajet
