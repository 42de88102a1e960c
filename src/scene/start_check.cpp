#include "start_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "trajet/geom/distance.hpp"
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
