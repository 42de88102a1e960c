#pragma once

#include "trajet/scene/scene.hpp"
#include "value_reader.hpp"

namespace trajet::detail {

/// Reads the table [method].
MethodOptions read_method(const TableReader& table);

/// What the key `direction` of an event says: any, where there is none.
CrossingDirection read_direction(const TableReader& table);

}  // namespace trajet::detail
