#pragma once

#include <string>

#include "trajet/io/output_file.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet {

/// Writes the samples of a run as CSV while it goes on: docs/formats/csv.md.
///
/// One row per sample and body; a scene without bodies has one row per sample, the columns of bodies empty. Numbers are
/// the shortest that read back as the same doubles.
class CsvWriter : public RunObserver {
 public:
  /// `file` outlives the writer. The header is written with the first sample, which knows the extra states.
  explicit CsvWriter(OutputFile& file) : file_(file) {}

  RunWishes wishes() const override { return {.samples = true}; }
  void sample(const Sample& sample) override;

 private:
  OutputFile& file_;
  std::string rows_;  // of one sample; kept for its memory
  bool has_header_ = false;
};

}  // namespace trajet
