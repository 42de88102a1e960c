#pragma once

#include "trajet/sim/scene.hpp"
#include "value_reader.hpp"

namespace trajet::detail {

/// Reads a table `[[body]]`.
OrientationDefinition read_orientation(const TableReader& table);
BodyDefinition read_body(const TableReader& table);

/// Reads a table `[[obstacle]]`.
ObstacleDefinition read_obstacle(const TableReader& table);

}  // namespace trajet::detail
