#include "trajet/geom/solid_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "trajet/geom/compound.hpp"
#include "trajet/geom/rounded_solid.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

Vector3 farthest(std::span<const Vector3> points, const Vector3& direction) {
  return *ranges::max_element(points, {}, [&](const Vector3& p) { return p.dot(direction); });
}

double with_sign(double size, double of) { return of < 0.0 ? -size : size; }

Vector3 along(const Vector3& direction, double length) {
  const double norm = direction.norm();
  return norm > 0.0 ? Vector3(direction * (length / norm)) : Vector3(0, 0, 0);
}

/// The point of a convex solid that lies farthest in a direction of its own frame.
struct Support {
  const Vector3& d;
  Vector3 operator()(const Point&) const { return {0, 0, 0}; }
  Vector3 operator()(const Ball& ball) const { return along(d, ball.radius); }
  Vector3 operator()(const Cuboid& cuboid) const { return box(cuboid.half_size); }
  Vector3 operator()(const Cylinder& cylinder) const { return round(cylinder.radius, cylinder.half_height); }
  Vector3 operator()(const Capsule& capsule) const {
    return along(d, capsule.radius) + Vector3(0, 0, with_sign(capsule.half_height, d.z()));
  }
  Vector3 operator()(const Cone& cone) const {
    const Vector3 tip(0.0, 0.0, 0.75 * cone.height);
    const Vector3 rim = along({d.x(), d.y(), 0.0}, cone.radius) - Vector3(0.0, 0.0, 0.25 * cone.height);
    return d.dot(tip) > d.dot(rim) ? tip : rim;
  }
  Vector3 operator()(const Ellipsoid& ellipsoid) const {
    const Vector3 stretched = ellipsoid.radii.cwiseProduct(d);
    return ellipsoid.radii.cwiseProduct(along(stretched, 1.0));
  }
  Vector3 operator()(const SoccerBall& ball) const { return farthest(truncated_icosahedron(ball.radius), d); }
  Vector3 operator()(const Hull& hull) const { return farthest(hull.polyhedron->surface.vertices, d); }
  Vector3 operator()(const Mesh& mesh) const { return farthest(mesh.polyhedron->surface.vertices, d); }
  Vector3 operator()(const RoundPlate& plate) const { return round(plate.radius, 0.0); }
  Vector3 operator()(const RectangularPlate& plate) const { return box({plate.half_width, plate.half_height, 0.0}); }
  Vector3 operator()(const TriangularPlate& plate) const { return farthest(plate.corners, d); }
  Vector3 operator()(const RoundedSolid& solid) const { return farthest_point(*solid.core, d); }
  // what has no bounds, or is not convex, has no such point
  Vector3 operator()(const HalfSpace&) const { return none(); }
  Vector3 operator()(const Surroundings&) const { return none(); }
  Vector3 operator()(const Compound&) const { return none(); }

 private:
  static Vector3 none() { return Vector3::Constant(std::numeric_limits<double>::quiet_NaN()); }
  Vector3 box(const Vector3& half) const {
    return {with_sign(half.x(), d.x()), with_sign(half.y(), d.y()), with_sign(half.z(), d.z())};
  }
  Vector3 round(double radius, double half_height) const {
    return along({d.x(), d.y(), 0.0}, radius) + Vector3(0, 0, with_sign(half_height, d.z()));
  }
};

/// Of the solid, a little smaller, so that one that touches another is apart from it.
Vector3 support(const PlacedSolid& placed, const Vector3& direction) {
  constexpr double kSize = 1.0 - 1e-10;
  const Vector3 d = placed.R_WB.transpose() * direction;
  return placed.p_WB + kSize * placed.R_WB * std::visit(Support{d}, placed.solid);
}

/// The corners, at most four, of a simplex in the difference of two solids; the newest one comes last.
class Simplex {
 public:
  void add(const Vector3& p) { corners_[size_++] = p; }

  /// Keeps the part next to the origin and turns `direction` from it to the origin. True where the origin is inside.
  bool approach_origin(Vector3& direction) {
    const Vector3 a = corners_[size_ - 1];
    if (size_ == 4) return from_tetrahedron(a, direction);
    if (size_ == 3) {
      from_triangle(a, corners_[1], corners_[0], direction);
    } else {
      from_line(a, corners_[0], direction);
    }
    return false;
  }

 private:
  void keep(std::initializer_list<Vector3> corners) {
    ranges::copy(corners, corners_.begin());
    size_ = corners.size();
  }

  void from_line(const Vector3& a, const Vector3& b, Vector3& direction) {
    const Vector3 ab = b - a;
    if (ab.dot(a) >= 0.0) {
      keep({a});
      direction = -a;
      return;
    }
    keep({b, a});
    direction = ab.cross(-a).cross(ab);
    if (direction.squaredNorm() == 0.0) direction = ab.unitOrthogonal();
  }

  void from_triangle(const Vector3& a, const Vector3& b, const Vector3& c, Vector3& direction) {
    const Vector3 ab = b - a, ac = c - a, normal = ab.cross(ac);
    if (normal.cross(ac).dot(a) < 0.0) return ac.dot(a) < 0.0 ? from_line(a, c, direction) : from_line(a, b, direction);
    if (ab.cross(normal).dot(a) < 0.0) return from_line(a, b, direction);
    if (normal.dot(a) <= 0.0) {
      keep({c, b, a});
      direction = normal;
    } else {
      keep({b, c, a});
      direction = -normal;
    }
  }

  bool from_tetrahedron(const Vector3& a, Vector3& direction) {
    const std::array<Vector3, 3> base{corners_[2], corners_[1], corners_[0]};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 &b = base[i], &c = base[(i + 1) % 3];
      Vector3 outward = (b - a).cross(c - a);
      if (outward.dot(base[(i + 2) % 3] - a) > 0.0) outward = -outward;
      if (outward.dot(a) >= 0.0) continue;
      from_triangle(a, b, c, direction);
      return false;
    }
    return true;
  }

  std::array<Vector3, 4> corners_;
  std::size_t size_ = 0;
};

}  // namespace

bool overlap(const PlacedSolid& a, const PlacedSolid& b) {
  if (const auto* compound = std::get_if<Compound>(&a.solid))
    return ranges::any_of(compound->parts->parts, [&](const CompoundPart& part) {
      return overlap({part.solid, a.p_WB + a.R_WB * part.p_BP, a.R_WB * part.R_BP}, b);
    });
  if (std::holds_alternative<Compound>(b.solid)) return overlap(b, a);
  // what lies no deeper than rounding only touches
  constexpr double kTouch = 1e-12;
  const double reach = bounding_radius(a.solid) + bounding_radius(b.solid);
  const Vector3 apart = b.p_WB - a.p_WB;
  const double touch = kTouch * (reach + a.p_WB.norm() + b.p_WB.norm());
  if (apart.norm() >= reach - touch) return false;
  if (is_round(a.solid) && is_round(b.solid)) return true;

  Vector3 direction = apart.norm() > touch ? apart : Vector3(1, 0, 0);
  Simplex simplex;
  // curved solids that nearly touch need the most: they count as touching
  constexpr int kMaxCorners = 64;
  for (int i = 0; i < kMaxCorners; ++i) {
    const Vector3 corner = support(a, direction) - support(b, -direction);
    if (!(corner.dot(direction) >= 0.0)) return false;
    simplex.add(corner);
    if (i == 0) {
      direction = -corner;
    } else if (simplex.approach_origin(direction)) {
      return true;
    }
  }
  return false;
}

}  // namespace trajet
