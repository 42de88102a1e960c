#pragma once

#include <span>
#include <vector>

#include "trajet/geom/solid.hpp"

namespace trajet {

/// What grows into a rounded solid: the corners of a polytope, or of the profile of a solid of revolution about z (as
/// in SolidOfRevolution). In the frame of the rounded solid's centre of mass.
struct RoundedCore {
  std::vector<Vector3> corners{};
  std::vector<Eigen::Vector2d> profile{};
  double rounding = 0.0;  ///< m
  VolumeProperties properties{};
};

/// Solids with edges and corners rounded inside them, moved to their centre of mass. `rounding` > 0, m. Throw
/// std::domain_error if it leaves nothing of the solid.
RoundedSolid make_rounded_hull(std::span<const Vector3> corners, double rounding);
RoundedSolid make_rounded_cylinder(double radius, double height, double rounding);
RoundedSolid make_rounded_cone(double radius, double height, double rounding);

/// The profile that grows by `rounding` into that of a cylinder or cone (z of the cone as in Cone).
std::vector<Eigen::Vector2d> cylinder_core_profile(double radius, double height, double rounding);
std::vector<Eigen::Vector2d> cone_core_profile(double radius, double height, double rounding);

/// Volume, centre and inertia of a grown polytope and a grown profile, to rounding: quadratures that are exact for what
/// is flat, and of smooth functions over arcs and spherical triangles.
VolumeProperties grown_hull_properties(const TriangleMesh& core, double growth);
VolumeProperties grown_profile_properties(const std::vector<Eigen::Vector2d>& profile, double growth);

/// The point of the solid that lies farthest in a direction of its frame.
Vector3 farthest_point(const RoundedCore& core, const Vector3& direction);
double bounding_radius(const RoundedCore& core);
/// Flat pieces, for pictures.
TriangleMesh picture_mesh(const RoundedCore& core);

}  // namespace trajet
