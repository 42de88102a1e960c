#include "start_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "trajet/geom/box_tree.hpp"
#include "trajet/geom/cavity.hpp"
#include "trajet/geom/distance.hpp"
#include "trajet/geom/ellipsoid_distance.hpp"
#include "trajet/geom/landscape.hpp"
#include "trajet/geom/revolution_distance.hpp"
#include "trajet/geom/solid_overlap.hpp"
#include "trajet/geom/triangle_surface.hpp"
#include "trajet/text/shortest_text.hpp"

namespace trajet {
namespace {

/// m; how far p is outside the matter of a shape, negative inside; of a thin shape its distance.
double gap(const Shape& shape, const Vector3& p) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { signed_distance(s, p); }) {
          return signed_distance(s, p);
        } else {
          return distance(s, p);
        }
      },
      shape);
}

Vector3 start_of(const World& world, const World::Body& body) {
  return body.slice().position(world.groups[static_cast<std::size_t>(body.group)].start);
}

/// Throws where two bodies that meet overlap.
void check_starts_of_bodies(const World& world) {
  std::vector<Aabb> boxes;
  for (const World::Body& body : world.bodies) {
    const Vector3 position = start_of(world, body);
    boxes.push_back(grown({position, position}, bounding_radius(body.solid)));
  }
  const BoxTree tree(boxes);
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const World::Body& body = world.bodies[i];
    const PlacedSolid placed{body.solid, start_of(world, body), rotation_matrix(body.q_WB)};
    tree.visit_overlapping(boxes[i], [&](int index) {
      const World::Body& other = world.bodies[static_cast<std::size_t>(index)];
      const int first = static_cast<int>(i);
      // meshes may be hollow: what lies in their hull is for the run to see
      const bool is_mesh = std::holds_alternative<Mesh>(body.solid) || std::holds_alternative<Mesh>(other.solid);
      if (index <= first || is_mesh || !world.bodies_meet(first, index)) return true;
      if (world.surface_of_bodies(first, index).on_hit != OnHit::pass &&
          overlap(placed, {other.solid, start_of(world, other), rotation_matrix(other.q_WB)}))
        throw InputError(other.where, "bodies '" + body.name + "' and '" + other.name +
                                          "' overlap at the start: move them apart, or let them not meet with " +
                                          "collides_with = \"obstacles\"");
      return true;
    });
  }
}

}  // namespace

void check_fits(const World& world) {
  for (std::size_t b = 0; b < world.bodies.size(); ++b) {
    const World::Body& body = world.bodies[b];
    const double radius = bounding_radius(body.solid);
    for (std::size_t o = 0; o < world.obstacles.size(); ++o) {
      const World::Obstacle& obstacle = world.obstacles[o];
      const auto* cavity = std::get_if<Cavity>(&obstacle.shape);
      const bool is_terrain = std::holds_alternative<Terrain>(obstacle.shape);
      if ((cavity == nullptr && !is_terrain) || !world.meets_obstacle(static_cast<int>(b), static_cast<int>(o)))
        continue;
      const std::string names = "body '" + body.name + "' and obstacle '" + obstacle.name + "'";
      if (is_terrain && radius > 0.0)
        throw InputError(
            body.where,
            names + ": a terrain is met by points only; for a body with extent make the ground " + "of shape \"mesh\"");
      if (cavity == nullptr) continue;
      if (!is_round(body.solid) && std::holds_alternative<Surroundings>(obstacle.solid))
        throw InputError(body.where,
                         names + ": the curved walls of what is hollow are met by points and balls only, " +
                             "the flat ones of a hollow box with on_hit = \"bounce\" or \"stick\" by all bodies");
      if (radius >= largest_ball(*cavity))
        throw InputError(body.where, names +
                                         ": the ball is too large for the inside, whose walls are met by balls of a " +
                                         "radius below " + shortest_text(largest_ball(*cavity)) +
                                         " m only, their least " + "radius of curvature");
    }
  }
}

void check_starts(const World& world) {
  constexpr double kRounding = 1e-9;  // of the lengths that the gap is made of, and far above what they round to
  for (std::size_t b = 0; b < world.bodies.size(); ++b) {
    const World::Body& body = world.bodies[b];
    if (!is_round(body.solid)) continue;
    const Vector3 position = start_of(world, body);
    const double radius = bounding_radius(body.solid);
    const double open = kRounding * (position.norm() + radius);
    for (std::size_t o = 0; o < world.obstacles.size(); ++o) {
      const World::Obstacle& obstacle = world.obstacles[o];
      if (gap(obstacle.shape, position) - radius >= -open) continue;
      if (world.meets_obstacle(static_cast<int>(b), static_cast<int>(o)) &&
          world.surface(static_cast<int>(b), static_cast<int>(o)).on_hit != OnHit::pass)
        throw InputError(body.where, "body '" + body.name + "' starts inside obstacle '" + obstacle.name + "'");
    }
  }
  check_starts_of_bodies(world);
}

void warn_of_coarse_times(World& world, double end) {
  constexpr double kCoarse = 1e-10;  // of the run
  const double latest = std::max(std::abs(world.epoch), std::abs(end));
  const double spacing = std::nextafter(latest, std::numeric_limits<double>::infinity()) - latest;
  const double duration = std::abs(world.duration);
  if (duration > 0.0 && spacing > kCoarse * duration)
    world.warnings.push_back("times near " + shortest_text(latest) + " s are numbers " + shortest_text(spacing) +
                             " s apart: reports cannot say more closely when something was; let the run start at 0");
}

}  // namespace trajet
