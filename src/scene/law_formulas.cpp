#include "law_formulas.hpp"

namespace trajet {

void add_formulas(const BodyDefinition& definition, const World::Body& body, int index,
                  std::vector<World::LawFormula>& formulas) {
  const auto add = [&](std::string_view key, const std::optional<Expression>& formula, int first) {
    if (formula) formulas.push_back({key, index, first, 3, *formula});
  };
  add("position_rate", definition.position_rate, body.offset);
  add("acceleration", definition.acceleration, body.offset + 3);
  add("force", definition.force, body.offset + 3);
  if (definition.force) add("mass", definition.mass, body.offset + 3);
  if (!body.rotation) return;
  const int spin = body.rotation->offset + body.rotation->layout.size();
  add("angular_acceleration", definition.angular_acceleration, spin);
  add("angular_acceleration_body", definition.angular_acceleration_body, spin);
  add("torque", definition.torque, spin);
  add("torque_body", definition.torque_body, spin);
  add("force_point", definition.force_point, spin);
}

}  // namespace trajet
