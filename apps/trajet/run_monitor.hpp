#pragma once

#include <chrono>

#include "trajet/io/csv_writer.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// Follows a run for the program: passes samples on, shows progress, and ends the run on Ctrl-C.
///
/// Progress goes to standard error, only if it is a terminal, and only once a run has taken half a second.
class RunMonitor : public RunObserver {
 public:
  /// From now on Ctrl-C ends the run instead of the program; a second one ends the program. `csv` may be null.
  explicit RunMonitor(CsvWriter* csv);
  /// Removes the line of progress.
  ~RunMonitor() override;
  RunMonitor(const RunMonitor&) = delete;
  RunMonitor& operator=(const RunMonitor&) = delete;

  void sample(const Sample& sample) override;
  bool interrupted(double time) override;

 private:
  using Clock = std::chrono::steady_clock;

  CsvWriter* csv_;
  bool shows_progress_;
  bool has_shown_ = false;
  Clock::time_point next_show_;
};

}  // namespace trajet
