#include "restitution_maker.hpp"

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

}  // namespace trajet
