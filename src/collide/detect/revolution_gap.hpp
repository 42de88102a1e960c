#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <vector>

#include "coordinate.hpp"
#include "grown_gap.hpp"
#include "jet_hull.hpp"
#include "trajet/geom/revolution_distance.hpp"

namespace trajet::detail {

/// The distance of a point on a path from an axis, sqrt(x^2 + y^2), with its derivatives by time. Its rate is never
/// more than the speed across the axis, at the axis either.
inline IntervalJet distance_from_axis(const IntervalJet& x, const IntervalJet& y) {
  IntervalJet rho = distance_of(std::array{x, y});
  const double speed = sqrt(square(x[1]) + square(y[1])).upper();
  const Interval bound(-speed, speed);
  rho[1] = rho[0].lower() > 0.0 ? intersect(rho[1], bound) : bound;
  return rho;
}

/// The gap of a ball and a solid of revolution, feature by feature of its profile: over a face the height above it, at
/// a rim or a tip the distance to it. Where a piece of a path may be near several features, the hull of what each says.
///
/// A solid with sharp edges meets a point where all of its faces have come to it: its gap is the greatest of the
/// heights, for edges are no place to which a distance has a gradient.
class RevolutionGap {
 public:
  RevolutionGap(const SolidOfRevolution& solid, const MovingBall& ball)
      : x_(ball.path, solid.R_WB.col(0), solid.center),
        y_(ball.path, solid.R_WB.col(1), solid.center),
        z_(ball.path, solid.R_WB.col(2), solid.center),
        radius_(ball.radius + solid.growth) {
    for (std::size_t i = 0; i + 1 < solid.profile.size(); ++i) edges_.push_back(edge(solid, i));
    assert(edges_.size() <= kMostEdges);
  }

  template <class Enclose>
  IntervalJet gap(const Enclose& enclose) const {
    const Place p{enclose(x_), enclose(y_), enclose(z_)};
    const IntervalJet rho = distance_from_axis(p.x, p.y);
    std::array<IntervalJet, kMostEdges> heights;
    const std::span<const IntervalJet> above(heights.data(), edges_.size());
    bool is_inside = true, may_be_inside = true;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      heights[i] = height(edges_[i], rho, p.z);
      is_inside = is_inside && heights[i][0].upper() < 0.0;
      may_be_inside = may_be_inside && heights[i][0].lower() <= 0.0;
    }
    IntervalJet result;
    if (radius_ == 0.0 || is_inside) {
      result = greatest(above);
    } else {
      JetHull hull;
      if (may_be_inside) hull.add(greatest(above));
      for (std::size_t i = 0; i < edges_.size(); ++i) add_features(i, above[i], rho, p, hull);
      if (hull.is_empty()) hull.add(greatest(above));  // between two features, by rounding
      result = hull.hull();
    }
    result[0] -= radius_;
    return result;
  }

 private:
  static constexpr std::size_t kMostEdges = 4;

  struct Place {
    IntervalJet x, y, z;
  };

  static IntervalJet height(const ProfileEdge& edge, const IntervalJet& rho, const IntervalJet& z) {
    const IntervalJet from_end = edge.normal.y() * (z - IntervalJet(edge.from.y()));
    if (edge.is_level()) return from_end;
    return edge.normal.x() * (rho - IntervalJet(edge.from.x())) + from_end;
  }

  /// The face of an edge and the corner at its end, and of the first edge that at its beginning.
  void add_features(std::size_t i, const IntervalJet& above, const IntervalJet& rho, const Place& p,
                    JetHull& hull) const {
    const ProfileEdge& each = edges_[i];
    const Interval along = each.along.x() * (rho[0] - each.from.x()) + each.along.y() * (p.z[0] - each.from.y());
    const bool is_last = i + 1 == edges_.size();
    // a level edge goes on beyond the axis, where no corner ends it
    const bool may_be_behind_begin = !(i == 0 && each.is_level()) && along.lower() <= 0.0;
    const bool may_be_behind_end = !(is_last && each.is_level()) && along.upper() >= each.length;
    if (above[0].upper() >= 0.0 && along.upper() >= 0.0 && along.lower() <= each.length) {
      IntervalJet face = above;
      face[0] = Interval(std::max(0.0, face[0].lower()), std::max(0.0, face[0].upper()));
      hull.add(face);
    }
    if (i == 0 && may_be_behind_begin) hull.add(from_corner(each.from, rho, p));
    if (!may_be_behind_end) return;
    if (!is_last) {
      // the next edge may not have begun
      const ProfileEdge& next = edges_[i + 1];
      const Interval along_next = next.along.x() * (rho[0] - next.from.x()) + next.along.y() * (p.z[0] - next.from.y());
      if (along_next.lower() > 0.0) return;
    }
    hull.add(from_corner(each.to, rho, p));
  }

  static IntervalJet from_corner(const Eigen::Vector2d& corner, const IntervalJet& rho, const Place& p) {
    const IntervalJet above = p.z - IntervalJet(corner.y());
    if (corner.x() == 0.0) return distance_of(std::array{p.x, p.y, above});
    return distance_of(std::array{rho - IntervalJet(corner.x()), above});
  }

  Coordinate x_, y_, z_;
  std::vector<ProfileEdge> edges_;
  double radius_;
};

}  // namespace trajet::detail
