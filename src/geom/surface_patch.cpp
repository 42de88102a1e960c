#include "trajet/geom/surface_patch.hpp"

#include <array>
#include <cmath>
#include <variant>

#include "trajet/geom/cavity.hpp"

namespace trajet {
namespace {

using Kind = SurfacePatch::Kind;

/// Of the size of the coordinates: what lies nearer to a feature is on it.
constexpr double kNear = 1e-8;

SurfacePatch corner_patch(const Vector3& corner, double side = 1.0) {
  return {.kind = Kind::point, .center = corner, .side = side};
}

/// A stretch of a line, on either side of its middle.
SurfacePatch line_patch(const Vector3& middle, const Vector3& axis, double half_length, double side = 1.0) {
  SurfacePatch patch{.kind = Kind::line, .center = middle, .axis = axis, .side = side};
  if (!std::isfinite(half_length)) return patch;
  for (const double sign : {1.0, -1.0}) patch.edges.push_back({sign * axis, sign * axis.dot(middle) + half_length});
  return patch;
}

/// The edge of a face that looks along `normal`: past it the ball comes back over the face.
SurfacePatch edge_patch(const Vector3& a, const Vector3& b, const Vector3& outward) {
  SurfacePatch patch = line_patch(0.5 * (a + b), (b - a).normalized(), 0.5 * (b - a).norm());
  patch.edges.push_back({-outward, -outward.dot(a)});
  return patch;
}

class PatchFinder {
 public:
  using Result = std::optional<SurfacePatch>;
  PatchFinder(const Vector3& point, const Vector3& position) : point_(point), position_(position) {}

  Result operator()(const Sphere& sphere) const { return corner_patch(sphere.center); }

  Result operator()(const Disk& disk) const { return rim(disk.center, disk.normal, disk.radius); }

  Result operator()(const Triangle& triangle) const {
    return polygon({triangle.corners[0], triangle.corners[1], triangle.corners[2]}, triangle.normal);
  }

  Result operator()(const Rectangle& rectangle) const {
    const Vector3 x = 0.5 * rectangle.width * rectangle.up.cross(rectangle.normal);
    const Vector3 y = 0.5 * rectangle.height * rectangle.up;
    const Vector3& c = rectangle.center;
    std::vector<Vector3> corners{c - x - y, c + x - y, c + x + y, c - x + y};
    if (x.cross(y).dot(rectangle.normal) < 0.0) std::swap(corners[1], corners[3]);
    return polygon(corners, rectangle.normal);
  }

  Result operator()(const Box& box) const {
    const Vector3 place = box.R_WB.transpose() * (point_ - box.center);
    std::vector<int> at_face;
    for (int i = 0; i < 3; ++i)
      if (std::abs(place[i]) > box.half_size[i] - kNear * box.half_size.norm()) at_face.push_back(i);
    if (at_face.size() < 2) return std::nullopt;
    Vector3 middle = Vector3::Zero();
    for (const int i : at_face) middle[i] = std::copysign(box.half_size[i], place[i]);
    const Vector3 center = box.center + box.R_WB * middle;
    if (at_face.size() == 3) {
      SurfacePatch patch = corner_patch(center);
      add_faces(patch, box, place, at_face);
      return patch;
    }
    const int along = 3 - at_face[0] - at_face[1];
    SurfacePatch patch = line_patch(center, box.R_WB.col(along), box.half_size[along]);
    add_faces(patch, box, place, at_face);
    return patch;
  }

  Result operator()(const SolidOfRevolution& solid) const {
    const Vector3 axis = solid.R_WB.col(2);
    const Vector3 arm = position_ - solid.center;
    const double height = axis.dot(arm);
    const Eigen::Vector2d place((arm - height * axis).norm(), height);
    const double size = place.norm() + solid.growth;
    std::optional<SurfacePatch> best;
    double nearest = 0.0;
    for (std::size_t i = 0; i + 1 < solid.profile.size(); ++i) {
      const Eigen::Vector2d from = solid.profile[i], step = solid.profile[i + 1] - from;
      const double length = step.norm();
      if (length == 0.0) continue;
      const double share = step.dot(place - from) / (length * length);
      const Eigen::Vector2d foot = from + std::min(1.0, std::max(0.0, share)) * step;
      const double distance = (place - foot).norm();
      if (best && distance >= nearest - kNear * size) continue;
      nearest = distance;
      if (share > 0.0 && share < 1.0 && std::abs(step.y()) > 0.0) {
        best = side(solid, axis, from, solid.profile[i + 1]);
      } else {
        const Vector3 center = solid.center + foot.y() * axis;
        best = foot.x() <= kNear * size ? corner_patch(center) : rim(center, axis, foot.x());
        // below the rim of an end comes the side
        const double outward = height - foot.y() >= 0.0 ? 1.0 : -1.0;
        best->edges.push_back({-outward * axis, -outward * axis.dot(center)});
      }
    }
    return best;
  }

  Result operator()(const Cavity& cavity) const {
    if (!cavity.walls->round) return std::nullopt;
    const RoundWall& wall = *cavity.walls->round;
    const Vector3 axis = wall.R_WB.col(2);
    const double height = axis.dot(position_ - wall.center);
    if (std::abs(height) <= wall.half_length && wall.half_length > 0.0)
      return line_patch(wall.center, axis, wall.half_length, -1.0);
    SurfacePatch patch = corner_patch(wall.center + std::copysign(wall.half_length, height) * axis, -1.0);
    if (wall.half_length > 0.0) {
      const Vector3 back = -std::copysign(1.0, height) * axis;
      patch.edges.push_back({back, back.dot(patch.center)});
    }
    return patch;
  }

  Result operator()(const Plane&) const { return std::nullopt; }
  Result operator()(const EllipsoidBody&) const { return std::nullopt; }
  Result operator()(const MeshSurface&) const { return std::nullopt; }
  Result operator()(const Terrain&) const { return std::nullopt; }

 private:
  Result polygon(const std::vector<Vector3>& corners, const Vector3& normal) const {
    double size = 0.0;
    for (const Vector3& corner : corners) size = std::max(size, (corner - corners[0]).norm());
    for (const Vector3& corner : corners)
      if ((point_ - corner).norm() <= kNear * size) return corner_patch(corner);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const Vector3 outward = (b - a).normalized().cross(normal);
      if (std::abs(outward.dot(point_ - a)) <= kNear * size) return edge_patch(a, b, outward);
    }
    return std::nullopt;
  }

  /// A circle from which the ball comes back over what is within it.
  static SurfacePatch rim(const Vector3& center, const Vector3& axis, double radius) {
    return {.kind = Kind::circle,
            .center = center,
            .axis = axis,
            .radius = radius,
            .inner_rim = FaceRim{center, axis, radius}};
  }

  /// The surface that a stretch of the profile sweeps.
  static SurfacePatch side(const SolidOfRevolution& solid, const Vector3& axis, const Eigen::Vector2d& from,
                           const Eigen::Vector2d& to) {
    const Eigen::Vector2d along = (to - from).normalized();
    SurfacePatch patch{.kind = along.x() == 0.0 ? Kind::line : Kind::cone, .center = solid.center, .axis = axis};
    // the outward normal of a profile that runs upward is (along.y, -along.x)
    patch.slope = -along.x();
    if (patch.kind == Kind::cone) return patch;
    patch.edges.push_back({axis, axis.dot(solid.center) + std::max(from.y(), to.y())});
    patch.edges.push_back({-axis, -axis.dot(solid.center) - std::min(from.y(), to.y())});
    return patch;
  }

  /// Back over a face where it is not beyond the other one any more.
  static void add_faces(SurfacePatch& patch, const Box& box, const Vector3& place, const std::vector<int>& at_face) {
    for (const int i : at_face) {
      const Vector3 outward = std::copysign(1.0, place[i]) * box.R_WB.col(i);
      patch.edges.push_back({-outward, -outward.dot(patch.center)});
    }
  }

  Vector3 point_;
  Vector3 position_;
};

}  // namespace

std::optional<SurfacePatch> patch_at(const Shape& shape, const Vector3& point, const Vector3& normal,
                                     const Vector3& position) {
  if (is_flat_at(shape, point, normal)) {
    SurfacePatch patch{.kind = Kind::plane, .center = point, .axis = normal};
    FaceOutline outline = face_outline(shape, point, normal);
    patch.edges = std::move(outline.edges);
    patch.outer_rim = outline.rim;
    return patch;
  }
  std::optional<SurfacePatch> patch = std::visit(PatchFinder(point, position), shape);
  if (!patch) return std::nullopt;
  constexpr double kTilt = 1e-5;  // rad: far above what a contact's normal is off, far below another feature's
  const Vector3 above = (position - point).norm() > 0.0 ? position : Vector3(position + normal);
  return (normal_of<double>(*patch, position) - normal).norm() <= kTilt ||
                 (normal_of<double>(*patch, above) - normal).norm() <= kTilt
             ? patch
             : std::nullopt;
}

}  // namespace trajet
