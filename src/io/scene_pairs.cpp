#include <array>

#include "scene_solids.hpp"
#include "scene_tables.hpp"
#include "trajet/portable.hpp"

namespace trajet::detail {

OnHit read_on_hit(const TableReader& table) {
  return std::array{OnHit::stop, OnHit::bounce, OnHit::pass,
                    OnHit::stick}[table.choice("on_hit", words(obstacle_keys(), "on_hit"), 0)];
}

std::shared_ptr<const FrictionDefinition> read_friction(const TableReader& table) {
  const Keys keys = friction_keys();
  if (ranges::none_of(keys, [&](const Key& key) { return table.has(key.name); })) return nullptr;
  FrictionDefinition friction{table.optional_scalar("friction", kDimensionless),
                              table.optional_scalar("tangential_restitution", kDimensionless),
                              table.optional_scalar("rolling_friction", kLength),
                              table.optional_scalar("spinning_friction", kLength)};
  if (table.has("impact"))
    friction.impact = std::array{ImpactLaw::stronge, ImpactLaw::poisson,
                                 ImpactLaw::newton}[table.choice("impact", words(keys, "impact"), 0)];
  return std::make_shared<const FrictionDefinition>(std::move(friction));
}

CollidesWith read_collides_with(const TableReader& table) {
  using Kind = CollidesWith::Kind;
  CollidesWith result;
  if (!table.has("collides_with")) return result;
  result.where = table.where("collides_with");
  if (table.is_array("collides_with")) {
    result.kind = Kind::listed;
    result.names = table.texts("collides_with");
  } else {
    result.kind = std::array{Kind::all, Kind::obstacles,
                             Kind::none}[table.choice("collides_with", words(body_keys(), "collides_with"), 0)];
  }
  return result;
}

PairDefinition read_pair(const TableReader& table) {
  table.check_keys(detail::names(pair_keys()) + detail::names(friction_keys()));
  const std::vector<std::string> names = table.texts("of");
  if (names.size() != 2) table.fail("of", "'of': two names expected, got " + std::to_string(names.size()));
  PairDefinition pair{.first = names[0], .second = names[1]};
  pair.where = table.where("of");
  if (table.has("on_hit")) pair.on_hit = read_on_hit(table);
  pair.restitution = table.optional_scalar("restitution", kDimensionless);
  pair.friction = read_friction(table);
  return pair;
}

}  // namespace trajet::detail
