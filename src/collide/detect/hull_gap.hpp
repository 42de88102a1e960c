#pragma once

#include <array>
#include <vector>

#include "coordinate.hpp"
#include "grown_gap.hpp"
#include "jet_hull.hpp"
#include "trajet/geom/convex_faces.hpp"

namespace trajet::detail {

/// The gap of a ball and a convex polytope, feature by feature: over a face the height above it, past an edge the
/// distance to its line, beyond a corner that to the corner; inside, the greatest of the heights. Where a piece of a
/// path may be near several features, the hull of what each says.
///
/// A point meets the sharp polytope where all heights have come to zero, as it does a solid of revolution.
class HullGap {
 public:
  HullGap(const ConvexFaces& faces, const PointPath& path, double radius) : faces_(faces), radius_(radius) {
    for (const ConvexFaces::Side& side : faces.sides) above_.emplace_back(path, side.normal, side.point);
    if (radius == 0.0) return;
    for (const ConvexFaces::Edge& edge : faces.edges) {
      const Vector3& from = faces.corners[static_cast<std::size_t>(edge.from)];
      edges_.push_back({{path, edge.along, from}, {path, edge.past[0], from}, {path, edge.past[1], from}});
    }
    for (int i = 0; i < 3; ++i)
      place_[static_cast<std::size_t>(i)] = Coordinate(path, Vector3::Unit(i), faces.corners[0]);
  }

  template <class Enclose>
  IntervalJet gap(const Enclose& enclose) const {
    std::vector<IntervalJet> heights;
    bool is_inside = true, may_be_inside = true;
    for (const Coordinate& above : above_) {
      heights.push_back(enclose(above));
      is_inside = is_inside && heights.back()[0].upper() < 0.0;
      may_be_inside = may_be_inside && heights.back()[0].lower() <= 0.0;
    }
    IntervalJet result;
    if (radius_ == 0.0 || is_inside) {
      result = greatest(heights);
    } else {
      JetHull hull;
      if (may_be_inside) hull.add(greatest(heights));
      add_features(heights, enclose, hull);
      if (hull.is_empty()) hull.add(greatest(heights));  // between two features, by rounding
      result = hull.hull();
    }
    result[0] -= radius_;
    return result;
  }

 private:
  struct EdgeCoordinates {
    Coordinate along;
    Coordinate past0, past1;  ///< in the plane of either side
  };
  struct EdgePlace {
    IntervalJet along, past[2];
  };

  template <class Enclose>
  void add_features(const std::vector<IntervalJet>& heights, const Enclose& enclose, JetHull& hull) const {
    std::vector<EdgePlace> places;
    for (const EdgeCoordinates& edge : edges_)
      places.push_back({enclose(edge.along), {enclose(edge.past0), enclose(edge.past1)}});
    const auto at = [&](int edge) -> const EdgePlace& { return places[static_cast<std::size_t>(edge)]; };

    for (std::size_t s = 0; s < heights.size(); ++s) {
      bool may_be_over = heights[s][0].upper() >= 0.0;
      for (const int e : faces_.sides[s].edges) {
        const bool is_first = faces_.edges[static_cast<std::size_t>(e)].sides[0] == static_cast<int>(s);
        may_be_over = may_be_over && at(e).past[is_first ? 0 : 1][0].lower() <= 0.0;
      }
      if (may_be_over) hull.add(clipped(heights[s]));
    }
    for (std::size_t e = 0; e < places.size(); ++e) {
      const EdgePlace& place = places[e];
      const bool may_be_past = place.past[0][0].upper() >= 0.0 && place.past[1][0].upper() >= 0.0;
      const bool may_be_between = place.along[0].upper() >= 0.0 && place.along[0].lower() <= faces_.edges[e].length;
      if (may_be_past && may_be_between)
        hull.add(distance_of(
            std::array{heights[static_cast<std::size_t>(faces_.edges[e].sides[0])], clipped(place.past[0])}));
    }
    std::array<IntervalJet, 3> from_first;
    for (std::size_t i = 0; i < 3; ++i) from_first[i] = enclose(place_[i]);
    for (std::size_t c = 0; c < faces_.corners.size(); ++c) {
      bool may_be_beyond = !faces_.edges_at[c].empty();
      for (const int e : faces_.edges_at[c]) {
        const ConvexFaces::Edge& edge = faces_.edges[static_cast<std::size_t>(e)];
        const Interval& along = at(e).along[0];
        const bool is_behind = edge.from == static_cast<int>(c) ? along.lower() <= 0.0 : along.upper() >= edge.length;
        may_be_beyond = may_be_beyond && is_behind;
      }
      if (!may_be_beyond) continue;
      const Vector3 from = faces_.corners[c] - faces_.corners[0];
      hull.add(distance_of(std::array{from_first[0] - IntervalJet(from.x()), from_first[1] - IntervalJet(from.y()),
                                      from_first[2] - IntervalJet(from.z())}));
    }
  }

  /// Past an edge or above a face, values below 0 are none.
  static IntervalJet clipped(IntervalJet x) {
    x[0] = Interval(std::max(0.0, x[0].lower()), std::max(0.0, x[0].upper()));
    return x;
  }

  const ConvexFaces& faces_;
  double radius_;
  std::vector<Coordinate> above_;
  std::vector<EdgeCoordinates> edges_;
  std::array<Coordinate, 3> place_;
};

}  // namespace trajet::detail
