#include "trajet/geom/shape_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "trajet/geom/landscape.hpp"
#include "trajet/geom/revolution_distance.hpp"
#include "trajet/geom/triangle_surface.hpp"

namespace trajet {
namespace {

constexpr int kSides = 32;
constexpr int kHalfCircle = 16;  // pieces of a half circle
constexpr double kPi = std::numbers::pi;

/// Adds an arc around a corner between two directions, angles from the outward radial one, both ends included.
void add_arc(std::vector<Eigen::Vector2d>& line, const Eigen::Vector2d& corner, double radius, double from, double to) {
  const int pieces = radius > 0.0 ? static_cast<int>(std::ceil((to - from) / kPi * kHalfCircle - 1e-9)) : 0;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = pieces == 0 ? from : from + (to - from) * i / pieces;
    Eigen::Vector2d point = corner + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    if (corner.x() == 0.0 && std::abs(std::abs(angle) - 0.5 * kPi) < 1e-12) point.x() = 0.0;
    line.push_back(point);
  }
}

}  // namespace

std::vector<Eigen::Vector2d> profile_outline(const std::vector<Eigen::Vector2d>& profile, double growth) {
  std::vector<Eigen::Vector2d> line;
  double before = -0.5 * kPi;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    double behind = 0.5 * kPi;
    if (i + 1 < profile.size()) {
      const Eigen::Vector2d normal = detail::ProfileEdge(profile[i], profile[i + 1]).normal;
      behind = std::atan2(normal.y(), normal.x());
    }
    add_arc(line, profile[i], growth, before, behind);
    before = behind;
  }
  return line;
}

TriangleMesh revolve(const std::vector<Eigen::Vector2d>& line) {
  TriangleMesh mesh;
  std::vector<int> first;  // vertex of each ring
  for (const Eigen::Vector2d& at : line) {
    first.push_back(static_cast<int>(mesh.vertices.size()));
    for (int j = 0; j < (at.x() > 0.0 ? kSides : 1); ++j) {
      const double angle = 2.0 * kPi * j / kSides;
      mesh.vertices.emplace_back(at.x() * std::cos(angle), at.x() * std::sin(angle), at.y());
    }
  }
  const auto vertex = [&](std::size_t ring, int j) {
    return line[ring].x() > 0.0 ? first[ring] + j % kSides : first[ring];
  };
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    for (int j = 0; j < kSides; ++j) {
      if (line[i].x() > 0.0) mesh.triangles.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j)});
      if (line[i + 1].x() > 0.0) mesh.triangles.push_back({vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j)});
    }
  return mesh;
}

TriangleMesh ellipsoid_picture(const Vector3& radii) {
  std::vector<Eigen::Vector2d> line;
  add_arc(line, {0.0, 0.0}, 1.0, -0.5 * kPi, 0.5 * kPi);
  TriangleMesh mesh = revolve(line);
  for (Vector3& vertex : mesh.vertices) vertex = vertex.cwiseProduct(radii);
  return mesh;
}

TriangleMesh grown_hull_picture(std::span<const Vector3> corners, double growth) {
  constexpr int kAround = 12;
  std::vector<Vector3> points;
  for (const Vector3& corner : corners)
    for (int i = 0; i <= kAround / 2; ++i) {
      const double polar = kPi * i / (kAround / 2);
      for (int j = 0; j < (i == 0 || i == kAround / 2 ? 1 : kAround); ++j) {
        const double azimuth = 2.0 * kPi * j / kAround;
        points.push_back(corner + growth * Vector3(std::sin(polar) * std::cos(azimuth),
                                                   std::sin(polar) * std::sin(azimuth), std::cos(polar)));
      }
    }
  return convex_hull(points);
}

TriangleMesh local_picture(const SolidOfRevolution& solid) {
  return revolve(profile_outline(solid.profile, solid.growth));
}

TriangleMesh local_picture(const EllipsoidBody& ellipsoid) { return ellipsoid_picture(ellipsoid.radii); }

TriangleMesh picture_of(const MeshSurface& surface) {
  const SurfaceTriangles& triangles = *surface.triangles;
  return triangles.growth > 0.0 ? grown_hull_picture(triangles.mesh.vertices, triangles.growth) : triangles.mesh;
}

TriangleMesh picture(const Terrain& terrain, const Aabb& box) {
  constexpr int kCells = 48;
  const Landscape& landscape = *terrain.landscape;
  Eigen::AlignedBox2d floor;
  for (int i = 0; i < 8; ++i) {
    const Vector3 corner(i & 1 ? box.upper.x() : box.lower.x(), i & 2 ? box.upper.y() : box.lower.y(),
                         i & 4 ? box.upper.z() : box.lower.z());
    const Vector3 q = landscape.R_WB().transpose() * (corner - landscape.p_WB());
    floor.extend(Eigen::Vector2d(q.head<2>()));
  }
  const double around = 0.25 * floor.sizes().maxCoeff();
  const Eigen::Vector2d low = floor.min().array() - around, size = floor.sizes().array() + 2.0 * around;
  TriangleMesh mesh;
  std::vector<int> vertices;
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j) {
      const double x = low.x() + size.x() * i / kCells, y = low.y() + size.y() * j / kCells;
      const double height = landscape.height(x, y);
      vertices.push_back(std::isfinite(height) ? static_cast<int>(mesh.vertices.size()) : -1);
      if (std::isfinite(height)) mesh.vertices.emplace_back(x, y, height);
    }
  const auto at = [&](int i, int j) { return vertices[static_cast<std::size_t>(i * (kCells + 1) + j)]; };
  const auto add = [&](int a, int b, int c) {
    if (std::min({a, b, c}) >= 0) mesh.triangles.push_back({a, b, c});
  };
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      add(at(i, j), at(i + 1, j), at(i, j + 1));
      add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return placed(std::move(mesh), landscape.p_WB(), landscape.R_WB());
}

TriangleMesh placed(TriangleMesh mesh, const Vector3& p_WB, const Matrix3& R_WB) {
  for (Vector3& vertex : mesh.vertices) vertex = p_WB + R_WB * vertex;
  return mesh;
}

}  // namespace trajet
