#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "trajet/geom/box_tree.hpp"
#include "trajet/geom/convex_faces.hpp"
#include "trajet/geom/shapes.hpp"
#include "trajet/geom/triangle_mesh.hpp"

namespace trajet {

/// The triangles of a MeshSurface, and the tree in which those near a place are found.
struct SurfaceTriangles {
  TriangleMesh mesh;  ///< vertices in one place are one; no triangle is without area; neighbours look to the same side
  bool is_closed;     ///< it encloses matter, and its triangles look outward
  double spacing;     ///< m, the mean length of an edge
  BoxTree tree;       ///< over the triangles
  /// Of a convex surface that is one solid: where it came from a hull.
  std::shared_ptr<const ConvexFaces> convex{};
  double growth = 0.0;  ///< m: the surface is this far outside the triangles; only of what is convex

  int size() const { return static_cast<int>(mesh.triangles.size()); }
  Triangle triangle(int index) const;
};

/// Joins vertices in one place, leaves triangles without area out, and turns neighbours to the same side, outward where
/// the surface is closed. Throws std::domain_error if there is no triangle or a vertex is not finite.
MeshSurface make_mesh_surface(const TriangleMesh& mesh);

/// The convex hull of points, with edges and corners rounded inside it: for `rounding` > 0 (m) the triangles of a
/// smaller hull, grown. Throws std::domain_error as `convex_hull` does, or if nothing is left of the smaller one.
MeshSurface make_hull_surface(std::span<const Vector3> points, double rounding = 0.0);

/// How far inside the matter of a closed surface p is, negative, or else how far from the surface, m.
double signed_distance(const MeshSurface& surface, const Vector3& p);

/// A triangle of a surface and its point nearest to a place.
struct SurfacePlace {
  int triangle;
  Vector3 point;
  double distance;  ///< m
};
SurfacePlace nearest_place(const SurfaceTriangles& surface, const Vector3& p);

/// The triangles that a point is on to within `tolerance` (m).
std::vector<int> triangles_at(const SurfaceTriangles& surface, const Vector3& point, double tolerance);

}  // namespace trajet
