#include "trajet/scene/law_name.hpp"

#include "trajet/portable.hpp"

namespace trajet {

std::string place_text(const SourceLocation& where) {
  std::string place = where.file.str();
  if (where.line > 0)
    place += (place.empty() ? "" : ":") + std::to_string(where.line) + ":" + std::to_string(where.column);
  return place;
}

std::string name_of(const World& world, int group, const World::LawFormula& formula) {
  const std::string key(formula.key);
  if (formula.body >= 0) return key + " of body '" + world.bodies[static_cast<std::size_t>(formula.body)].name + "'";
  const auto state = ranges::find_if(
      world.states, [&](const World::ExtraState& each) { return each.group == group && each.offset == formula.first; });
  return key + " of state '" + state->name + "'";
}

std::string name_with_place(const World& world, int group, const World::LawFormula& formula) {
  constexpr std::size_t kLongest = 80;  // what is longer is seen at its place
  std::string text = formula.text.text();
  if (text.size() > kLongest) text = text.substr(0, kLongest) + " …";
  std::string place = place_text(formula.text.where());
  if (!place.empty()) place += ": ";
  return name_of(world, group, formula) + " (" + place + text + ")";
}

const World::LawFormula* find_formula(const World& world, int group, int component) {
  const auto& formulas = world.groups[static_cast<std::size_t>(group)].formulas;
  const auto found = ranges::find_if(formulas.rbegin(), formulas.rend(), [&](const World::LawFormula& each) {
    return component >= each.first && component < each.first + each.size;
  });
  return found == formulas.rend() ? nullptr : &*found;
}

}  // namespace trajet
