#include "grown_shape.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/geom/distance.hpp"

namespace trajet {

ContactResult first_contact_with(const Sphere& sphere, const MovingBall& ball, const ContactMemory& memory) {
  if (detail::stays_clear(bounding_ball(sphere), ball)) return detail::stays_separated(1);
  const Sphere grown{sphere.center, sphere.radius + ball.radius};
  const auto gap = [&grown](const auto& x) { return signed_distance(grown, x); };
  const auto place = [&](const Vector3& position) {
    return detail::SurfacePoint{closest_point(sphere, position), (position - sphere.center).stableNormalized()};
  };
  return detail::solid_contact(gap, ball, memory, place, [&] { return grown.radius; });
}

}  // namespace trajet
