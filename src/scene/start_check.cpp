#include "start_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "trajet/geom/cavity.hpp"
#include "trajet/geom/distance.hpp"
#include "trajet/geom/ellipsoid_distance.hpp"
#include "trajet/geom/landscape.hpp"
#include "trajet/geom/revolution_distance.hpp"
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

}  // namespace

void check_fits(const World& world) {
  for (const World::Body& body : world.bodies) {
    const double radius = bounding_radius(body.solid);
    for (const World::Obstacle& obstacle : world.obstacles) {
      const std::string names = "body '" + body.name + "' and obstacle '" + obstacle.name + "'";
      if (std::holds_alternative<Terrain>(obstacle.shape) && radius > 0.0)
        throw InputError(
            body.where,
            names + ": a terrain is met by points only; for a body with extent make the ground " + "of shape \"mesh\"");
      const auto* cavity = std::get_if<Cavity>(&obstacle.shape);
      if (cavity != nullptr && !is_round(body.solid) && std::holds_alternative<Surroundings>(obstacle.solid))
        throw InputError(body.where, names + ": the curved walls of what is hollow are met by points and balls only, " +
                                         "the flat ones of a hollow box with on_hit = \"bounce\" by all bodies");
      if (cavity == nullptr || radius < largest_ball(*cavity)) continue;
      throw InputError(body.where, names +
                                       ": the ball is too large for the inside, whose walls are met by balls of a " +
                                       "radius below " + shortest_text(largest_ball(*cavity)) +
                                       " m only, their least " + "radius of curvature");
    }
  }
}

void check_starts(const World& world) {
  constexpr double kRounding = 1e-9;  // of the lengths that the gap is made of, and far above what they round to
  for (const World::Body& body : world.bodies) {
    if (!is_round(body.solid)) continue;
    const Eigen::VectorXd& start = world.groups[static_cast<std::size_t>(body.group)].start;
    const Vector3 position = body.slice().position(start);
    const double radius = bounding_radius(body.solid);
    const double open = kRounding * (position.norm() + radius);
    for (const World::Obstacle& obstacle : world.obstacles)
      if (obstacle.on_hit != OnHit::pass && gap(obstacle.shape, position) - radius < -open)
        throw InputError(body.where, "body '" + body.name + "' starts inside obstacle '" + obstacle.name + "'");
  }
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
