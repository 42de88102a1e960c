#pragma once

#include "contact_report.hpp"
#include "cuboid_distance.hpp"
#include "grown_gap.hpp"
#include "step_end_search.hpp"
#include "trajet/event/composed_function.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/geom/distance.hpp"
#include "triangle_distance.hpp"

namespace trajet::detail {

/// The first contact by a gap that is a function of the position: `gap(x)`, generic in its number type, positive
/// outside; `depth` as of `report`.
template <class G, class Place, class Depth = Deep>
ContactResult solid_contact(const G& gap_at, const MovingBall& ball, const ContactMemory& memory, Place&& place,
                            Depth&& depth = {}) {
  const auto [begin, end] = tau_interval(ball);
  const auto at_time = [&gap_at](const IntervalJet&, const Vector3T<IntervalJet>& x) { return gap_at(x); };
  const ComposedFunction gap(ball.path, at_time, begin, end, handled_tolerance(memory, ball));
  constexpr bool kIsSolid = true;
  const auto contact = search_gap(gap, ball, kIsSolid, memory, is_handled(memory, ball), [](double) { return true; });
  return report(gap, contact, ball, kIsSolid, place, depth);
}

/// The first contact of a ball of positive radius with a shape whose nearest point `closest_point` finds, and whose own
/// deepest place has that `depth`, m.
template <class F, class ConvexShape>
ContactResult contact_of_gap(const F& gap, const ConvexShape& shape, const MovingBall& ball,
                             const ContactMemory& memory, double depth = 0.0) {
  constexpr bool kIsSolid = true;
  const auto contact = search_gap(gap, ball, kIsSolid, memory, is_handled(memory, ball), [](double) { return true; });
  const auto place = [&](const Vector3& position) {
    const Vector3 point = closest_point(shape, position);
    return SurfacePoint{point, (position - point).stableNormalized()};
  };
  return report(gap, contact, ball, kIsSolid, place, [&] { return depth + ball.radius; });
}

/// The first contact of a ball of positive radius with a convex shape: gap = distance(shape, x) - r.
inline ContactResult grown_contact(const Disk& disk, const MovingBall& ball, const ContactMemory& memory) {
  const auto [begin, end] = tau_interval(ball);
  const auto distance_to_disk = [&disk, radius = ball.radius](const IntervalJet&, const Vector3T<IntervalJet>& x) {
    return IntervalJet(distance(disk, x) - IntervalJet(radius));
  };
  const ComposedFunction gap(ball.path, distance_to_disk, begin, end, handled_tolerance(memory, ball));
  return contact_of_gap(gap, disk, ball, memory);
}
inline ContactResult grown_contact(const Rectangle& rectangle, const MovingBall& ball, const ContactMemory& memory) {
  const CuboidDistance distance(ball.path, rectangle);
  return contact_of_gap(GrownGap(distance, ball, handled_tolerance(memory, ball)), rectangle, ball, memory);
}
inline ContactResult grown_contact(const Box& box, const MovingBall& ball, const ContactMemory& memory) {
  const CuboidDistance distance(ball.path, box);
  return contact_of_gap(GrownGap(distance, ball, handled_tolerance(memory, ball)), box, ball, memory,
                        box.half_size.minCoeff());
}
inline ContactResult grown_contact(const Triangle& triangle, const MovingBall& ball, const ContactMemory& memory) {
  const TriangleDistance distance(ball.path, triangle);
  return contact_of_gap(GrownGap(distance, ball, handled_tolerance(memory, ball)), triangle, ball, memory);
}

}  // namespace trajet::detail
