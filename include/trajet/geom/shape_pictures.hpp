#pragma once

#include <span>
#include <vector>

#include "trajet/geom/aabb.hpp"
#include "trajet/geom/shapes.hpp"
#include "trajet/geom/triangle_mesh.hpp"

namespace trajet {

/// Curved surfaces in flat pieces, for pictures. What is round along an axis has 32 sides, within the solid.

/// The line around a profile of a solid of revolution that has grown, from the axis to the axis; arcs at its corners.
std::vector<Eigen::Vector2d> profile_outline(const std::vector<Eigen::Vector2d>& profile, double growth);

/// The surface that a line in the half plane (rho, z), from the axis to the axis, sweeps about z; outward to its right.
TriangleMesh revolve(const std::vector<Eigen::Vector2d>& line);

/// An ellipsoid around the origin.
TriangleMesh ellipsoid_picture(const Vector3& radii);

/// The hull of points, grown.
TriangleMesh grown_hull_picture(std::span<const Vector3> corners, double growth);

/// In the frame of the shape.
TriangleMesh local_picture(const SolidOfRevolution& solid);
TriangleMesh local_picture(const EllipsoidBody& ellipsoid);

/// In the world; what has grown, with its round edges.
TriangleMesh picture_of(const MeshSurface& surface);

/// The ground over a rectangle of the landscape's frame, around the places (in the world) that a box holds, and half
/// its size more; in the world. What has no height is left out.
TriangleMesh picture(const Terrain& terrain, const Aabb& box);

/// A surface of a frame B that stands in the world like this.
TriangleMesh placed(TriangleMesh mesh, const Vector3& p_WB, const Matrix3& R_WB);

}  // namespace trajet
