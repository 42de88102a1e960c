#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sweep_arguments.hpp"
#include "trajet/ensemble/sweep.hpp"

namespace trajet {

/// When a sweep has seen enough: the half width of the interval that holds the share of motions with that condition,
/// whenever one looks (`anytime_share_interval`), is below a number.
struct UntilCondition {
  std::string condition{};
  double half_width = 0.0;
};

/// What a command line asks of a sweep, checked.
struct SweepSetup {
  Sweep sweep;
  std::size_t column_count =
      0;  ///< of those that are written; the condition of `until` follows, where it is none of them
  std::optional<UntilCondition> until{};
  std::size_t until_column = 0;
  std::uint64_t first = 0, last = 0;  ///< of the motions to compute: all, or those of the shard
  std::string fingerprint{};          ///< one line that tells sweeps with other results apart
};

/// Throws InputError at what is wrong in the scene or the options.
SweepSetup make_sweep(const SweepArguments& arguments);

}  // namespace trajet
