#pragma once

#include "trajet/geom/triangle_mesh.hpp"
#include "value_reader.hpp"

namespace trajet::detail {

/// The triangles of the file that the key `file` of a table names, relative to the folder of the scene. The file's
/// numbers are meters. Throws FileError if it cannot be read, InputError if this program was built without a mesh
/// reader.
TriangleMesh read_mesh(const TableReader& table);

}  // namespace trajet::detail
