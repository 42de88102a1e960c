#pragma once

#include <optional>
#include <string>
#include <vector>

#include "first_records.hpp"
#include "trajet/io/run_spool.hpp"

namespace trajet {

/// What the outputs of a run need to be kept of it: no more than that, and in files where it may be long. A figure
/// reads all of it many times, and has it in memory.
class RunKeeper {
 public:
  /// `beside`: one of the files that will be written of the impacts, events or the motion, empty if there are none. The
  /// world outlives the keeper.
  RunKeeper(const World& world, const std::string& beside, bool keeps_motion, bool has_figure);

  /// Those that are told of the run.
  std::vector<RunObserver*> observers();

  const FirstRecords& first_records() const { return first_records_; }
  /// All impacts and events; `result` outlives them.
  const RunRecords& records(const RunResult& result);
  const RecordedMotion& motion() const;
  /// For a figure.
  const MotionRecord& motion_in_memory() const { return *motion_; }

 private:
  FirstRecords first_records_;
  std::optional<RecordSpool> record_spool_;
  std::optional<MotionSpool> motion_spool_;
  std::optional<MotionRecord> motion_;
  std::optional<ResultRecords> result_records_;
};

}  // namespace trajet
