#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trajet/ensemble/quantiles.hpp"
#include "trajet/ensemble/sweep.hpp"
#include "trajet/ensemble/sweep_summary.hpp"
#include "trajet/io/spool.hpp"

namespace trajet {

/// Collects the rows of a sweep, in their order, in little memory: what does not fit lies in a file without a name.
class SweepResults {
 public:
  /// That file is made in the folder of `beside`. `aims`: the centers of targets at rest, m.
  SweepResults(SweepHeader header, const std::string& beside, std::map<std::string, Vector3> aims);

  void add(const SweepRow& row);
  /// `tally`: what is known of the motions beside their rows.
  SweepSummary summary(const SweepTally& tally) const;

  const SweepHeader& header() const { return header_; }
  std::uint64_t row_count() const { return row_count_; }
  /// Whether the column holds words; their numbers are places in `words`.
  bool is_word(std::size_t column) const { return has_words_[column]; }
  std::vector<std::string> words() const;
  /// Calls `use` with the numbers of each row: see SweepRowSource. Behind them stands the row's index.
  void each_row(const std::function<void(std::span<const double>)>& use) const;

 private:
  /// The numbers of one stream, without the rows that have none.
  NumberSource numbers(std::size_t stream) const;
  std::optional<std::array<std::size_t, 4>> impact_columns() const;
  double word_number(const std::string& word);

  SweepHeader header_;
  std::map<std::string, Vector3> aims_;
  std::vector<RunningStatistics> statistics_;  // of the columns
  std::vector<bool> has_words_;                // likewise
  std::map<std::string, double> words_;
  std::uint64_t row_count_ = 0;
  Spool spool_;
};

/// docs/formats/sweep.md.
struct SweepTitle {
  std::string scene, title, design;
  std::uint64_t seed = 0;
};
std::string sweep_summary_json(const SweepTitle& title, const SweepSummary& summary);

}  // namespace trajet
