#include "gltf_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "trajet/geom/faces.hpp"

namespace trajet::detail {

namespace {

using std::numbers::pi;

/// An obstacle that is this much larger than the motion does not set the picture's size.
constexpr double kLargestObstacle = 3.0;
/// The radius of a point, and half the side of a plane, against the size of the motion.
constexpr double kPointRadius = 0.01;
constexpr double kPlaneHalf = 0.75;
/// Sides of what stands for a circle.
constexpr int kCircleSides = 48;

/// A flat convex polygon, corners counterclockwise from where its normal points to.
void add_polygon(GltfMesh& mesh, std::span<const Vector3> corners, const Vector3& normal) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vector3& corner : corners) {
    mesh.positions.push_back(corner.cast<float>());
    mesh.normals.push_back(normal.cast<float>());
  }
  for (std::uint32_t i = 2; i < corners.size(); ++i)
    mesh.indices.insert(mesh.indices.end(), {first, first + i - 1, first + i});
}

GltfMesh polygon_mesh(const Face& polygon) {
  GltfMesh mesh;
  add_polygon(mesh, polygon.corners, polygon.normal);
  return mesh;
}

GltfMesh moved(GltfMesh mesh, const Vector3& by) {
  for (Eigen::Vector3f& position : mesh.positions) position += by.cast<float>();
  return mesh;
}

GltfMesh mesh_of(const Plane& plane, const Extent& extent) {
  const Vector3 center = extent.center - plane.normal.dot(extent.center - plane.point) * plane.normal;
  const Vector3 u = kPlaneHalf * extent.size * plane.normal.unitOrthogonal();
  const Vector3 v = plane.normal.cross(u);
  return polygon_mesh({{center - u - v, center + u - v, center + u + v, center - u + v}, plane.normal});
}

GltfMesh mesh_of(const Disk& disk, const Extent&) { return polygon_mesh(face(disk, kCircleSides)); }

GltfMesh mesh_of(const Rectangle& rectangle, const Extent&) { return polygon_mesh(face(rectangle)); }

GltfMesh mesh_of(const Triangle& triangle, const Extent&) { return polygon_mesh(face(triangle)); }

GltfMesh mesh_of(const Sphere& sphere, const Extent&) { return moved(ball_mesh(sphere.radius), sphere.center); }

GltfMesh mesh_of(const Box& box, const Extent&) {
  GltfMesh mesh;
  for (const Face& each : faces(box)) add_polygon(mesh, each.corners, each.normal);
  return mesh;
}

}  // namespace

GltfMesh ball_mesh(double radius) {
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
      // at the poles one of the two triangles has no area
      if (i > 0) mesh.indices.insert(mesh.indices.end(), {index(i, j), index(i + 1, j), index(i, j + 1)});
      if (i < kRings - 1)
        mesh.indices.insert(mesh.indices.end(), {index(i, j + 1), index(i + 1, j), index(i + 1, j + 1)});
    }
  return mesh;
}

GltfMesh body_mesh(const World::Body& body, const Extent& extent) {
  GltfMesh mesh;
  for (const auto& triangle : body.surface.triangles) {
    Vector3 corners[3];
    for (std::size_t i = 0; i < 3; ++i) corners[i] = body.surface.vertices[static_cast<std::size_t>(triangle[i])];
    add_polygon(mesh, corners, (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized());
  }
  if (!mesh.positions.empty()) return mesh;
  return ball_mesh(body.radius > 0.0 && body.is_ball ? body.radius : kPointRadius * extent.size);
}

GltfMesh obstacle_mesh(const Shape& shape, const Extent& extent) {
  return std::visit([&](const auto& each) { return mesh_of(each, extent); }, shape);
}

Extent extent(const MotionRecord& motion) {
  const World& world = motion.world();
  Eigen::AlignedBox3d box;
  for (const World::Body& body : world.bodies)
    for (const MotionRecord::Piece& piece : motion.pieces(body.group)) {
      // enough points that no bend of a long piece is missed
      constexpr int kParts = 8;
      for (int i = 0; i <= kParts; ++i) {
        const double t = piece.from + (piece.to - piece.from) * i / kParts;
        const auto at = [&](int axis) { return piece.segment.value(body.offset + axis, t); };
        box.extend(Vector3(at(0), at(1), at(2)));
      }
    }
  if (box.isEmpty()) return {Vector3::Zero(), 1.0};
  const double motion_size = box.sizes().maxCoeff();
  for (const World::Obstacle& obstacle : world.obstacles)
    std::visit(
        [&](const auto& shape) {
          if constexpr (requires { bounding_ball(shape); }) {
            const BoundingBall ball = bounding_ball(shape);
            if (2.0 * ball.radius > kLargestObstacle * motion_size) return;
            box.extend(Vector3(ball.center.array() - ball.radius));
            box.extend(Vector3(ball.center.array() + ball.radius));
          }
        },
        obstacle.shape);
  const double size = box.sizes().maxCoeff();
  return {box.center(), size > 0.0 ? size : 1.0};
}

}  // namespace trajet::detail
