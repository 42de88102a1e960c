#include "trajet/geom/flat_faces.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "trajet/geom/cavity.hpp"
#include "trajet/geom/distance.hpp"
#include "trajet/geom/triangle_surface.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// A point on a surface is on its triangles within so much, of its size and theirs: far above rounding.
double on_surface(const SurfaceTriangles& surface, const Vector3& point) {
  constexpr double kOnSurface = 1e-11;
  return kOnSurface * (point.lpNorm<1>() + surface.spacing);
}

bool are_parallel(const Vector3& a, const Vector3& b) {
  constexpr double kTilt = 1e-9;  // rad: far above rounding, far below what an edge's normal is off
  return a.cross(b).norm() < kTilt;
}

/// The triangle of a surface on which a point is, or goes on, deepest within: of those with that normal.
std::optional<Triangle> triangle_at(const SurfaceTriangles& surface, const Vector3& point, const Vector3& normal) {
  std::optional<Triangle> deepest;
  const Vector3 foot = point - surface.growth * normal;
  for (const int index : triangles_at(surface, foot, on_surface(surface, foot))) {
    const Triangle triangle = surface.triangle(index);
    if (!are_parallel(triangle.normal, normal)) continue;
    if (!deepest || in_plane_gap(triangle, foot) < in_plane_gap(*deepest, foot)) deepest = triangle;
  }
  return deepest;
}

/// The flat end of a solid of revolution that looks along `normal`, if there is one.
std::optional<FaceRim> level_end(const SolidOfRevolution& solid, const Vector3& normal) {
  const Vector3 axis = solid.R_WB.col(2);
  if (!are_parallel(axis, normal)) return std::nullopt;
  const bool is_upper = axis.dot(normal) > 0.0;
  const std::size_t last = solid.profile.size() - 2;
  const Eigen::Vector2d from = solid.profile[is_upper ? last : 0], to = solid.profile[is_upper ? last + 1 : 1];
  if (from.y() != to.y()) return std::nullopt;
  const double side = is_upper ? 1.0 : -1.0;
  return FaceRim{solid.center + (from.y() + side * solid.growth) * axis, axis, std::max(from.x(), to.x())};
}

/// The direction in which a face of a shape looks, if it is flat there.
class FlatNormal {
 public:
  FlatNormal(const Vector3& point, const Vector3& normal) : point_(point), normal_(normal) {}

  bool operator()(const Plane& plane) const { return is_parallel(plane.normal); }
  bool operator()(const Disk& disk) const { return is_parallel(disk.normal); }
  bool operator()(const Rectangle& rectangle) const { return is_parallel(rectangle.normal); }
  bool operator()(const Triangle& triangle) const { return is_parallel(triangle.normal); }
  bool operator()(const Box& box) const {
    return is_parallel(box.R_WB.col(0)) || is_parallel(box.R_WB.col(1)) || is_parallel(box.R_WB.col(2));
  }
  bool operator()(const Sphere&) const { return false; }
  bool operator()(const EllipsoidBody&) const { return false; }
  bool operator()(const Terrain&) const { return false; }
  bool operator()(const Cavity& cavity) const {
    return ranges::any_of(cavity.walls->planes, [&](const Plane& plane) {
      const double size = point_.lpNorm<1>() + plane.point.lpNorm<1>();
      constexpr double kOnSurface = 1e-9;
      return plane.normal.dot(normal_) > 0.0 && is_parallel(plane.normal) &&
             std::abs(signed_distance(plane, point_)) <= kOnSurface * size;
    });
  }
  bool operator()(const SolidOfRevolution& solid) const { return level_end(solid, normal_).has_value(); }
  bool operator()(const MeshSurface& surface) const {
    return triangle_at(*surface.triangles, point_, normal_).has_value();
  }

 private:
  bool is_parallel(const Vector3& direction) const { return are_parallel(normal_, direction); }

  Vector3 point_;
  Vector3 normal_;
};

class Outline {
 public:
  Outline(const Vector3& point, const Vector3& normal) : point_(point), normal_(normal) {}

  FaceOutline operator()(const Plane&) const { return {}; }
  FaceOutline operator()(const Sphere&) const { return {}; }
  FaceOutline operator()(const Disk& disk) const { return {{}, FaceRim{disk.center, disk.normal, disk.radius}}; }
  FaceOutline operator()(const Rectangle& rectangle) const {
    FaceOutline outline;
    add_pair(outline, rectangle.center, rectangle.up.cross(rectangle.normal), 0.5 * rectangle.width);
    add_pair(outline, rectangle.center, rectangle.up, 0.5 * rectangle.height);
    return outline;
  }
  FaceOutline operator()(const Triangle& triangle) const {
    FaceOutline outline;
    for (int i = 0; i < 3; ++i) {
      const Vector3 outward = edge_outward(triangle, i);
      outline.edges.push_back({outward, outward.dot(triangle.corners[i])});
    }
    return outline;
  }
  FaceOutline operator()(const Box& box) const {
    FaceOutline outline;
    int face = 0;
    (box.R_WB.transpose() * normal_).cwiseAbs().maxCoeff(&face);
    for (int i = 0; i < 3; ++i)
      if (i != face) add_pair(outline, box.center, box.R_WB.col(i), box.half_size[i]);
    return outline;
  }
  FaceOutline operator()(const EllipsoidBody&) const { return {}; }
  FaceOutline operator()(const Terrain&) const { return {}; }
  FaceOutline operator()(const Cavity&) const { return {}; }  // its other walls keep bodies on each
  FaceOutline operator()(const SolidOfRevolution& solid) const {
    const std::optional<FaceRim> end = level_end(solid, normal_);
    return {{}, end};
  }
  FaceOutline operator()(const MeshSurface& surface) const {
    const std::optional<Triangle> triangle = triangle_at(*surface.triangles, point_, normal_);
    return triangle ? (*this)(*triangle) : FaceOutline();
  }

 private:
  static void add_pair(FaceOutline& outline, const Vector3& center, const Vector3& direction, double half_length) {
    outline.edges.push_back({direction, direction.dot(center) + half_length});
    outline.edges.push_back({-direction, -direction.dot(center) + half_length});
  }

  Vector3 point_;
  Vector3 normal_;
};

struct Thin {
  bool operator()(const Plane&) const { return false; }
  bool operator()(const Disk&) const { return true; }
  bool operator()(const Rectangle&) const { return true; }
  bool operator()(const Triangle&) const { return true; }
  bool operator()(const Sphere&) const { return false; }
  bool operator()(const Box&) const { return false; }
  bool operator()(const SolidOfRevolution&) const { return false; }
  bool operator()(const EllipsoidBody&) const { return false; }
  bool operator()(const Cavity&) const { return false; }
  bool operator()(const Terrain&) const { return false; }
  bool operator()(const MeshSurface& surface) const { return !surface.triangles->is_closed; }
};

/// The normal of a thin shape's positive side at a point.
class PositiveSide {
 public:
  using Result = std::optional<Vector3>;
  PositiveSide(const Vector3& point, const Vector3& normal) : point_(point), normal_(normal) {}

  Result operator()(const Plane&) const { return std::nullopt; }
  Result operator()(const Disk& disk) const { return disk.normal; }
  Result operator()(const Rectangle& rectangle) const { return rectangle.normal; }
  Result operator()(const Triangle& triangle) const { return triangle.normal; }
  Result operator()(const Sphere&) const { return std::nullopt; }
  Result operator()(const Box&) const { return std::nullopt; }
  Result operator()(const SolidOfRevolution&) const { return std::nullopt; }
  Result operator()(const EllipsoidBody&) const { return std::nullopt; }
  Result operator()(const Cavity&) const { return std::nullopt; }
  Result operator()(const Terrain&) const { return std::nullopt; }
  Result operator()(const MeshSurface& surface) const {
    const std::optional<Triangle> triangle = triangle_at(*surface.triangles, point_, normal_);
    return triangle ? Result(triangle->normal) : std::nullopt;
  }

 private:
  Vector3 point_;
  Vector3 normal_;
};

}  // namespace

bool is_thin(const Shape& shape) { return std::visit(Thin(), shape); }

bool looks_down(const Shape& shape, const Vector3& point, const Vector3& normal) {
  const std::optional<Vector3> positive = std::visit(PositiveSide(point, normal), shape);
  return positive && positive->dot(normal) < 0.0;
}

std::optional<Vector3> plane_normal(const Shape& shape) {
  return std::visit(
      [](const auto& s) -> std::optional<Vector3> {
        using S = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<S, Disk> || std::is_same_v<S, Rectangle> || std::is_same_v<S, Triangle>)
          return s.normal;
        else
          return std::nullopt;
      },
      shape);
}

bool is_flat_at(const Shape& shape, const Vector3& point, const Vector3& normal) {
  return std::visit(FlatNormal(point, normal), shape);
}

FaceOutline face_outline(const Shape& shape, const Vector3& point, const Vector3& normal) {
  return std::visit(Outline(point, normal), shape);
}

bool moves_off(const FaceOutline& outline, const Vector3& position, const Vector3& velocity) {
  constexpr double kAtEdge = 1e-12;  // of the place and the size: far above rounding
  for (const FaceEdge& edge : outline.edges) {
    const double beyond = edge.direction.dot(position) - edge.limit;
    const double near = kAtEdge * (position.lpNorm<1>() + std::abs(edge.limit));
    if (beyond >= -near && edge.direction.dot(velocity) > 0.0) return true;
  }
  if (!outline.rim) return false;
  const FaceRim& rim = *outline.rim;
  Vector3 arm = position - rim.center;
  arm -= arm.dot(rim.normal) * rim.normal;
  const double near = kAtEdge * (position.lpNorm<1>() + rim.center.lpNorm<1>() + rim.radius);
  return arm.norm() >= rim.radius - near && arm.dot(velocity) > 0.0;
}

}  // namespace trajet
