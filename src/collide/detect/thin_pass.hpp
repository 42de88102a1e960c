#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact_search.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/math/root_search.hpp"

namespace trajet::detail {

/// A point on an obstacle.
struct SurfacePoint {
  Vector3 point;
  Vector3 normal;  ///< unit, to the positive side
};

/// Where a path enters a solid that is too thin for its gap to be told from zero within.
struct ThinEntry {
  double tau = 0.0;
  SurfacePoint surface{};
  double rate = 0.0;  ///< m/s, of the gap before the surface
};

/// The nearest time before or behind `tau`, in the sense of `step`, at which the gap surely is not zero.
template <EnclosedFunction F>
std::optional<double> clear_time(const F& gap, double tau, double step) {
  constexpr int kMostDoublings = 80;
  for (int i = 0; i < kMostDoublings; ++i, step *= 2.0) {
    const FunctionSample sample = gap.at(tau + step);
    if (!std::isfinite(sample.jet.value)) return std::nullopt;
    if (std::abs(sample.jet.value) > 2.0 * sample.tolerance) return tau + step;
  }
  return std::nullopt;
}

/// Of a touch of a solid: where the path enters it, if it passes through.
///
/// What is thinner than the gap's rounding has no inside that a sign could tell: a path through a plate and one that
/// grazes it both come to zero and go away again. They differ in the surface that they see before and behind. Of what
/// passes through, the one looks back along the path and the other ahead, n_before . n_behind near -1; what grazes a
/// face, or rounds a corner of a solid thick enough to have one, sees normals that are less than 120 degrees apart.
///
/// `depth`: of the solid's deepest place, m; `place(position)` gives the SurfacePoint for the ball's centre there.
template <EnclosedFunction F, class Place>
std::optional<ThinEntry> thin_entry(const F& gap, const GapContact& touch, const PointPath& path, double depth,
                                    Place&& place) {
  const FunctionSample sample = gap.at(touch.tau);
  // An inside that is deeper is told by its sign somewhere: a touch then is at an edge.
  constexpr double kThin = 4.0;
  if (!(depth <= kThin * sample.tolerance)) return std::nullopt;
  const double forward = gap.end() < gap.begin() ? -1.0 : 1.0;
  const double step = forward * std::max(touch.root_error, 4.0 * kUnitRoundoff * std::abs(path.t0() + touch.tau));
  const std::optional<double> before = clear_time(gap, touch.tau, -step), behind = clear_time(gap, touch.tau, step);
  if (!before || !behind) return std::nullopt;
  const SurfacePoint entry = place(path.value(*before));
  constexpr double kOpposite = -0.5;
  if (!(entry.normal.dot(place(path.value(*behind)).normal) < kOpposite)) return std::nullopt;
  const double rate = gap.at(*before).jet.rate;
  // Along a plate the path is in it for longer than it takes to come to it: what counts is the beginning.
  double outside = *before, at_surface = touch.tau;
  const double crossing = 2.0 * (gap.at(*before).jet.value + sample.tolerance) / std::abs(rate);
  if (std::abs(at_surface - outside) > crossing + std::abs(step)) {
    constexpr int kMostHalvings = 64;
    for (int i = 0; i < kMostHalvings; ++i) {
      const double middle = 0.5 * outside + 0.5 * at_surface;
      (gap.at(middle).jet.value > 2.0 * sample.tolerance ? outside : at_surface) = middle;
    }
  }
  return ThinEntry{at_surface, entry, rate};
}

/// Of a hit of a solid so thin that the place of the hit, by its rounding, may be nearer to its other side: where the
/// path comes to it.
template <EnclosedFunction F, class Place>
std::optional<SurfacePoint> surface_before(const F& gap, const GapContact& hit, const PointPath& path, double depth,
                                           Place&& place) {
  constexpr double kThin = 64.0;
  if (!(depth <= kThin * gap.at(hit.tau).tolerance)) return std::nullopt;
  const double forward = gap.end() < gap.begin() ? -1.0 : 1.0;
  const double step = forward * std::max(hit.root_error, 4.0 * kUnitRoundoff * std::abs(path.t0() + hit.tau));
  const std::optional<double> before = clear_time(gap, hit.tau, -step);
  if (!before || !(gap.at(*before).jet.value > 0.0)) return std::nullopt;
  return place(path.value(*before));
}

}  // namespace trajet::detail
