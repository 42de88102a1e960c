#pragma once

#include <vector>

#include "trajet/geom/solid.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// A flat face of a convex core.
struct CoreFace {
  Vector3 normal = Vector3::Zero();  ///< unit, outward
  double offset = 0.0;               ///< the largest of normal . p over the core, m
  std::vector<int> loop{};           ///< its corners, counterclockwise from outside; none of a round face
};

/// A straight edge of a convex core.
struct CoreEdge {
  int from = 0;  ///< its vertices
  int to = 0;
  Vector3 direction = Vector3::Zero();  ///< from one to the other, unit
  double length = 0.0;                  ///< m
  /// Unit, orthogonal to the edge, each in one of the faces beside it and into that; none of a stretch without faces.
  std::vector<Vector3> inward{};
};

/// A convex solid, as a hull of corners grown by a radius, in the frame of the solid.
///
/// A capsule is a stretch grown by a radius, a ball a point; thin plates have two faces. A corner can be spread to a
/// disk or an ellipsoid: a cylinder is the hull of two disks. A half space is a kind of its own: z <= 0, one face and
/// no corner.
struct ConvexCore {
  std::vector<Vector3> vertices{};  ///< m
  /// Of each vertex, or none at all: the matrix E of the ellipsoid {E y : |y| <= 1} that is added to it, m.
  std::vector<Matrix3> spreads{};
  std::vector<CoreFace> faces{};
  std::vector<CoreEdge> edges{};
  std::vector<std::vector<int>> faces_of{};  ///< of each vertex
  std::vector<std::vector<int>> edges_of{};  ///< of each vertex
  double rounding = 0.0;                     ///< m, by which the hull is grown
  double reach = 0.0;                        ///< m: of the ball around the origin that holds all; infinite: half space
  bool is_half_space = false;

  bool is_spread() const { return !spreads.empty(); }
};

/// A point of a core farthest in a direction, rounding left out.
struct CoreSupport {
  int vertex = 0;
  Vector3 point = Vector3::Zero();
  double height = 0.0;  ///< direction . point
};
/// Of a bounded core; `direction` has any length.
CoreSupport support(const ConvexCore& core, const Vector3& direction);

/// The core of a convex solid. Throws std::domain_error for a mesh, which is not convex.
ConvexCore convex_core(const Solid& solid);

/// |x_i / radii_i| <= 1, all radii > 0.
ConvexCore ellipsoid_core(const Vector3& radii);
/// Around z: a disk at `base` (m) and the apex at another height.
ConvexCore cone_core(double radius, double base, double apex);
/// The hull of corners of a convex solid with triangles for a surface, those that lie in one plane joined to faces.
ConvexCore hull_core(const TriangleMesh& surface);
/// A flat convex polygon of at least three corners, in order around it: a plate without thickness, or one triangle of a
/// mesh.
ConvexCore polygon_core(const std::vector<Vector3>& corners);

}  // namespace trajet
