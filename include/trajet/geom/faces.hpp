#pragma once

#include <array>
#include <vector>

#include "trajet/geom/shapes.hpp"
#include "trajet/geom/triangle_mesh.hpp"

namespace trajet {

/// A flat polygon without holes, as pictures show it.
struct Face {
  std::vector<Vector3> corners;  ///< m; counterclockwise from where the normal points to
  Vector3 normal;                ///< unit
};

/// The disk as a regular polygon of so many sides.
Face face(const Disk& disk, int sides);
Face face(const Rectangle& rectangle);
Face face(const Triangle& triangle);
/// Normals point outward.
std::array<Face, 6> faces(const Box& box);

/// The faces of a surface: adjoining triangles in one plane (to 1e-6 rad) are joined where this leaves no hole.
/// Triangles without area are left out.
std::vector<Face> faces(const TriangleMesh& surface);

}  // namespace trajet
