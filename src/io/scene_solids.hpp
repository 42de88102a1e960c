#pragma once

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

/// Reads the `parts` of a compound; with masses or densities those of a body.
std::vector<PartDefinition> read_parts(const TableReader& table, bool have_masses);

/// Reads a table `[[body]]`.
BodyDefinition read_body(const TableReader& table);

/// Reads a table `[[obstacle]]`.
ObstacleDefinition read_obstacle(const TableReader& table);

}  // namespace trajet::detail
