#include "revolution_gap.hpp"
#include "tightened_gap.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/revolution_distance.hpp"

namespace trajet {

ContactResult first_contact_with(const SolidOfRevolution& solid, const MovingBall& ball, const ContactMemory& memory) {
  if (detail::stays_clear(bounding_ball(solid), ball)) return detail::stays_separated(1);
  const detail::RevolutionGap gap(solid, ball);
  return detail::contact_with_surface(gap, ball, memory, [&](const Vector3& position) {
    const auto place = detail::nearest_on_surface(solid, position);
    return detail::SurfacePoint{place.point, place.normal.normalized()};
  });
}

}  // namespace trajet
