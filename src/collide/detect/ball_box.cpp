#include "grown_shape.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/geom/distance.hpp"

namespace trajet {

namespace {

/// The outward normal of the face that a point at `position` touches; at an edge or corner, of the nearest of its
/// faces.
Vector3 face_normal(const Box& box, const Vector3& position) {
  Eigen::Index axis;
  detail::face_gaps(box, position).maxCoeff(&axis);
  const Vector3 normal = box.R_WB.col(axis);
  return normal.dot(position - box.center) < 0.0 ? Vector3(-normal) : normal;
}

}  // namespace

ContactResult first_contact_with(const Box& box, const MovingBall& ball, const ContactMemory& memory) {
  if (detail::stays_clear(bounding_ball(box), ball)) return detail::stays_separated(1);
  if (ball.radius > 0.0) return detail::grown_contact(box, ball, memory);
  const auto gap = [&box](const auto& x) { return face_gap(box, x); };
  const auto place = [&](const Vector3& position) {
    return detail::SurfacePoint{closest_point(box, position), face_normal(box, position)};
  };
  return detail::solid_contact(gap, ball, memory, place, [&] { return box.half_size.minCoeff(); });
}

}  // namespace trajet
