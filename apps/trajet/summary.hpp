#pragma once

#include <string>

#include "first_records.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// What a person wants to know of a run: how it ended, what was hit, when, where, how fast, and what it cost. Tables
/// fit into `width` columns.
std::string summary(const RunResult& result, const FirstRecords& records, bool color, int width);

}  // namespace trajet
