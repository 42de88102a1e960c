#include "contact_report.hpp"
#include "plane_height.hpp"
#include "step_end_search.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/geom/distance.hpp"

namespace trajet {

ContactResult first_contact_with(const Plane& plane, const MovingBall& ball, const ContactMemory& memory) {
  const LinearFunction height = detail::plane_height(ball.path, plane.normal, plane.point, ball.radius);
  const auto [begin, end] = detail::tau_interval(ball);
  const PolynomialFunction gap = height.between(begin, end, detail::handled_tolerance(memory, ball));
  constexpr bool kIsSolid = true;
  const auto contact =
      detail::search_gap(gap, ball, kIsSolid, memory, detail::is_handled(memory, ball), [](double) { return true; });
  return detail::report(gap, contact, ball, kIsSolid, [&](const Vector3& position) {
    return detail::SurfacePoint{closest_point(plane, position), plane.normal};
  });
}

}  // namespace trajet
