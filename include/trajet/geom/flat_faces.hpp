#pragma once

#include <optional>
#include <vector>

#include "trajet/geom/shapes.hpp"

namespace trajet {

/// What bodies that stay on an obstacle need to know of its flat parts. World frame, m.

/// Whether a shape is thin: it has two sides, and nothing within.
bool is_thin(const Shape& shape);

/// Whether a point just above a face, at a point of it with that normal, is on the negative side of a thin shape; never
/// of a solid.
bool looks_down(const Shape& shape, const Vector3& point, const Vector3& normal);

/// The normal of the plane in which a disk, a rectangle or a triangle lies; other shapes lie in none.
std::optional<Vector3> plane_normal(const Shape& shape);

/// Whether a body can rest on a shape at a point of its surface where its normal is `normal`: on a flat face; not on a
/// curved surface, an edge, a corner.
bool is_flat_at(const Shape& shape, const Vector3& point, const Vector3& normal);

/// A straight edge of a flat face: direction . p - limit is how far p is past it.
struct FaceEdge {
  Vector3 direction;  ///< unit, in the plane of the face
  double limit;
};

/// The round edge of a flat face.
struct FaceRim {
  Vector3 center;
  Vector3 normal;  ///< unit, of the face
  double radius;
};

/// All that ends a face.
struct FaceOutline {
  std::vector<FaceEdge> edges{};
  std::optional<FaceRim> rim{};
};

/// The outline of the face at a point of a shape's surface where its normal is `normal`; a face without end has none.
/// Of a surface of triangles it is that of one of them: at an edge, give a point a little ahead in the one that is
/// meant.
FaceOutline face_outline(const Shape& shape, const Vector3& point, const Vector3& normal);

/// Whether a body whose centre is at `position`, above the point of a face, is at an edge of it and moves off it.
bool moves_off(const FaceOutline& outline, const Vector3& position, const Vector3& velocity);

}  // namespace trajet
