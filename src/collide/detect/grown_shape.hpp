#pragma once

#include <type_traits>

#include "contact_report.hpp"
#include "step_end_search.hpp"
#include "trajet/event/composed_function.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/geom/distance.hpp"

namespace trajet::detail {

/// The first contact by a gap that is a function of the position: `gap(x)`, generic in its number type, positive
/// outside.
template <class G, class Place>
ContactResult solid_contact(const G& gap_at, const MovingBall& ball, const ContactMemory& memory, Place&& place) {
  const auto [begin, end] = tau_interval(ball);
  const auto at_time = [&gap_at](const IntervalJet&, const Vector3T<IntervalJet>& x) { return gap_at(x); };
  const ComposedFunction gap(ball.path, at_time, begin, end, handled_tolerance(memory, ball));
  constexpr bool kIsSolid = true;
  const auto contact = search_gap(gap, ball, kIsSolid, memory, is_handled(memory, ball), [](double) { return true; });
  return report(gap, contact, ball, kIsSolid, place);
}

/// The first contact of a ball of positive radius with a convex shape: gap = distance(shape, x) - r. The distance from
/// a convex set has a continuous gradient where it is positive, so the gap is smooth enough at its roots: edges and
/// corners of the grown shape are round.
template <class ConvexShape>
ContactResult grown_contact(const ConvexShape& shape, const MovingBall& ball, const ContactMemory& memory) {
  const double radius = ball.radius;
  const auto gap = [&shape, radius](const auto& x) {
    using Number = typename std::decay_t<decltype(x)>::Scalar;
    return distance(shape, x) - Number(radius);
  };
  return solid_contact(gap, ball, memory, [&](const Vector3& position) {
    const Vector3 point = closest_point(shape, position);
    return SurfacePoint{point, (position - point).stableNormalized()};
  });
}

}  // namespace trajet::detail
