#include "grown_shape.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/geom/distance.hpp"

namespace trajet {

ContactResult first_contact_with(const Sphere& sphere, const MovingBall& ball, const ContactMemory& memory) {
  if (detail::stays_clear(bounding_ball(sphere), ball)) return detail::stays_separated(1);
  const Sphere grown{sphere.center, sphere.radius + ball.radius};
  const auto gap = [&grown](const auto& x) { return signed_distance(grown, x); };
  return detail::solid_contact(gap, ball, memory, [&](const Vector3& position) {
    const Vector3 point = closest_point(sphere, position);
    return detail::SurfacePoint{point, (point - sphere.center) / sphere.radius};
  });
}

}  // namespace trajet
