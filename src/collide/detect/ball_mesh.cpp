#include <algorithm>
#include <cmath>
#include <vector>

#include "contact_report.hpp"
#include "hull_contact.hpp"
#include "point_surface.hpp"
#include "step_end_search.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/geom/triangle_surface.hpp"
#include "trajet/portable.hpp"
#include "triangle_distance.hpp"

namespace trajet {

namespace {

/// So many triangles at least are looked at one by one; a longer piece of a path is cut instead.
constexpr std::size_t kFew = 8;

/// How far a ball is from a surface: min_i distance(triangle i, x) - r, and not more than `cap` above zero. One
/// function for all triangles, so that what two of them share is one contact. Only the triangles near a piece of the
/// path are asked.
class MeshGap {
 public:
  using Piece = IntervalJet;

  MeshGap(const SurfaceTriangles& surface, const MovingBall& ball, double touch_tolerance)
      : surface_(surface),
        path_(ball.path),
        radius_(ball.radius),
        cap_(0.5 * std::min(ball.radius, surface.spacing)),
        begin_(detail::tau_interval(ball).begin),
        end_(detail::tau_interval(ball).end),
        touch_tolerance_(touch_tolerance) {}

  double begin() const { return begin_; }
  double end() const { return end_; }

  IntervalJet piece(double from, double to) const {
    Aabb box;
    for (int i = 0; i < 3; ++i) {
      const Range range = path_.range(i, from, to);
      box.lower[i] = range.lower;
      box.upper[i] = range.upper;
    }
    const bool is_short = (box.upper - box.lower).maxCoeff() <= surface_.spacing;
    std::vector<int> near;
    const bool are_all = surface_.tree.visit_overlapping(grown(box, reach()), [&near, is_short](int triangle) {
      near.push_back(triangle);
      return is_short || near.size() <= kFew;
    });
    if (!are_all) return undecided();
    IntervalJet least(Interval{cap_});
    std::vector<IntervalJet> all{least};
    for (const int triangle : near)
      all.push_back(gap(triangle, [=](const detail::Coordinate& x) { return x.between(from, to); }));
    return hull_of_least(all);
  }
  Range value_range(const IntervalJet& piece) const { return {piece[0].lower(), piece[0].upper()}; }
  Range rate_range(const IntervalJet& piece) const { return {piece[1].lower(), piece[1].upper()}; }
  Range curvature_range(const IntervalJet& piece) const { return {piece[2].lower(), piece[2].upper()}; }

  FunctionSample at(double tau) const {
    const Vector3 position = path_.value(tau);
    std::vector<int> near;
    surface_.tree.visit_overlapping(grown({position, position}, reach()), [&near](int triangle) {
      near.push_back(triangle);
      return true;
    });
    ranges::sort(near);
    const double rounding = 3.0 * kUnitRoundoff * (position.lpNorm<1>() + radius_);
    FunctionSample least{{cap_, 0.0, 0.0}, rounding, std::max(3.0 * rounding, touch_tolerance_)};
    for (const int triangle : near) {
      const IntervalJet f = gap(triangle, [=](const detail::Coordinate& x) { return x.at(tau); });
      if (!(median(f[0]) < least.jet.value)) continue;
      const double error = 0.5 * width(f[0]);
      least = {{median(f[0]), median(f[1]), 2.0 * median(f[2])}, error, std::max(3.0 * error, touch_tolerance_)};
    }
    return least;
  }

 private:
  double reach() const { return radius_ + 2.0 * cap_; }

  template <class Enclose>
  IntervalJet gap(int index, const Enclose& enclose) const {
    IntervalJet f = detail::TriangleDistance(path_, surface_.triangle(index)).distance(enclose, radius_ + cap_);
    f[0] -= radius_;
    return f;
  }

  IntervalJet undecided() const {
    IntervalJet f(Interval(-radius_, cap_));
    f[1] = f[2] = Interval::whole();
    return f;
  }

  /// Of several functions, the least: its rate is that of one of those which may be the least, and where these are
  /// several it may have corners.
  static IntervalJet hull_of_least(const std::vector<IntervalJet>& all) {
    double lower = all[0][0].lower(), upper = all[0][0].upper();
    for (const IntervalJet& f : all) {
      lower = std::min(lower, f[0].lower());
      upper = std::min(upper, f[0].upper());
    }
    IntervalJet least(Interval(lower, upper));
    bool is_first = true;
    for (const IntervalJet& f : all) {
      if (f[0].lower() > upper) continue;
      least[1] = is_first ? f[1] : hull(least[1], f[1]);
      least[2] = is_first ? f[2] : Interval::whole();
      is_first = false;
    }
    return least;
  }

  const SurfaceTriangles& surface_;
  const PointPath& path_;
  double radius_;
  double cap_;
  double begin_;
  double end_;
  double touch_tolerance_;
};

}  // namespace

ContactResult first_contact_with(const MeshSurface& surface, const MovingBall& ball, const ContactMemory& memory) {
  const SurfaceTriangles& triangles = *surface.triangles;
  if (triangles.convex) return detail::hull_contact(surface, ball, memory);
  if (ball.radius == 0.0) return detail::point_surface_contact(triangles, ball, memory);
  const MeshGap gap(triangles, ball, detail::handled_tolerance(memory, ball));
  constexpr bool kIsSolid = true;
  const auto contact =
      detail::search_gap(gap, ball, kIsSolid, memory, detail::is_handled(memory, ball), [](double) { return true; });
  const auto place = [&](const Vector3& position) {
    const Vector3 point = closest_point(surface, position);
    return detail::SurfacePoint{point, (position - point).stableNormalized()};
  };
  return detail::report(gap, contact, ball, kIsSolid, place, [&] { return ball.radius; });
}

}  // namespace trajet
