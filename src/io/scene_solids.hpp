#pragma once

#include <memory>

#include "trajet/scene/scene.hpp"
#include "value_reader.hpp"

namespace trajet::detail {

/// Reads an orientation: an axis and an angle, a quaternion, a matrix, or roll, pitch and yaw.
OrientationDefinition read_orientation(const TableReader& table);

/// Reads the `color` of a body or an obstacle, if it has one.
std::optional<RgbColor> read_color(const TableReader& table);

/// The shape `mesh`, of bodies and obstacles.
MeshShape read_mesh_shape(const TableReader& table);

/// Shapes that bodies and obstacles describe by the same keys.
ShapeDefinition read_cylinder(const TableReader& table);
ShapeDefinition read_capsule(const TableReader& table);
ShapeDefinition read_cone(const TableReader& table);
ShapeDefinition read_ellipsoid(const TableReader& table);
ShapeDefinition read_hull(const TableReader& table);
/// A disk across the z axis of its frame, of bodies and of parts of compounds.
ShapeDefinition read_disk_across_z(const TableReader& table);

/// Reads the `parts` of a compound; with masses or densities those of a body.
std::vector<PartDefinition> read_parts(const TableReader& table, bool have_masses);

/// What the key `on_hit` says: stop, where there is none.
OnHit read_on_hit(const TableReader& table);

/// What the keys of a surface's friction say; none, where there is none.
std::shared_ptr<const FrictionDefinition> read_friction(const TableReader& table);

/// What the key `collides_with` of a body says: a word, or an array of names.
CollidesWith read_collides_with(const TableReader& table);

/// What the key `inertia` of a body says: three moments, or a matrix, in place of what it had.
void read_inertia(const TableReader& table, BodyDefinition& body);

/// Reads a table `[[pair]]`.
PairDefinition read_pair(const TableReader& table);

/// Reads a table `[[body]]`.
BodyDefinition read_body(const TableReader& table);

/// Reads a table `[[obstacle]]`.
ObstacleDefinition read_obstacle(const TableReader& table);

}  // namespace trajet::detail
