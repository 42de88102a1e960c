#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "trajet/ensemble/report_columns.hpp"
#include "trajet/ensemble/sweep_plan.hpp"
#include "trajet/scene/scene.hpp"

namespace trajet {

/// One motion of a sweep.
struct SweepRow {
  std::uint64_t index = 0;
  std::vector<double> values{};  ///< of the varied quantities, SI  // (quantity_count)
  std::vector<Cell> cells{};     ///< of the columns
  RunStatus status = RunStatus::finished;
  std::string failure{};  ///< why there are no numbers, where the motion failed
  std::string hit{};      ///< name of what was hit first, empty if nothing was
};

/// Rows that follow each other.
struct SweepBlock {
  std::uint64_t first = 0;
  std::vector<SweepRow> rows{};
};

/// Many motions of one scene: each row of a plan with its own values, and what columns report of it.
class Sweep {
 public:
  /// `columns` may use what ReportColumns knows; errors in them point at `columns_where`. Throws InputError where
  /// scene, plan or columns are wrong.
  Sweep(Scene scene, SweepPlan plan, std::vector<std::string> columns, const SourceLocation& columns_where = {});

  const SweepPlan& plan() const { return plan_; }
  const Scene& scene() const { return scene_; }
  const ReportColumns& columns() const { return columns_; }

  /// The scene of one motion, to be run with everything that a run can report.
  Scene variant(std::uint64_t index) const;

  /// Computes motions one by one, in any order; each thread has one of its own. The sweep outlives it.
  class Worker {
   public:
    explicit Worker(const Sweep& sweep);
    ~Worker();
    /// Where a value makes the scene wrong (a negative radius), or the numbers fail, the row says so. `should_stop` is
    /// asked between steps; a motion that it ends is `interrupted`.
    SweepRow operator()(std::uint64_t index, const std::function<bool()>& should_stop);

   private:
    class State;
    std::unique_ptr<State> state_;
  };

 private:
  void require_a_motion() const;

  Scene scene_;
  SweepPlan plan_;
  ReportColumns columns_;
};

/// How a range of motions is computed.
struct SweepRange {
  std::uint64_t first = 0;
  std::uint64_t last = std::numeric_limits<std::uint64_t>::max();  ///< behind the last one, or behind all
  std::uint64_t block = 64;
  int threads = 0;  ///< 0: as many as the machine has
};

/// Computes motions of a sweep block by block, and hands the blocks on in their order: what is handed on does not
/// depend on the number of threads.
///
/// `take` is called by one thread at a time; false ends the sweep. `should_stop` may be called by several; once it is
/// true, blocks that are not complete are dropped.
void run_sweep(
    const Sweep& sweep, const SweepRange& range, const std::function<bool(SweepBlock&&)>& take,
    const std::function<bool()>& should_stop = [] { return false; });

}  // namespace trajet
