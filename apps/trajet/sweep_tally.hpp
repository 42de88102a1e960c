#pragma once

#include "sweep_setup.hpp"
#include "trajet/ensemble/sweep_summary.hpp"

namespace trajet {

/// What is known of the motions of a block beside their rows.
inline SweepTally tally_of(const SweepBlock& block, const SweepSetup& setup) {
  SweepTally tally{.count = block.rows.size()};
  for (const SweepRow& row : block.rows) {
    if (row.status == RunStatus::failed) ++tally.failed;
    if (!row.hit.empty()) ++tally.hits[row.hit];
    if (!setup.until) continue;
    const auto* holds = std::get_if<double>(&row.cells[setup.until_column]);
    if (holds != nullptr && *holds != 0.0) ++tally.condition;
  }
  return tally;
}

}  // namespace trajet
