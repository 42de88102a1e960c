#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "trajet/math/vector.hpp"

namespace trajet {

/// Shapes at rest in the world frame: plain numbers, SI units. Make them with the `make_*` functions, which normalise
/// directions and throw std::domain_error, with a message for the user, where the numbers do not describe the shape.

/// A half space: the solid lies behind the plane, on the side away from the normal.
struct Plane {
  Vector3 point;
  Vector3 normal;  ///< unit
};

/// A flat disk, thin and two-sided, its rim included.
struct Disk {
  Vector3 center;
  Vector3 normal;  ///< unit
  double radius;
};

/// A flat rectangle, thin and two-sided, its edges included.
struct Rectangle {
  Vector3 center;
  Vector3 normal;  ///< unit
  Vector3 up;      ///< unit, orthogonal to the normal: the direction of the height
  double width;    ///< full length along up x normal
  double height;   ///< full length along up
};

/// A flat triangle, thin and two-sided, its edges included.
struct Triangle {
  Vector3 corners[3];
  Vector3 normal;  ///< unit, right-handed with the order of the corners
};
/// The unit vector in the triangle's plane that is orthogonal to the edge from corner i to corner i + 1 and points
/// outward.
Vector3 edge_outward(const Triangle& triangle, int i);

/// A solid ball.
struct Sphere {
  Vector3 center;
  double radius;
};

/// A solid cuboid.
struct Box {
  Vector3 center;
  Vector3 half_size;  ///< half edge lengths in the box's own frame
  Matrix3 R_WB;       ///< its columns are the box's axes in the world
};

/// A convex solid of revolution: all that is within `growth` of its core, which a polygon sweeps that turns about the
/// axis. A cylinder is a turned rectangle, a cone a turned triangle, a capsule a stretch of the axis that has grown.
struct SolidOfRevolution {
  Vector3 center;  ///< the origin of its frame
  Matrix3 R_WB;    ///< its columns are the axes of the frame in the world; the last is the axis of revolution
  /// Corners of the core's half section: distance from the axis, >= 0, and height along it, m; from the axis to the
  /// axis again, lower end first, the core on the left.
  std::vector<Eigen::Vector2d> profile;
  double growth;  ///< m, >= 0
};

/// A solid ellipsoid.
struct EllipsoidBody {
  Vector3 center;
  Vector3 radii;  ///< along its own axes, m
  Matrix3 R_WB;   ///< its columns are the axes in the world
};

struct SurfaceTriangles;

/// A surface of triangles: what it encloses where it is closed, else thin and two-sided; a convex one may have grown,
/// so that its edges are round. `make_mesh_surface` and `make_hull_surface` (triangle_surface.hpp) make it.
struct MeshSurface {
  std::shared_ptr<const SurfaceTriangles> triangles;
};

struct CavityWalls;

/// All but a room, a bowl or a pipe, in which bodies live. `make_*_cavity` (cavity.hpp) make it.
struct Cavity {
  std::shared_ptr<const CavityWalls> walls;
};

class Landscape;

/// The ground beneath a height that is a function of x and y of a frame. For points. landscape.hpp says what it offers.
struct Terrain {
  std::shared_ptr<const Landscape> landscape;
};

using Shape = std::variant<Plane, Disk, Rectangle, Triangle, Sphere, Box, MeshSurface, SolidOfRevolution, EllipsoidBody,
                           Cavity, Terrain>;

/// `normal`: any length but zero.
Plane make_plane(const Vector3& point, const Vector3& normal);
/// `radius` > 0.
Disk make_disk(const Vector3& center, const Vector3& normal, double radius);
/// `up` is made orthogonal to the normal, to which it must not be parallel; `width`, `height` > 0.
Rectangle make_rectangle(const Vector3& center, const Vector3& normal, const Vector3& up, double width, double height);
/// The corners must not lie on a line.
Triangle make_triangle(const Vector3& a, const Vector3& b, const Vector3& c);
/// `radius` > 0.
Sphere make_sphere(const Vector3& center, double radius);
/// `size`: full edge lengths, > 0. `R_WB`: a rotation, to 1e-9 in every element of R^T R.
Box make_box(const Vector3& center, const Vector3& size, const Matrix3& R_WB);
/// Around z of the frame: from -height/2 to height/2. `radius`, `height` > 0. `R_WB` as of a box.
SolidOfRevolution make_cylinder(const Vector3& center, const Matrix3& R_WB, double radius, double height);
/// All that is within `radius` of the axis from -height/2 to height/2.
SolidOfRevolution make_capsule(const Vector3& center, const Matrix3& R_WB, double radius, double height);
/// With the centre of mass at `center`: the base of that radius at -height/4, the tip at 3/4 of the height.
SolidOfRevolution make_cone(const Vector3& center, const Matrix3& R_WB, double radius, double height);
/// `radii` > 0.
EllipsoidBody make_ellipsoid(const Vector3& center, const Matrix3& R_WB, const Vector3& radii);

/// A ball that contains a shape.
struct BoundingBall {
  Vector3 center;
  double radius;
};
BoundingBall bounding_ball(const Disk& disk);
BoundingBall bounding_ball(const Rectangle& rectangle);
BoundingBall bounding_ball(const Triangle& triangle);
BoundingBall bounding_ball(const Sphere& sphere);
BoundingBall bounding_ball(const Box& box);
BoundingBall bounding_ball(const MeshSurface& surface);
BoundingBall bounding_ball(const SolidOfRevolution& solid);
BoundingBall bounding_ball(const EllipsoidBody& ellipsoid);

}  // namespace trajet
