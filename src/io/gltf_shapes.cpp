#include "gltf_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "trajet/geom/cavity.hpp"
#include "trajet/geom/faces.hpp"
#include "trajet/geom/shape_pictures.hpp"
#include "trajet/geom/triangle_surface.hpp"

namespace trajet::detail {

namespace {

using std::numbers::pi;

/// An obstacle that is this much larger than the motion does not set the picture's size.
constexpr double kLargestObstacle = 3.0;
/// The radius of a point against the size of the motion, and at most against the smallest obstacle.
constexpr double kPointRadius = 0.01;
constexpr double kPointOfObstacle = 0.5;
/// Half the side of a plane, against the size of the motion.
constexpr double kPlaneHalf = 0.75;
/// Of the rods and balls that stand for named points, against how far the body reaches.
constexpr double kRodRadius = 0.035;
constexpr double kNamedPointRadius = 0.05;
/// Planes of pentagons are 0.939 of the corners' radius away from a soccer ball's centre, those of hexagons 0.915.
constexpr double kPentagonDistance = 0.927;
/// Sides of what stands for a circle.
constexpr int kCircleSides = 48;

/// A flat convex polygon, corners counterclockwise from where its normal points to.
void add_polygon(GltfMesh& mesh, std::span<const Vector3> corners, const Vector3& normal, Tint tint = Tint::own) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vector3& corner : corners) {
    mesh.positions.push_back(corner.cast<float>());
    mesh.normals.push_back(normal.cast<float>());
  }
  auto& triangles = mesh.triangles[tint];
  for (std::uint32_t i = 2; i < corners.size(); ++i)
    triangles.insert(triangles.end(), {first, first + i - 1, first + i});
}

/// A ball of `radius` around the origin. With `shows_spin` every other octant is light.
GltfMesh ball_mesh(double radius, bool shows_spin) {
  constexpr int kRings = kCircleSides / 2;
  GltfMesh mesh;
  for (int i = 0; i <= kRings; ++i)
    for (int j = 0; j <= kCircleSides; ++j) {
      const double polar = pi * i / kRings;
      const double azimuth = 2.0 * pi * j / kCircleSides;
      const Vector3 normal(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
      mesh.positions.push_back((radius * normal).cast<float>());
      mesh.normals.push_back(normal.cast<float>());
    }
  const auto index = [](int i, int j) { return static_cast<std::uint32_t>(i * (kCircleSides + 1) + j); };
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kCircleSides; ++j) {
      const int octant = i / (kRings / 2) + j / (kCircleSides / 4);
      auto& triangles = mesh.triangles[shows_spin && octant % 2 == 0 ? Tint::light : Tint::own];
      // at the poles one of the two triangles has no area
      if (i > 0) triangles.insert(triangles.end(), {index(i, j), index(i + 1, j), index(i, j + 1)});
      if (i < kRings - 1) triangles.insert(triangles.end(), {index(i, j + 1), index(i + 1, j), index(i + 1, j + 1)});
    }
  return mesh;
}

/// Adds the faces of another mesh.
void add(GltfMesh& mesh, const GltfMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
  for (const auto& [tint, triangles] : other.triangles)
    for (const std::uint32_t index : triangles) mesh.triangles[tint].push_back(first + index);
}

/// The side of a cylinder from the origin to `end`.
GltfMesh rod_mesh(const Vector3& end, double radius) {
  const Vector3 u = end.unitOrthogonal();
  const Vector3 v = end.normalized().cross(u);
  GltfMesh mesh;
  for (int j = 0; j <= kCircleSides; ++j) {
    const double angle = 2.0 * pi * j / kCircleSides;
    const Vector3 normal = std::cos(angle) * u + std::sin(angle) * v;
    for (const Vector3& foot : {Vector3(Vector3::Zero()), end}) {
      mesh.positions.push_back((foot + radius * normal).cast<float>());
      mesh.normals.push_back(normal.cast<float>());
    }
  }
  auto& triangles = mesh.triangles[Tint::own];
  for (std::uint32_t k = 0; k < 2 * kCircleSides; k += 2)
    triangles.insert(triangles.end(), {k, k + 2, k + 1, k + 1, k + 2, k + 3});
  return mesh;
}

/// How far a body with its named points reaches from its origin.
double reach(const World::Body& body) {
  double farthest = bounding_radius(body.solid);
  for (const World::Point& point : body.points) farthest = std::max(farthest, point.p_B.norm());
  return farthest;
}

GltfMesh polygon_mesh(const Face& polygon) {
  GltfMesh mesh;
  add_polygon(mesh, polygon.corners, polygon.normal);
  return mesh;
}

Vector3 middle(const Triangle& triangle) {
  return (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3.0;
}

Quaternion turn_to(const Vector3& normal) { return Quaternion::FromTwoVectors(Vector3::UnitZ(), normal); }

/// The rotation whose frame has these axes.
Quaternion turn_to(const Vector3& x, const Vector3& z) {
  Matrix3 R;
  R << x, z.cross(x), z;
  return Quaternion(R);
}

Pose pose_of(const Plane& plane, const Extent& extent) {
  return {extent.center - plane.normal.dot(extent.center - plane.point) * plane.normal, turn_to(plane.normal)};
}

Pose pose_of(const Disk& disk, const Extent&) { return {disk.center, turn_to(disk.normal)}; }

Pose pose_of(const Rectangle& rectangle, const Extent&) {
  return {rectangle.center, turn_to(rectangle.up.cross(rectangle.normal), rectangle.normal)};
}

Pose pose_of(const Triangle& triangle, const Extent&) {
  return {middle(triangle), turn_to((triangle.corners[1] - triangle.corners[0]).normalized(), triangle.normal)};
}

Pose pose_of(const Sphere& sphere, const Extent&) { return {sphere.center, Quaternion::Identity()}; }

Pose pose_of(const Box& box, const Extent&) { return {box.center, Quaternion(box.R_WB)}; }

Pose pose_of(const MeshSurface& surface, const Extent&) {
  return {bounding_ball(surface).center, Quaternion::Identity()};
}

Pose pose_of(const SolidOfRevolution& solid, const Extent&) { return {solid.center, Quaternion(solid.R_WB)}; }

Pose pose_of(const EllipsoidBody& ellipsoid, const Extent&) { return {ellipsoid.center, Quaternion(ellipsoid.R_WB)}; }

/// Its picture stands in the world.
Pose pose_of(const Cavity&, const Extent&) { return {Vector3::Zero(), Quaternion::Identity()}; }

Pose pose_of(const Terrain&, const Extent&) { return {Vector3::Zero(), Quaternion::Identity()}; }

GltfMesh faceted(const TriangleMesh& surface) {
  GltfMesh mesh;
  for (const auto& triangle : surface.triangles) {
    Vector3 corners[3];
    for (std::size_t i = 0; i < 3; ++i) corners[i] = surface.vertices[static_cast<std::size_t>(triangle[i])];
    add_polygon(mesh, corners, (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized());
  }
  return mesh;
}

GltfMesh mesh_of(const Plane&, const Extent& extent) {
  const double side = 2.0 * kPlaneHalf * extent.size;
  return polygon_mesh(face(make_rectangle(Vector3::Zero(), Vector3::UnitZ(), Vector3::UnitY(), side, side)));
}

GltfMesh mesh_of(const Disk& disk, const Extent&) {
  return polygon_mesh(face(make_disk(Vector3::Zero(), Vector3::UnitZ(), disk.radius), kCircleSides));
}

GltfMesh mesh_of(const Rectangle& rectangle, const Extent&) {
  return polygon_mesh(
      face(make_rectangle(Vector3::Zero(), Vector3::UnitZ(), Vector3::UnitY(), rectangle.width, rectangle.height)));
}

GltfMesh mesh_of(const Triangle& triangle, const Extent& extent) {
  const Quaternion q_BW = pose_of(triangle, extent).q_WB.conjugate();
  Face local{{}, Vector3::UnitZ()};
  for (const Vector3& corner : triangle.corners) local.corners.emplace_back(q_BW * (corner - middle(triangle)));
  return polygon_mesh(local);
}

GltfMesh mesh_of(const Sphere& sphere, const Extent&) { return ball_mesh(sphere.radius, false); }

GltfMesh mesh_of(const Box& box, const Extent&) {
  GltfMesh mesh;
  for (const Face& each : faces(Box{Vector3::Zero(), box.half_size, Matrix3::Identity()}))
    add_polygon(mesh, each.corners, each.normal);
  return mesh;
}

GltfMesh mesh_of(const MeshSurface& surface, const Extent&) {
  const Vector3 origin = bounding_ball(surface).center;
  if (surface.triangles->growth > 0.0) return faceted(placed(picture_of(surface), -origin, Matrix3::Identity()));
  GltfMesh mesh;
  for (int i = 0; i < surface.triangles->size(); ++i) {
    const Triangle triangle = surface.triangles->triangle(i);
    const Vector3 corners[3] = {triangle.corners[0] - origin, triangle.corners[1] - origin,
                                triangle.corners[2] - origin};
    add_polygon(mesh, corners, triangle.normal);
  }
  return mesh;
}

GltfMesh mesh_of(const SolidOfRevolution& solid, const Extent&) { return faceted(local_picture(solid)); }

GltfMesh mesh_of(const EllipsoidBody& ellipsoid, const Extent&) { return faceted(local_picture(ellipsoid)); }

/// Seen from inside.
GltfMesh mesh_of(const Cavity& cavity, const Extent&) {
  TriangleMesh inward = cavity.walls->picture;
  for (auto& triangle : inward.triangles) std::swap(triangle[1], triangle[2]);
  return faceted(inward);
}

GltfMesh mesh_of(const Terrain& terrain, const Extent& extent) {
  const Vector3 half = Vector3::Constant(0.5 * extent.size);
  return faceted(picture(terrain, Aabb{extent.center - half, extent.center + half}));
}

}  // namespace

GltfMesh body_mesh(const World::Body& body, const Extent& extent) {
  GltfMesh mesh;
  const auto* soccer_ball = std::get_if<SoccerBall>(&body.solid);
  const TriangleMesh surface = picture_mesh(body.solid);
  for (const auto& triangle : surface.triangles) {
    Vector3 corners[3];
    for (std::size_t i = 0; i < 3; ++i) corners[i] = surface.vertices[static_cast<std::size_t>(triangle[i])];
    const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    Tint tint = Tint::own;
    if (soccer_ball != nullptr)
      tint = normal.dot(corners[0]) > kPentagonDistance * soccer_ball->radius ? Tint::dark : Tint::light;
    add_polygon(mesh, corners, normal, tint);
  }
  if (!mesh.positions.empty()) return mesh;
  if (bounding_radius(body.solid) > 0.0) return ball_mesh(bounding_radius(body.solid), body.rotation.has_value());
  const double size = reach(body);
  if (size == 0.0) return ball_mesh(extent.point_radius, false);
  mesh = ball_mesh(kRodRadius * size, false);
  for (const World::Point& point : body.points)
    if (point.p_B.norm() > 0.0) add(mesh, rod_mesh(point.p_B, kRodRadius * size));
  return mesh;
}

GltfMesh point_mesh(const World::Body& body, const Extent& extent) {
  return ball_mesh(reach(body) > 0.0 ? kNamedPointRadius * reach(body) : extent.point_radius, false);
}

Pose obstacle_pose(const Shape& shape, const Extent& extent) {
  return std::visit([&](const auto& each) { return pose_of(each, extent); }, shape);
}

GltfMesh obstacle_mesh(const Shape& shape, const Extent& extent) {
  return std::visit([&](const auto& each) { return mesh_of(each, extent); }, shape);
}

Extent extent(const RecordedMotion& motion) {
  const World& world = motion.world();
  Eigen::AlignedBox3d box;
  const auto extend = [&](const Vector3& center, double radius) {
    box.extend(Vector3(center.array() - radius));
    box.extend(Vector3(center.array() + radius));
  };
  for (const World::Body& body : world.bodies) {
    const auto pieces = motion.read(body.group);
    while (const RecordedPiece* const next = pieces->next()) {
      const RecordedPiece& piece = *next;
      // enough points that no bend of a long piece is missed
      constexpr int kParts = 8;
      for (int i = 0; i <= kParts; ++i) {
        const double t = piece.from + (piece.to - piece.from) * i / kParts;
        const auto at = [&](int axis) { return piece.segment.value(body.slice().position_index() + axis, t); };
        extend({at(0), at(1), at(2)}, reach(body));
      }
    }
  }
  if (box.isEmpty()) box.extend(Vector3(Vector3::Zero()));
  const double motion_size = box.sizes().maxCoeff();
  double smallest_obstacle = std::numeric_limits<double>::infinity();
  for (const World::Obstacle& obstacle : world.obstacles)
    std::visit(
        [&](const auto& shape) {
          if constexpr (requires { bounding_ball(shape); }) {
            const BoundingBall ball = bounding_ball(shape);
            smallest_obstacle = std::min(smallest_obstacle, ball.radius);
            if (2.0 * ball.radius <= kLargestObstacle * motion_size) extend(ball.center, ball.radius);
          }
        },
        obstacle.shape);
  const double size = box.sizes().maxCoeff() > 0.0 ? box.sizes().maxCoeff() : 1.0;
  return {box.center(), size, std::min(kPointRadius * size, kPointOfObstacle * smallest_obstacle)};
}

}  // namespace trajet::detail
