#include "contact_patch.hpp"

#include <algorithm>
#include <cmath>

#include "trajet/portable.hpp"

namespace trajet::detail {
namespace {

using Point2 = Eigen::Vector2d;
using Polygon = std::vector<Point2>;

double cross(const Point2& a, const Point2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Coordinates in the plane of contact; its normal, seen from, makes them right-handed.
struct Plane2 {
  Vector3 right = Vector3::UnitX();
  Vector3 up = Vector3::UnitY();
  explicit Plane2(const Vector3& normal) : right(normal.unitOrthogonal()), up(normal.cross(right)) {}
  Point2 operator()(const Vector3& p) const { return {right.dot(p), up.dot(p)}; }
  Vector3 operator()(const Point2& p, double height, const Vector3& normal) const {
    return right * p.x() + up * p.y() + normal * height;
  }
};

/// What of a core lies in its supporting plane.
struct Flat {
  Polygon corners{};    ///< counterclockwise; two of an edge, one of a vertex
  double radius = 0.0;  ///< of a disk around the only corner, m
  Feature feature = Feature::vertex;
};

/// Corners of a convex polygon, in order around it.
void sort_around(Polygon& p) {
  Point2 middle = Point2::Zero();
  for (const Point2& q : p) middle += q / static_cast<double>(p.size());
  ranges::sort(p, [&](const Point2& a, const Point2& b) {
    return std::atan2(a.y() - middle.y(), a.x() - middle.x()) < std::atan2(b.y() - middle.y(), b.x() - middle.x());
  });
}

/// `direction`: in the core's frame; `place`: to the frame of the contact.
template <class Place>
Flat flat_part(const ConvexCore& core, const Vector3& direction, double margin, const Plane2& plane, Place&& place) {
  Flat flat;
  const CoreSupport farthest = support(core, direction);
  if (core.is_spread()) {
    flat.feature = Feature::vertex;
    for (std::size_t i = 0; i < core.vertices.size(); ++i) {
      const Matrix3& E = core.spreads[i];
      const Vector3 y = E.transpose() * direction;
      const double length = y.norm();
      if (direction.dot(core.vertices[i]) + length < farthest.height - margin) continue;
      // of a disk that lies in the plane every point is as far
      const bool is_flat = length <= margin;
      flat.corners.push_back(plane(place(is_flat ? core.vertices[i] : Vector3(core.vertices[i] + E * (y / length)))));
      if (E.isZero(0.0)) continue;
      flat.feature = is_flat ? Feature::face : Feature::surface;
      if (is_flat) flat.radius = E.col(0).norm();
    }
    return flat;
  }
  for (const Vector3& v : core.vertices)
    if (direction.dot(v) >= farthest.height - margin) flat.corners.push_back(plane(place(v)));
  const std::size_t count = flat.corners.size();
  if (count > 2) sort_around(flat.corners);
  flat.feature = count > 2             ? Feature::face
                 : core.rounding > 0.0 ? Feature::surface
                 : count == 2          ? Feature::edge
                                       : Feature::vertex;
  return flat;
}

/// The part of a convex polygon, or stretch, to the left of the line from a to b; corners within the margin of it stay.
Polygon left_of(const Polygon& p, const Point2& a, const Point2& b, double margin) {
  const Point2 d = (b - a).normalized();
  const auto side = [&](const Point2& q) { return cross(d, q - a); };
  Polygon kept;
  const std::size_t n = p.size(), sides = n == 2 ? 1 : n;
  if (n == 2 && side(p[0]) >= -margin) kept.push_back(p[0]);
  for (std::size_t i = 0; i < sides; ++i) {
    const Point2 &q = p[i], &r = p[(i + 1) % n];
    const double from = side(q), to = side(r);
    if ((from < -margin) != (to < -margin)) kept.push_back(q + (r - q) * std::clamp(from / (from - to), 0.0, 1.0));
    if (to >= -margin) kept.push_back(r);
  }
  return kept;
}

/// What of a disk another flat part covers: that part's corners within the disk, and where its sides cross the rim; of
/// a disk that is all within the other part its middle.
Polygon within_disk(const Point2& middle, double radius, const Flat& other, double margin) {
  if (other.radius > 0.0) {
    const Point2 d = other.corners[0] - middle;
    const double apart = d.norm(), least = std::min(radius, other.radius);
    if (apart <= std::abs(radius - other.radius) + margin) return {radius == least ? middle : other.corners[0]};
    // where the two rims cross
    const double x = 0.5 * (apart + (radius - other.radius) * (radius + other.radius) / apart);
    const double y = std::sqrt(std::max(0.0, radius * radius - x * x));
    const Point2 along = d / apart, aside(-along.y(), along.x());
    return {middle + x * along + y * aside, middle + x * along - y * aside};
  }
  const Polygon& p = other.corners;
  if (p.size() == 1) {
    const Point2 d = p[0] - middle;
    return {d.norm() <= radius ? p[0] : Point2(middle + d * (radius / d.norm()))};
  }
  Polygon covered;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point2 &from = p[i], &to = p[(i + 1) % p.size()];
    if ((from - middle).norm() <= radius + margin) covered.push_back(from);
    if (p.size() == 2 && i == 1) break;
    // |from + s (to - from) - middle| = radius
    const Point2 d = to - from, o = from - middle;
    const double a = d.squaredNorm(), half = d.dot(o) / a, rest = half * half - (o.squaredNorm() - radius * radius) / a;
    if (rest <= 0.0) continue;
    for (const double s : {-half - std::sqrt(rest), -half + std::sqrt(rest)})
      if (s > 0.0 && s < 1.0) covered.push_back(from + s * d);
  }
  return covered.empty() ? Polygon{middle} : covered;
}

Polygon shared(const Flat& of_a, const Flat& of_b, double margin) {
  if (of_a.radius > 0.0) return within_disk(of_a.corners[0], of_a.radius, of_b, margin);
  if (of_b.radius > 0.0) return within_disk(of_b.corners[0], of_b.radius, of_a, margin);
  const Polygon &a = of_a.corners, &b = of_b.corners;
  if (a.size() == 1) return a;
  if (b.size() == 1) return b;
  if (a.size() == 2 && b.size() == 2) {
    const Point2 d = a[1] - a[0], e = b[1] - b[0];
    const double sine = cross(d, e) / (d.norm() * e.norm());
    // nearer to parallel the point where the lines cross says nothing
    constexpr double kParallel = 1e-6;
    if (std::abs(sine) > kParallel) {
      const double s = std::clamp(cross(b[0] - a[0], e) / cross(d, e), 0.0, 1.0);
      return {a[0] + s * d};
    }
    const double length = d.norm(), x = d.dot(b[0] - a[0]) / length, y = d.dot(b[1] - a[0]) / length;
    const double from = std::clamp(std::min(x, y), 0.0, length), to = std::clamp(std::max(x, y), 0.0, length);
    if (to - from <= margin) return {a[0] + d * (0.5 * (from + to) / length)};
    return {a[0] + d * (from / length), a[0] + d * (to / length)};
  }
  const Polygon& clip = a.size() > 2 ? a : b;
  Polygon rest = a.size() > 2 ? b : a;
  for (std::size_t i = 0; i < clip.size() && !rest.empty(); ++i)
    rest = left_of(rest, clip[i], clip[(i + 1) % clip.size()], margin);
  return rest;
}

/// Corners within the margin of each other count once.
void join_equal(Polygon& p, double margin) {
  Polygon kept;
  for (const Point2& q : p)
    if (ranges::all_of(kept, [&](const Point2& k) { return (q - k).norm() > margin; })) kept.push_back(q);
  p = kept;
}

}  // namespace

ContactPatch contact_patch(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, const Vector3& normal,
                           double margin) {
  const Plane2 plane(normal);
  const Flat of_b = flat_part(B, -(pose.R_AB.transpose() * normal), margin, plane,
                              [&](const Vector3& p) { return Vector3(pose.p_AB + pose.R_AB * p); });
  ContactPatch patch;
  patch.of_b = of_b.feature;
  Polygon common = of_b.corners;
  double height = 0.0;
  if (A.is_half_space) {
    patch.of_a = Feature::face;
  } else {
    const Flat of_a = flat_part(A, normal, margin, plane, [](const Vector3& p) { return p; });
    patch.of_a = of_a.feature;
    height = support(A, normal).height + A.rounding;
    common = shared(of_a, of_b, margin);
    // features that miss each other by more than the margin: the corner that is nearest will do
    if (common.empty()) common.push_back(of_b.corners.front());
  }
  join_equal(common, 2.0 * margin);
  for (const Point2& p : common) {
    patch.corners.push_back(plane(p, height, normal));
    patch.point += patch.corners.back() / static_cast<double>(common.size());
  }
  return patch;
}

}  // namespace trajet::detail
