#include "point_surface.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "contact_report.hpp"
#include "plane_height.hpp"
#include "step_end_search.hpp"
#include "trajet/geom/closest_point.hpp"
#include "trajet/portable.hpp"

namespace trajet::detail {

namespace {

constexpr std::size_t kFew = 8;

/// Looks for the first contact piece by piece along the path: of each triangle near a piece, on all of the path up to
/// the first contact so far.
class PointSurfaceSearch {
 public:
  PointSurfaceSearch(const SurfaceTriangles& surface, const MovingBall& point, const ContactMemory& memory)
      : surface_(surface), point_(point), memory_(memory), start_(point.path.value(tau_interval(point).begin)) {}

  ContactResult run() {
    const auto [begin, end] = tau_interval(point_);
    search(begin, end);
    if (first_.status != ContactStatus::separated) return first_;
    ContactResult result;
    result.memory = {.side = side_at_end_};
    return result;
  }

 private:
  void search(double from, double to) {
    if (is_behind_first(from)) return;
    Aabb box;
    for (int i = 0; i < 3; ++i) {
      const Range range = point_.path.range(i, from, to);
      box.lower[i] = range.lower;
      box.upper[i] = range.upper;
    }
    box = grown(box, margin(box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs())));
    const bool is_short = (box.upper - box.lower).maxCoeff() <= surface_.spacing;
    const double middle = 0.5 * from + 0.5 * to;
    std::vector<int> near;
    const bool are_all = surface_.tree.visit_overlapping(box, [&](int triangle) {
      near.push_back(triangle);
      return is_short || near.size() <= kFew;
    });
    if (!are_all && middle != from && middle != to) {
      search(from, middle);
      search(middle, to);
      return;
    }
    ranges::sort(near);
    for (const int triangle : near)
      if (searched_.insert(triangle).second) meet(triangle);
  }

  bool is_behind_first(double tau) const {
    if (first_.status == ContactStatus::separated) return false;
    const double forward = point_.to < point_.from ? -1.0 : 1.0;
    return forward * (point_.path.t0() + tau - first_.time) > 0.0;
  }

  /// Of places and triangles of that size: far above their rounding.
  static double margin(const Vector3& size) {
    constexpr double kRoundings = 64.0;
    return kRoundings * kUnitRoundoff * size.lpNorm<1>();
  }

  void meet(int index) {
    const Triangle triangle = surface_.triangle(index);
    const auto [begin, end] = tau_interval(point_);
    const Vector3 size = triangle.corners[0].cwiseAbs().cwiseMax(start_.cwiseAbs());
    const double near = margin(size);
    const bool was_handled = is_handled(memory_, point_);
    const bool is_on_it = is_on(triangle, start_, near + handled_tolerance(memory_, point_));
    const ContactMemory own = is_on_it ? memory_ : ContactMemory{};
    const LinearFunction height = plane_height(point_.path, triangle.normal, triangle.corners[0]);
    const PolynomialFunction gap =
        height.between(begin, end, is_on_it && was_handled ? std::max(memory_.tolerance, near) : 0.0);
    const auto is_within = [&](double tau) {
      const Vector3 position = point_.path.value(tau);
      const double speed = point_.path.rate(tau).lpNorm<1>();
      return in_plane_gap(triangle, position) <=
             margin(size.cwiseMax(position.cwiseAbs())) + 4.0 * kUnitRoundoff * std::abs(tau) * speed;
    };
    constexpr bool kIsSolid = false;
    const GapContact contact = search_gap(gap, point_, kIsSolid, own, is_on_it && was_handled, is_within);
    if (contact.status == ContactStatus::separated) {
      if (is_on(triangle, point_.path.value(end), near) && side_at_end_ == 0) side_at_end_ = contact.side_after;
      return;
    }
    ContactResult met = report(gap, contact, point_, kIsSolid, [&](const Vector3& position) {
      return SurfacePoint{closest_point(triangle, position), triangle.normal};
    });
    if (surface_.is_closed)
      met.direction = met.side_before > 0 ? ContactDirection::entering : ContactDirection::leaving;
    const double forward = point_.to < point_.from ? -1.0 : 1.0;
    if (first_.status == ContactStatus::separated || forward * (met.time - first_.time) < 0.0) first_ = met;
  }

  static bool is_on(const Triangle& triangle, const Vector3& p, double tolerance) {
    return std::abs(height(triangle, p)) <= tolerance && in_plane_gap(triangle, p) <= tolerance;
  }

  const SurfaceTriangles& surface_;
  const MovingBall& point_;
  const ContactMemory& memory_;
  Vector3 start_;
  std::set<int> searched_;
  int side_at_end_ = 0;  // of the triangles on which the path ends
  ContactResult first_;
};

}  // namespace

ContactResult point_surface_contact(const SurfaceTriangles& surface, const MovingBall& point,
                                    const ContactMemory& memory) {
  return PointSurfaceSearch(surface, point, memory).run();
}

}  // namespace trajet::detail
