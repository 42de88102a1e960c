#pragma once

#include <chrono>
#include <string>

namespace trajet {

/// A line on standard error that tells how far something is, only if that is a terminal, and only once it has taken
/// half a second.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Whether anybody would see it.
  bool is_shown() const { return is_shown_; }
  /// Something begins.
  void begin();
  /// s since then.
  double seconds() const;
  /// Whether it is time to show how far it is.
  bool is_due() const { return is_shown_ && Clock::now() >= next_show_; }
  /// Shows a line, with how long it will still take where the share `done` of it is.
  void show(std::string line, double done);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool is_shown_;
  bool has_shown_ = false;
  Clock::time_point began_;
  Clock::time_point next_show_;
};

/// "45 s", "12 min", "3.4 h": as exact as a guess deserves.
std::string format_duration(double seconds);

}  // namespace trajet
