#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trajet/ensemble/dispersion.hpp"
#include "trajet/ensemble/share_interval.hpp"

namespace trajet {

/// The columns of a sweep's table: docs/formats/sweep.md.
struct SweepHeader {
  std::vector<std::string> quantities{};  ///< varied
  std::vector<std::string> columns{};     ///< reported, as typed
  bool operator==(const SweepHeader&) const = default;
};

/// What is known of the motions of a block, or of all, beside their rows.
struct SweepTally {
  std::uint64_t count = 0;
  std::uint64_t failed = 0;
  std::uint64_t condition = 0;                               ///< in how many the condition of `--until` holds
  std::map<std::string, std::uint64_t, std::less<>> hits{};  ///< of each thing: in how many it was hit first

  void add(const SweepTally& other) {
    count += other.count;
    failed += other.failed;
    condition += other.condition;
    for (const auto& [name, number] : other.hits) hits[name] += number;
  }
};

/// What a sweep comes to.
struct SweepSummary {
  static constexpr std::array<double, 7> kShares{0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99};

  struct Column {
    std::string name;
    RunningStatistics numbers{};      ///< of the rows that have one
    std::vector<double> quantiles{};  ///< of kShares
  };
  struct Hit {
    std::string name;  ///< of what was hit first
    std::uint64_t count = 0;
    double share = 0.0;
    ShareInterval ci95{};
    std::optional<Dispersion> dispersion{};  ///< of the first impacts' points, where they are reported
    /// Likewise, about the center of a target at rest.
    std::optional<std::array<Dispersion::Circle, 3>> about_aim{};
  };

  SweepTally tally{};
  std::vector<Column> columns{};  ///< of numbers
  std::vector<Hit> hits{};
};

/// Calls its argument with the numbers of each row of a sweep, in their order: of the quantities, then of the columns,
/// not-a-number where it has none; a word is a number that tells words apart.
using SweepRowSource = std::function<void(const std::function<void(std::span<const double>)>&)>;

}  // namespace trajet
