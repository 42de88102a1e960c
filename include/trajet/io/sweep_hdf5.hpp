#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "trajet/io/sweep_results.hpp"

namespace trajet {

/// Where a table comes from, as the file tells it: names and texts, `scene` and `plan`.
using SweepOrigin = std::vector<std::pair<std::string, std::string>>;

/// Whether a name is that of an HDF5 file.
bool is_hdf5_name(const std::string& path);

/// Throws FileError where this build or this machine cannot write HDF5.
void require_hdf5();

/// Writes the rows of a sweep as HDF5, in chunks and compressed: docs/formats/sweep.md. An earlier file of that name is
/// replaced when all is written.
void write_sweep_hdf5(const std::string& path, const SweepResults& results, const SweepOrigin& origin);

}  // namespace trajet
