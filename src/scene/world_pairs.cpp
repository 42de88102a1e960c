#include <cmath>

#include "trajet/portable.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {
namespace {

const World::Body& body(const World& world, int index) { return world.bodies[static_cast<std::size_t>(index)]; }

bool lets(const Company& company, int other) {
  return company.has_all_bodies || ranges::binary_search(company.bodies, other);
}

/// The geometric mean with the sign of both; of numbers of opposite signs 0.
double mean_of_signs(double a, double b) { return a * b > 0.0 ? std::copysign(std::sqrt(a * b), a) : 0.0; }

}  // namespace

bool World::meets_obstacle(int index, int obstacle) const {
  const Company& company = body(*this, index).company;
  return company.has_all_obstacles || ranges::binary_search(company.obstacles, obstacle);
}

bool World::bodies_meet(int first, int second) const {
  const Body &a = body(*this, first), &b = body(*this, second);
  const bool has_extent = bounding_radius(a.solid) > 0.0 || bounding_radius(b.solid) > 0.0;
  return has_extent && lets(a.company, second) && lets(b.company, first);
}

const Surface& World::surface(int index, int obstacle) const {
  const auto own = obstacle_pairs.find({index, obstacle});
  return own != obstacle_pairs.end() ? own->second : obstacles[static_cast<std::size_t>(obstacle)].surface;
}

Surface World::surface_of_bodies(int first, int second) const {
  const auto own = body_pairs.find(std::minmax(first, second));
  if (own != body_pairs.end()) return own->second;
  const Surface &a = body(*this, first).surface, &b = body(*this, second).surface;
  Surface surface{.on_hit = OnHit::bounce,
                  .restitution = RestitutionLaw::mean(a.restitution, b.restitution),
                  .restitution_where = b.restitution_where.line > 0 ? b.restitution_where : a.restitution_where,
                  .friction = std::sqrt(a.friction * b.friction),
                  .rolling_friction = std::sqrt(a.rolling_friction * b.rolling_friction),
                  .spinning_friction = std::sqrt(a.spinning_friction * b.spinning_friction),
                  .impact = a.impact != ImpactLaw::stronge ? a.impact : b.impact};
  if (a.tangential_restitution && b.tangential_restitution)
    surface.tangential_restitution = mean_of_signs(*a.tangential_restitution, *b.tangential_restitution);
  return surface;
}

}  // namespace trajet
