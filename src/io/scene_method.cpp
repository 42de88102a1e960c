#include "scene_method.hpp"

#include <array>

#include "scene_tables.hpp"
#include "trajet/rigid/orientation.hpp"

namespace trajet::detail {

MethodOptions read_method(const TableReader& table) {
  const Keys keys = method_keys();
  table.check_keys(names(keys));
  MethodOptions method;
  method.where = table.where("name");
  if (table.has("name")) method.name = table.text("name");
  method.rtol = table.optional_scalar("rtol", kDimensionless);
  method.atol = table.optional_scalar("atol", kDimensionless);
  method.step = table.optional_scalar("step", kTime);
  method.max_step = table.optional_scalar("max_step", kTime);
  if (table.has("steps")) method.steps = table.scalar_list("steps", kTime);
  if (method.step && !method.steps.empty()) table.fail("steps", "'step' or 'steps' expected, not both");
  constexpr long kMaxOrder = 1000;  // far beyond any use; keeps it an int
  const long order = table.whole_number("order", 1, 0);
  method.order_where = table.where("order");
  if (order > kMaxOrder) table.fail("order", "an order of at most " + std::to_string(kMaxOrder) + " expected");
  method.order = static_cast<int>(order);
  method.max_steps = table.whole_number("max_steps", 1, method.max_steps);
  method.max_seconds = table.optional_scalar("max_seconds", kTime);
  std::vector<std::string_view> orientations;
  for (const OrientationInfo& info : orientation_ways()) orientations.push_back(info.name);
  method.orientation_where = table.where("orientation");
  const OrientationInfo* alias = table.has("orientation") ? find_orientation_way(table.text("orientation")) : nullptr;
  method.orientation =
      alias != nullptr ? alias->way : orientation_ways()[table.choice("orientation", orientations, 0)].way;
  method.locate = std::array{Locator::polynomial, Locator::interpolation,
                             Locator::subdivision}[table.choice("locate", words(keys, "locate"), 0)];
  method.simultaneous = std::array{Simultaneous::reflections,
                                   Simultaneous::group}[table.choice("simultaneous", words(keys, "simultaneous"), 0)];
  return method;
}

CrossingDirection read_direction(const TableReader& table) {
  return std::array{CrossingDirection::rising, CrossingDirection::falling,
                    CrossingDirection::any}[table.choice("direction", words(event_keys(), "direction"), 2)];
}

}  // namespace trajet::detail
