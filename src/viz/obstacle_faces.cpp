#include "obstacle_faces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "trajet/geom/cavity.hpp"
#include "trajet/geom/shape_pictures.hpp"
#include "trajet/geom/triangle_surface.hpp"

namespace trajet::detail {

namespace {

constexpr int kCircleSides = 48;
/// An obstacle that is this much larger than the motion does not set the picture's size.
constexpr double kLargestObstacle = 3.0;
/// A plane across an axis is near if it is this far from the motion, against the motion's extent along the axis.
constexpr double kNearPlane = 1.2;
/// What of a terrain is this near to the motion, against its size, is shown.
constexpr double kNearGround = 0.4;

/// What of a polygon lies within a box, cut by one side after the other.
std::vector<Vector3> clip(std::vector<Vector3> polygon, const Eigen::AlignedBox3d& box) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const double bound = side < 0.0 ? box.min()[axis] : box.max()[axis];
      const double tolerance = 1e-9 * box.sizes().maxCoeff();
      const auto outside = [&](const Vector3& p) { return side * (p[axis] - bound) - tolerance; };
      std::vector<Vector3> inside;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double at_a = outside(a), at_b = outside(b);
        if (at_a <= 0.0) inside.push_back(a);
        if ((at_a <= 0.0) != (at_b <= 0.0)) inside.push_back(a + (at_a / (at_a - at_b)) * (b - a));
      }
      polygon = std::move(inside);
    }
  return polygon;
}

std::vector<Face> faces_of(const Plane& plane, const Eigen::AlignedBox3d& box) {
  const Vector3 center = box.center() - plane.normal.dot(box.center() - plane.point) * plane.normal;
  const double size = 2.0 * box.sizes().norm();
  return {face(make_rectangle(center, plane.normal, plane.normal.unitOrthogonal(), size, size))};
}
std::vector<Face> faces_of(const Disk& disk, const Eigen::AlignedBox3d&) { return {face(disk, kCircleSides)}; }
std::vector<Face> faces_of(const Rectangle& rectangle, const Eigen::AlignedBox3d&) { return {face(rectangle)}; }
std::vector<Face> faces_of(const Triangle& triangle, const Eigen::AlignedBox3d&) { return {face(triangle)}; }
std::vector<Face> faces_of(const Sphere&, const Eigen::AlignedBox3d&) { return {}; }
std::vector<Face> faces_of(const Box& box, const Eigen::AlignedBox3d&) {
  const auto sides = faces(box);
  return {sides.begin(), sides.end()};
}

/// A surface of very many triangles is drawn as the box around it.
std::vector<Face> faces_of(const MeshSurface& surface, const Eigen::AlignedBox3d&) {
  constexpr int kMostTriangles = 4000;
  const TriangleMesh mesh = picture_of(surface);
  if (surface.triangles->size() <= kMostTriangles) return faces(mesh);
  Eigen::AlignedBox3d around;
  for (const Vector3& vertex : mesh.vertices) around.extend(vertex);
  const auto sides = faces(Box{around.center(), 0.5 * around.sizes(), Matrix3::Identity()});
  return {sides.begin(), sides.end()};
}

std::vector<Face> faces_of(const SolidOfRevolution& solid, const Eigen::AlignedBox3d&) {
  return faces(placed(local_picture(solid), solid.center, solid.R_WB));
}
std::vector<Face> faces_of(const EllipsoidBody& ellipsoid, const Eigen::AlignedBox3d&) {
  return faces(placed(local_picture(ellipsoid), ellipsoid.center, ellipsoid.R_WB));
}

/// Seen from inside.
std::vector<Face> faces_of(const Cavity& cavity, const Eigen::AlignedBox3d&) {
  std::vector<Face> inward = faces(cavity.walls->picture);
  for (Face& face : inward) {
    std::reverse(face.corners.begin(), face.corners.end());
    face.normal = -face.normal;
  }
  return inward;
}
std::vector<Face> faces_of(const Terrain& terrain, const Eigen::AlignedBox3d& box) {
  return faces(picture(terrain, Aabb{box.min(), box.max()}));
}

std::vector<Face> whole_faces(const Shape& shape, const Eigen::AlignedBox3d& box) {
  return std::visit([&](const auto& each) { return faces_of(each, box); }, shape);
}

Eigen::AlignedBox3d box_of(const Shape& shape, const Eigen::AlignedBox3d& motion) {
  Eigen::AlignedBox3d box;
  for (const Face& face : whole_faces(shape, motion))
    for (const Vector3& corner : face.corners) box.extend(corner);
  if (const auto* ball = std::get_if<Sphere>(&shape)) {
    box.extend(Vector3(ball->center.array() - ball->radius));
    box.extend(Vector3(ball->center.array() + ball->radius));
  }
  return box;
}

}  // namespace

std::vector<Face> obstacle_faces(const Shape& shape, const Eigen::AlignedBox3d& box) {
  std::vector<Face> result;
  for (Face& each : whole_faces(shape, box)) {
    each.corners = clip(std::move(each.corners), box);
    if (!each.corners.empty()) result.push_back(std::move(each));
  }
  return result;
}

Eigen::AlignedBox3d with_obstacles(const Eigen::AlignedBox3d& motion, const std::vector<World::Obstacle>& obstacles) {
  Eigen::AlignedBox3d box = motion;
  const double size = motion.sizes().maxCoeff();
  for (const World::Obstacle& obstacle : obstacles) {
    if (std::holds_alternative<Plane>(obstacle.shape) || std::holds_alternative<Terrain>(obstacle.shape)) continue;
    const Eigen::AlignedBox3d around = box_of(obstacle.shape, motion);
    if (around.isEmpty()) continue;
    if (around.sizes().maxCoeff() <= kLargestObstacle * size) box.extend(around);
  }
  // the ground beneath the motion
  for (const World::Obstacle& obstacle : obstacles)
    if (std::holds_alternative<Terrain>(obstacle.shape))
      for (const Face& face : whole_faces(obstacle.shape, motion))
        for (const Vector3& corner : face.corners)
          if (motion.exteriorDistance(corner) <= kNearGround * size) box.extend(corner);
  const Eigen::AlignedBox3d without_planes = box;
  for (const World::Obstacle& obstacle : obstacles) {
    const auto* plane = std::get_if<Plane>(&obstacle.shape);
    if (plane == nullptr) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 along = Vector3::Unit(axis);
      if (plane->normal.cross(along).norm() > 1e-12) continue;
      const double at = plane->point[axis], extent = without_planes.sizes()[axis];
      const double distance = std::max(without_planes.min()[axis] - at, at - without_planes.max()[axis]);
      if (distance > 0.0 && distance <= kNearPlane * extent)
        box.extend(Vector3(without_planes.center() + (at - without_planes.center()[axis]) * along));
    }
  }
  return box;
}

}  // namespace trajet::detail
