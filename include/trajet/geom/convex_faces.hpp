#pragma once

#include <vector>

#include "trajet/geom/triangle_mesh.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// What the surface of a convex polytope consists of; adjoining triangles in one plane are one face. World frame, m.
struct ConvexFaces {
  struct Side {
    Vector3 normal;  ///< unit, outward
    Vector3 point;
    std::vector<int> edges{};  ///< around it
  };
  /// Between two faces.
  struct Edge {
    int from, to;   ///< corners
    Vector3 along;  ///< unit
    double length;
    int sides[2];
    Vector3 past[2];  ///< unit, in the plane of each side, out of it across the edge
  };
  std::vector<Vector3> corners;
  std::vector<std::vector<int>> edges_at;  ///< of each corner
  std::vector<Side> sides;
  std::vector<Edge> edges;
};

/// Of a convex hull.
ConvexFaces convex_faces(const TriangleMesh& hull);

}  // namespace trajet
