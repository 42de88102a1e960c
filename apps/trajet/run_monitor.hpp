#pragma once

#include <string>
#include <utility>

#include "progress_line.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet {

/// Follows a run for the program: shows progress, and ends the run on Ctrl-C, on the signals SIGTERM and SIGHUP, and
/// where memory runs out.
///
/// Progress tells how far a run is, how fast it goes, and how long it will still take at that speed.
class RunMonitor : public RunObserver {
 public:
  /// Lets signals end runs.
  RunMonitor();
  RunMonitor(const RunMonitor&) = delete;
  RunMonitor& operator=(const RunMonitor&) = delete;

  /// Removes the line of progress.
  void clear() { progress_.clear(); }
  /// What stands before the progress of the runs that follow: "rk4, step 0.1 s (2 of 6)".
  void set_label(std::string label) { label_ = std::move(label); }

  RunWishes wishes() const override { return {.motion = progress_.is_shown()}; }
  void begin(const World& world) override;
  void motion(const MotionPiece& piece) override;
  bool interrupted(double time) override;

 private:
  ProgressLine progress_;
  std::string label_;
  double start_ = 0.0;  // s, of the motion
  double end_ = 0.0;    // s
  long steps_ = 0;
};

/// From now on Ctrl-C, SIGTERM and SIGHUP end what is computed instead of the program; a second one ends the program. A
/// SIGHUP that `nohup` has switched off stays so.
void let_signals_end_runs();
/// Whether one has come since. May be asked by any thread.
bool is_end_wanted();
/// Takes that back: from now on the signals end the program, at once if one has ended a run.
void let_signals_end_program();

}  // namespace trajet
