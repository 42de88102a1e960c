#pragma once

#include <chrono>
#include <string>
#include <utility>

#include "trajet/sim/run_observer.hpp"

namespace trajet {

/// Follows a run for the program: shows progress, and ends the run on Ctrl-C, on the signals SIGTERM and SIGHUP, and
/// where memory runs out.
///
/// Progress goes to standard error, only if it is a terminal, and only once a run has taken half a second: how far it
/// is, how fast it goes, and how long it will still take at that speed.
class RunMonitor : public RunObserver {
 public:
  /// From now on Ctrl-C, SIGTERM and SIGHUP end the run instead of the program; a second one ends the program. A SIGHUP
  /// that `nohup` has switched off stays so.
  RunMonitor();
  ~RunMonitor() override;
  RunMonitor(const RunMonitor&) = delete;
  RunMonitor& operator=(const RunMonitor&) = delete;

  /// Removes the line of progress.
  void clear();
  /// What stands before the progress of the runs that follow: "rk4, step 0.1 s (2 of 6)".
  void set_label(std::string label) { label_ = std::move(label); }

  RunWishes wishes() const override { return {.motion = shows_progress_}; }
  void begin(const World& world) override;
  void motion(const MotionPiece& piece) override;
  bool interrupted(double time) override;

 private:
  using Clock = std::chrono::steady_clock;

  void show(double time, Clock::time_point now);

  bool shows_progress_;
  bool has_shown_ = false;
  std::string label_;
  double start_ = 0.0;  // s, of the motion
  double end_ = 0.0;    // s
  long steps_ = 0;
  Clock::time_point began_;
  Clock::time_point next_show_;
};

/// Takes back what a RunMonitor has done: from now on the signals end the program, at once if one has ended a run.
void let_signals_end_program();

}  // namespace trajet
