#include <algorithm>

#include "revolution_gap.hpp"
#include "tightened_gap.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/revolution_distance.hpp"

namespace trajet {

namespace {

/// The depth of the deepest place, m, or a little more: half of the core's lesser extent, and what it has grown.
double depth(const SolidOfRevolution& solid) {
  double radius = 0.0;
  for (const Eigen::Vector2d& corner : solid.profile) radius = std::max(radius, corner.x());
  return std::min(radius, 0.5 * (solid.profile.back().y() - solid.profile.front().y())) + solid.growth;
}

}  // namespace

ContactResult first_contact_with(const SolidOfRevolution& solid, const MovingBall& ball, const ContactMemory& memory) {
  if (detail::stays_clear(bounding_ball(solid), ball)) return detail::stays_separated(1);
  const detail::RevolutionGap gap(solid, ball);
  const auto surface_at = [&](const Vector3& position) {
    const auto place = detail::nearest_on_surface(solid, position);
    return detail::SurfacePoint{place.point, place.normal.normalized()};
  };
  return detail::contact_with_surface(gap, ball, memory, surface_at, [&] { return depth(solid) + ball.radius; });
}

}  // namespace trajet
