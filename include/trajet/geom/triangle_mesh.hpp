#pragma once

#include <array>
#include <span>
#include <vector>

#include "trajet/math/vector.hpp"

namespace trajet {

/// A surface of triangles. Seen from outside, the corners of each are in counterclockwise order.
struct TriangleMesh {
  std::vector<Vector3> vertices;              ///< m
  std::vector<std::array<int, 3>> triangles;  ///< indices of vertices
};

/// The convex hull of points, with none but its own corners as vertices; faces of more than three corners are cut into
/// triangles. Points within 1e-12 of the extent from a face count as inside it.
/// Throws std::domain_error if fewer than four points span a volume or a coordinate is not finite.
TriangleMesh convex_hull(std::span<const Vector3> points);

/// What is left of a convex hull where all of its faces move inward by `depth` (m). Throws std::domain_error if nothing
/// solid is left.
TriangleMesh eroded_hull(const TriangleMesh& hull, double depth);

/// The 60 corners of a truncated icosahedron, a soccer ball, at `radius` (m) around the origin; two of its pentagons
/// are closest to the axes of the golden rectangles that span it.
std::vector<Vector3> truncated_icosahedron(double radius);

/// Joins vertices at the same place, drops triangles without area, and turns the surface inside out if it encloses a
/// negative volume. Throws std::domain_error if it is not closed: every edge has a triangle on either side, in opposite
/// directions.
TriangleMesh closed_mesh(const TriangleMesh& mesh);

}  // namespace trajet
