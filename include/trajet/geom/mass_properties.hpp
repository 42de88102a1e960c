#pragma once

#include "trajet/geom/triangle_mesh.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// Volume integrals of a solid in its own frame; times a density (kg/m^3) they are its mass properties.
struct VolumeProperties {
  double volume;    ///< m^3
  Vector3 center;   ///< of mass, m
  Matrix3 inertia;  ///< about the centre, for density 1: m^5
};

/// Solids around the origin, their centre of mass; cylinder, capsule and cone along z. Lengths in m, > 0.
VolumeProperties sphere_properties(double radius);
/// `size`: full edge lengths.
VolumeProperties box_properties(const Vector3& size);
VolumeProperties cylinder_properties(double radius, double height);
/// `height`: of the cylindrical part; the half spheres at its ends come on top.
VolumeProperties capsule_properties(double radius, double height);
VolumeProperties cone_properties(double radius, double height);
VolumeProperties ellipsoid_properties(const Vector3& radii);

/// Of a closed surface, exactly, by the divergence theorem: the sum over the tetrahedra between the triangles and a
/// point [Tonon2004]. Throws std::domain_error if it encloses no volume.
VolumeProperties mesh_properties(const TriangleMesh& mesh);

}  // namespace trajet
