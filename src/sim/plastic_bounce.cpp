#include "plastic_bounce.hpp"

#include "impact_record.hpp"
#include "ties.hpp"
#include "trajet/collide/respond/plastic_group.hpp"
#include "trajet/portable.hpp"

namespace trajet {

std::vector<Impact> bounce_plastic(const World& world, const Encounters& encounters, const Pair& handled,
                                   const Impact& impact, double mass, Instant& instant) {
  const auto is_plastic = [&](const Pair& pair) {
    const World::Obstacle& obstacle = world.obstacles[static_cast<std::size_t>(pair.id.obstacle)];
    const Surface& surface = world.surface(pair.id.body, pair.id.obstacle);
    return is_hit(pair.contact) && surface.on_hit == OnHit::bounce && surface.restitution.is_constant(0.0) &&
           !obstacle.drive;
  };
  if (!is_plastic(handled)) return {};
  std::vector<Impact> impacts{impact};
  for (const PairId id : encounters.met_at_once(handled)) {
    const Pair& other = *ranges::find(encounters.pairs(id.body), id, &Pair::id);
    if (!is_plastic(other)) continue;
    impacts.push_back(describe(world, other, std::nullopt, instant.before()));
    impacts.back().elapsed = impact.elapsed;
  }
  const int offset = world.bodies[static_cast<std::size_t>(handled.id.body)].offset;
  std::vector<Vector3> normals;
  for (const Impact& each : impacts) normals.push_back(each.normal);
  for (const RestingContact& contact : instant.contacts)
    if (contact.offset == offset) normals.push_back(contact.normal);
  if (normals.size() == 1) return {};

  const std::vector<double> impulses = plastic_impulses(normals, instant.rate().segment<3>(offset));
  auto velocity = instant.q.segment<3>(offset + 3);
  std::vector<Vector3> pushing;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vector3 before = velocity;
    velocity += impulses[i] * normals[i];
    if (impulses[i] > 0.0) pushing.push_back(normals[i]);
    if (i >= impacts.size()) continue;
    impacts[i].velocity_before = before;
    impacts[i].velocity_after = velocity;
    impacts[i].impulse = mass * impulses[i] * normals[i];
  }
  for (const Vector3& direction : support(pushing).blocked)
    for (const int first : {offset, offset + 3}) {
      auto rows = instant.derivative.middleRows<3>(first);
      rows -= direction * (direction.transpose() * rows).eval();
    }
  return impacts;
}

}  // namespace trajet
