#include "ties.hpp"

#include <algorithm>
#include <cmath>

#include "impact_record.hpp"

#include "trajet/portable.hpp"

namespace trajet {
namespace {

const World::Obstacle& obstacle_of(const World& world, const Pair& pair) {
  return world.obstacles[static_cast<std::size_t>(pair.id.obstacle)];
}

const Surface& surface_of(const World& world, const Pair& pair) {
  return world.surface(pair.id.body, pair.id.obstacle);
}

const Pair& pair_of(const Encounters& encounters, PairId id) {
  return *ranges::find(encounters.pairs(id.body), id, &Pair::id);
}

}  // namespace

PairId first_to_handle(const World& world, const Encounters& encounters, const Pair& contact) {
  // what sticks does not come to bounce
  for (const OnHit first : {OnHit::stick, OnHit::bounce}) {
    const auto is_first = [&](const Pair& pair) {
      return surface_of(world, pair).on_hit == first && is_hit(pair.contact);
    };
    if (is_first(contact)) return contact.id;
    for (const PairId id : encounters.met_at_once(contact))
      if (is_first(pair_of(encounters, id))) return id;
  }
  return contact.id;
}

void warn_of_hidden_ties(const World& world, const Encounters& encounters, const Pair& handled, const Impact& impact,
                         const Course& course, Recorder& recorder) {
  for (const int body : course.group().bodies) {
    if (surface_of(world, handled).on_hit == OnHit::bounce && body != handled.id.body) continue;
    for (const Pair& other : encounters.pairs(body)) {
      if (other.id == handled.id || other.contact.status != ContactStatus::hit) continue;
      if (std::abs(other.contact.time - impact.elapsed) <= impact.time_error_bound + other.contact.time_error_bound)
        recorder.warn_of_tie(impact, world.bodies[static_cast<std::size_t>(body)].name, obstacle_of(world, other).name);
    }
  }
}

bool settle_other_contacts(const World& world, Encounters& encounters, const Pair& handled, const Impact& impact,
                           Instant& instant, Recorder& recorder) {
  bool stops = false;
  const Eigen::VectorXd rate = instant.rate();
  for (const PairId id : encounters.met_at_once(handled)) {
    const Pair& pair = pair_of(encounters, id);
    const Vector3 velocity = encounters.relative_motion(id, instant.time(), instant.q, rate).velocity;
    // of the two products of speeds and normals by which the bounce came about
    const double rounding = 16.0 * kUnitRoundoff * (velocity.norm() + impact.velocity_before.norm());
    if (velocity.dot(pair.contact.normal) < -rounding) continue;
    ContactMemory memory = pair.contact.memory;
    memory.side = pair.contact.side_before;
    memory.contact_time = impact.elapsed;
    instant.memories.emplace_back(id, memory);
    const OnHit on_hit = surface_of(world, pair).on_hit;
    if ((on_hit == OnHit::bounce || on_hit == OnHit::stick) && is_hit(pair.contact)) continue;
    Impact passed = describe(world, pair, encounters.frame(id.obstacle, impact.elapsed), instant.before());
    passed.elapsed = impact.elapsed;
    recorder.impact(passed);
    stops = stops || (on_hit == OnHit::stop && is_hit(pair.contact));
  }
  return stops;
}

}  // namespace trajet
