#include <algorithm>

#include "grown_shape.hpp"
#include "plane_height.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/geom/distance.hpp"

namespace trajet {

namespace {

const Vector3& point_in_plane(const Disk& disk) { return disk.center; }
const Vector3& point_in_plane(const Rectangle& rectangle) { return rectangle.center; }
const Vector3& point_in_plane(const Triangle& triangle) { return triangle.corners[0]; }

/// The outward normal, in the shape's plane, of the edge that is nearest to a point of the plane.
Vector3 edge_normal(const Disk& disk, const Vector3& position) { return (position - disk.center).stableNormalized(); }
Vector3 edge_normal(const Rectangle& rectangle, const Vector3& position) {
  const Vector3 q = position - rectangle.center;
  const double beyond_side = std::abs(q.dot(across(rectangle))) - 0.5 * rectangle.width;
  const double beyond_end = std::abs(q.dot(rectangle.up)) - 0.5 * rectangle.height;
  const Vector3 axis = beyond_side > beyond_end ? across(rectangle) : rectangle.up;
  return q.dot(axis) < 0.0 ? Vector3(-axis) : axis;
}
Vector3 edge_normal(const Triangle& triangle, const Vector3& position) {
  const auto beyond = [&](int i) { return edge_outward(triangle, i).dot(position - triangle.corners[i]); };
  int nearest = 0;
  for (int i = 1; i < 3; ++i) {
    if (beyond(i) > beyond(nearest)) nearest = i;
  }
  return edge_outward(triangle, nearest);
}

/// Rounding of a position on the path at tau, and of its distances to a shape of that size.
double position_rounding(const PointPath& path, const BoundingBall& bounds, double tau) {
  double magnitude = bounds.center.lpNorm<1>() + bounds.radius;
  double speed = 0.0;
  for (int i = 0; i < 3; ++i) {
    const MeasuredJet component = evaluate_polynomial(path.coefficients(i), tau);
    magnitude += component.magnitude;
    speed += std::abs(component.jet.rate);
  }
  return BernsteinForm::roundings(path.degree()) * kUnitRoundoff * magnitude +
         2.0 * kUnitRoundoff * std::abs(tau) * speed;
}

/// A point that moves in the plane of a thin shape meets the edge, where it comes from outside. On the shape it rests.
template <class ThinShape>
ContactResult contact_in_plane(const ThinShape& shape, const MovingBall& ball, const ContactMemory& memory) {
  ContactMemory edge_memory = memory;
  if (!memory.is_in_plane || !detail::is_handled(memory, ball)) {
    const double begin = detail::tau_interval(ball).begin;
    const double rounding = position_rounding(ball.path, bounding_ball(shape), begin);
    if (in_plane_gap(shape, ball.path.value(begin)) < -rounding) {
      ContactResult rests;
      rests.memory = memory;
      if (detail::is_handled(memory, ball)) rests.memory.contact_time = ball.to;
      return rests;
    }
    edge_memory = {};
  }
  const auto beyond_edge = [&shape](const auto& x) { return in_plane_gap(shape, x); };
  ContactResult result = detail::solid_contact(beyond_edge, ball, edge_memory, [&](const Vector3& position) {
    return detail::SurfacePoint{closest_point(shape, position), edge_normal(shape, position)};
  });
  result.memory.is_in_plane = true;
  return result;
}

/// A point against a thin shape: it crosses or touches the plane where its foot is within the closed shape.
template <class ThinShape>
ContactResult point_contact(const ThinShape& shape, const MovingBall& ball, const ContactMemory& memory) {
  const BoundingBall bounds = bounding_ball(shape);
  const LinearFunction height = detail::plane_height(ball.path, shape.normal, point_in_plane(shape));
  const auto [begin, end] = detail::tau_interval(ball);
  const PolynomialFunction gap = height.between(begin, end, detail::handled_tolerance(memory, ball));
  constexpr bool kIsSolid = false;
  const auto is_within = [&](double tau) {
    const Vector3 position = ball.path.value(tau);
    return in_plane_gap(shape, position) <= position_rounding(ball.path, bounds, tau);
  };
  ContactMemory plane_memory = memory;
  if (memory.is_in_plane) plane_memory.side = 0;
  const auto contact =
      detail::search_gap(gap, ball, kIsSolid, plane_memory, detail::is_handled(memory, ball), is_within);
  if (contact.stays_at_zero) return contact_in_plane(shape, ball, memory);
  return detail::report(gap, contact, ball, kIsSolid, [&](const Vector3& position) {
    return detail::SurfacePoint{closest_point(shape, position), shape.normal};
  });
}

template <class ThinShape>
ContactResult thin_contact(const ThinShape& shape, const MovingBall& ball, const ContactMemory& memory) {
  // Whether the ball is before or behind the plane is not kept from afar.
  if (detail::stays_clear(bounding_ball(shape), ball)) return detail::stays_separated(ball.radius > 0.0 ? 1 : 0);
  return ball.radius > 0.0 ? detail::grown_contact(shape, ball, memory) : point_contact(shape, ball, memory);
}

}  // namespace

ContactResult first_contact_with(const Disk& disk, const MovingBall& ball, const ContactMemory& memory) {
  return thin_contact(disk, ball, memory);
}

ContactResult first_contact_with(const Rectangle& rectangle, const MovingBall& ball, const ContactMemory& memory) {
  return thin_contact(rectangle, ball, memory);
}

ContactResult first_contact_with(const Triangle& triangle, const MovingBall& ball, const ContactMemory& memory) {
  return thin_contact(triangle, ball, memory);
}

}  // namespace trajet
