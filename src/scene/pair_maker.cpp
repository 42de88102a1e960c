#include "pair_maker.hpp"
#include "surface_maker.hpp"

#include <algorithm>
#include <string_view>

#include "trajet/portable.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {
namespace {

/// Bodies and obstacles of one name: an obstacle may be several.
struct Named {
  std::vector<int> bodies, obstacles;
};

template <class Things>
std::vector<int> indices_of(const Things& things, std::string_view name) {
  std::vector<int> found;
  for (std::size_t i = 0; i < things.size(); ++i)
    if (things[i].name == name) found.push_back(static_cast<int>(i));
  return found;
}

Named find(const World& world, std::string_view name, const SourceLocation& where) {
  Named found{indices_of(world.bodies, name), indices_of(world.obstacles, name)};
  if (!found.bodies.empty() || !found.obstacles.empty()) return found;
  std::vector<std::string_view> known;
  for (const World::Body& body : world.bodies) known.push_back(body.name);
  for (const World::Obstacle& obstacle : world.obstacles) known.push_back(obstacle.name);
  throw InputError(where, "there is no body or obstacle '" + std::string(name) + "'" + did_you_mean(name, known));
}

Company company_of(const World& world, const CollidesWith& given) {
  using Kind = CollidesWith::Kind;
  Company company{given.kind == Kind::all, given.kind == Kind::all || given.kind == Kind::obstacles};
  for (const std::string& name : given.names) {
    const Named named = find(world, name, given.where);
    company.bodies.insert(company.bodies.end(), named.bodies.begin(), named.bodies.end());
    company.obstacles.insert(company.obstacles.end(), named.obstacles.begin(), named.obstacles.end());
  }
  ranges::sort(company.bodies);
  ranges::sort(company.obstacles);
  return company;
}

}  // namespace

void make_companies(const Scene& scene, World& world) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    world.bodies[i].company = company_of(world, scene.bodies[i].collides_with);
}

void make_pairs(const Scene& scene, const SceneNumbers& numbers, World& world) {
  for (const PairDefinition& pair : scene.pairs) {
    const std::string names = "'" + pair.first + "' and '" + pair.second + "'";
    const auto change = [&](Surface& surface) {
      if (pair.on_hit) surface.on_hit = *pair.on_hit;
      set_restitution(pair.restitution, "the pair " + names, numbers, surface);
      set_friction(pair.friction, "the pair " + names, numbers, surface);
    };
    Named first = find(world, pair.first, pair.where), second = find(world, pair.second, pair.where);
    if (first.bodies.empty()) std::swap(first, second);
    if (first.bodies.empty()) throw InputError(pair.where, "obstacles " + names + " do not meet: a pair has a body");
    const int body = first.bodies[0];
    if (!second.bodies.empty()) {
      const int other = second.bodies[0];
      if (body == other) throw InputError(pair.where, "a pair has two different things");
      if (pair.on_hit == OnHit::stick)
        throw InputError(pair.where, "bodies " + names + " cannot stick to each other: how two bodies move on as one " +
                                         "is not computed; bodies stick to obstacles, and bounce with restitution = 0");
      Surface surface = world.surface_of_bodies(body, other);
      change(surface);
      if (!world.body_pairs.try_emplace(std::minmax(body, other), surface).second)
        throw InputError(pair.where, "the pair " + names + " is there twice");
    }
    for (const int obstacle : second.obstacles) {
      Surface surface = world.surface(body, obstacle);
      change(surface);
      if (!world.obstacle_pairs.try_emplace({body, obstacle}, surface).second)
        throw InputError(pair.where, "the pair " + names + " is there twice");
    }
  }
}

}  // namespace trajet
