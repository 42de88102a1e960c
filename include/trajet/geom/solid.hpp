#pragma once

#include <memory>
#include <optional>
#include <span>
#include <variant>

#include "trajet/geom/aabb.hpp"
#include "trajet/geom/mass_properties.hpp"
#include "trajet/geom/triangle_mesh.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// Solids in a frame of their own, with the centre of mass at its origin: what bodies and obstacles alike are made of,
/// wherever they stand. Plain numbers, m.

struct Point {};

struct Ball {
  double radius;
};

struct Cuboid {
  Vector3 half_size;
};

/// Around z.
struct Cylinder {
  double radius;
  double half_height;
};

/// Around z: the points within `radius` of a stretch of the axis.
struct Capsule {
  double radius;
  double half_height;  ///< of the stretch
};

/// Around z: the base at -height/4, the tip at 3/4 of the height.
struct Cone {
  double radius;  ///< of the base
  double height;
};

struct Ellipsoid {
  Vector3 radii;  ///< along x, y, z
};

/// A truncated icosahedron.
struct SoccerBall {
  double radius;  ///< of its corners
};

/// The surface of a hull or a mesh, with what follows from it.
struct Polyhedron {
  TriangleMesh surface;
  double radius = 0.0;                           ///< of the farthest vertex
  std::optional<VolumeProperties> properties{};  ///< none where the surface is open
};

/// A convex solid.
struct Hull {
  std::shared_ptr<const Polyhedron> polyhedron;
};

/// What a surface of triangles encloses; where it is open, the thin surface itself.
struct Mesh {
  std::shared_ptr<const Polyhedron> polyhedron;
};

struct RoundedCore;

/// A convex solid whose edges and corners are round: a smaller one that has grown. `make_rounded_*` (rounded_solid.hpp)
/// make it.
struct RoundedSolid {
  std::shared_ptr<const RoundedCore> core;
};

struct CompoundParts;

/// Several solids as one. `make_compound` (compound.hpp) makes it.
struct Compound {
  std::shared_ptr<const CompoundParts> parts;
};

/// z <= 0.
struct HalfSpace {};

/// All around a place where bodies live, without bounds: what a cavity and a terrain are made of.
struct Surroundings {};

/// Thin and two-sided, in the plane z = 0.
struct RoundPlate {
  double radius;
};
struct RectangularPlate {
  double half_width;   ///< along x
  double half_height;  ///< along y
};
struct TriangularPlate {
  Vector3 corners[3];  ///< counterclockwise seen from z
};

using Solid =
    std::variant<Point, Ball, Cuboid, Cylinder, Capsule, Cone, Ellipsoid, SoccerBall, Hull, Mesh, RoundedSolid,
                 Compound, HalfSpace, Surroundings, RoundPlate, RectangularPlate, TriangularPlate>;

/// The convex hull of points, moved to its centre of mass. Throws std::domain_error as `convex_hull` does.
Hull make_hull(std::span<const Vector3> points);
/// A closed surface, moved to its centre of mass. Throws std::domain_error as `closed_mesh` does.
Mesh make_closed_mesh(const TriangleMesh& surface);

/// A surface, moved to its centre of mass, or to the middle of the box around it where it is open.
struct CenteredMesh {
  Mesh mesh;
  Vector3 origin;  ///< of the mesh's frame in the surface's
};
/// Throws std::domain_error if the surface is said to be closed and encloses no volume.
CenteredMesh make_mesh(TriangleMesh surface, bool is_closed);

/// The distance of the farthest point from the origin; infinite for a half space and surroundings.
double bounding_radius(const Solid& solid);

/// Whether the solid is all that is within a distance of its origin, so that it has a contact where its centre comes
/// that near: a point or a ball.
bool is_round(const Solid& solid);

/// Volume, centre of mass and inertia; none of what has no volume, or an infinite one.
std::optional<VolumeProperties> volume_properties(const Solid& solid);

/// A box around a solid whose frame B stands in the world like this; it contains the solid in spite of rounding.
Aabb bounds(const Solid& solid, const Vector3& p_WB, const Matrix3& R_WB);

/// The surface in flat pieces, for pictures: what is round along an axis has 32 sides, within the solid. Nothing of
/// points, balls and what has no bounds, and of what is too flat for a picture.
TriangleMesh picture_mesh(const Solid& solid);

}  // namespace trajet
