#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "contact_search.hpp"
#include "thin_pass.hpp"
#include "trajet/collide/detect/contact.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/shapes.hpp"
#include "trajet/math/polynomial.hpp"

namespace trajet::detail {

/// The part of the path's own time in which a ball is searched.
struct TauInterval {
  double begin;
  double end;
};

inline TauInterval tau_interval(const MovingBall& ball) {
  return {ball.from - ball.path.t0(), ball.to - ball.path.t0()};
}

/// Whether a search begins at the contact that was reported last.
inline bool is_handled(const ContactMemory& memory, const MovingBall& ball) { return memory.contact_time == ball.from; }

/// The gap below which a search that begins in a handled contact still is in it.
inline double handled_tolerance(const ContactMemory& memory, const MovingBall& ball) {
  return is_handled(memory, ball) ? memory.tolerance : 0.0;
}

/// Whether the ball stays clear of the box around `bounds` grown by its radius: cheap, decides most pairs.
inline bool stays_clear(const BoundingBall& bounds, const MovingBall& ball) {
  const auto [begin, end] = tau_interval(ball);
  // Far above the rounding of the sums below.
  constexpr double kMargin = 1e-12;
  for (int i = 0; i < 3; ++i) {
    const Range range = ball.path.range(i, begin, end);
    const double reach =
        (bounds.radius + ball.radius + std::abs(bounds.center[i])) * kMargin + bounds.radius + ball.radius;
    if (range.lower > bounds.center[i] + reach || range.upper < bounds.center[i] - reach) return true;
  }
  return false;
}

/// The result for a pair that is known to stay apart, the ball on `side` of the obstacle.
inline ContactResult stays_separated(int side) {
  ContactResult result;
  result.memory.side = side;
  return result;
}

/// The depth of what always has an inside to tell.
struct Deep {
  double operator()() const { return std::numeric_limits<double>::infinity(); }
};

/// The result for what the search of `gap` found. `place(position)` gives the SurfacePoint for the ball's centre there;
/// `depth()`: that of the deepest place of a solid that has grown by the ball's radius, m.
template <class F, class Place, class Depth = Deep>
ContactResult report(const F& gap, const GapContact& found, const MovingBall& ball, bool is_solid, Place&& place,
                     Depth&& depth = {}) {
  const PointPath& path = ball.path;
  GapContact contact = found;
  std::optional<ThinEntry> thin;
  if (is_solid && contact.status == ContactStatus::graze && contact.side_before > 0)
    thin = thin_entry(gap, contact, path, depth(), place);
  if (thin) {
    contact.status = ContactStatus::hit;
    contact.tau = thin->tau;
    contact.side_after = -1;
  }
  ContactResult result;
  result.status = contact.status;
  result.memory.side = contact.side_after;
  if (contact.status == ContactStatus::separated) {
    if (contact.stays_at_zero || contact.stays_in_contact) {
      result.memory.contact_time = ball.to;
      result.memory.tolerance = gap.at(gap.end()).tolerance;
    }
    return result;
  }
  // The ends exactly, so that a search that goes on from there knows the contact.
  const double time = path.t0() + contact.tau;
  result.time = contact.tau == gap.begin() ? ball.from
                : contact.tau == gap.end()
                    ? ball.to
                    : std::clamp(time, std::min(ball.from, ball.to), std::max(ball.from, ball.to));
  result.position = path.value(contact.tau);
  std::optional<SurfacePoint> seen;
  if (thin) {
    seen = thin->surface;
  } else if (is_solid && contact.status == ContactStatus::hit && contact.side_before > 0) {
    seen = surface_before(gap, contact, path, depth(), place);
  }
  const SurfacePoint surface = seen ? *seen : place(result.position);
  result.point = surface.point;
  result.normal = contact.side_before < 0 ? Vector3(-surface.normal) : surface.normal;
  result.side_before = contact.side_before;
  result.direction = !is_solid                 ? ContactDirection::through
                     : contact.side_before > 0 ? ContactDirection::entering
                                               : ContactDirection::leaving;

  FunctionSample sample = gap.at(contact.tau);
  if (thin) sample.jet.rate = thin->rate;
  result.gap_rate = sample.jet.rate;
  result.gap_curvature = sample.jet.curvature;
  const double time_rounding = 2.0 * kUnitRoundoff * (std::abs(path.t0()) + std::abs(result.time));
  result.time_resolution = contact.root_error + time_rounding;
  result.time_error_bound = result.time_resolution + result.time_error(ball.start_error + path.error_bound().norm());

  result.memory.contact_time = result.time;
  result.memory.tolerance = std::max(sample.tolerance, 2.0 * time_rounding * std::abs(sample.jet.rate));
  return result;
}

}  // namespace trajet::detail
