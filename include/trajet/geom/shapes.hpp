#pragma once

#include <memory>
#include <variant>

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

struct SurfaceTriangles;

/// A surface of triangles: what it encloses where it is closed, else thin and two-sided. `make_mesh_surface`
/// (triangle_surface.hpp) makes it.
struct MeshSurface {
  std::shared_ptr<const SurfaceTriangles> triangles;
};

using Shape = std::variant<Plane, Disk, Rectangle, Triangle, Sphere, Box, MeshSurface>;

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

}  // namespace trajet
