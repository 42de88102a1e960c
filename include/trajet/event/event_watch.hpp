#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "trajet/event/composed_function.hpp"
#include "trajet/event/crossing.hpp"
#include "trajet/event/program_function.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/law/program.hpp"
#include "trajet/math/series.hpp"
#include "trajet/ode/segment.hpp"

namespace trajet {

/// Looks out for the times at which a program of t and the state crosses zero along a motion.
///
/// A crossing at the joint of two Segments counts once: the watch remembers the sign it has seen last. A jump across
/// zero is a crossing, whether the program jumps or the state. A start on zero and a touch are none. A motion that
/// comes to zero where an impact or another event changes its state has crossed, unless that carries it back. A jump of
/// the state onto zero has crossed where the motion goes on to the other side or stays on zero.
class EventWatch {
 public:
  struct Crossing {
    bool found = false;
    double time = 0.0;
    double error_bound = 0.0;  ///< s
    int direction = 0;         ///< +1 rising, -1 falling
    bool undecided = false;    ///< neither shown nor excluded from `time` on
    bool is_jump = false;      ///< the state has jumped to the other side
  };

  EventWatch(Program when, CrossingDirection direction);

  /// The motion goes on at time `t` from state `q`; it came there in state `before`. `rounding`: how far each component
  /// of the two may be off, in its unit; a value that this may turn to the other side counts as zero. A crossing at
  /// this time, within its error bound, that was not taken yet stays the next one, and a jump across zero becomes it;
  /// but what was taken last jumps by what it has done itself.
  void restart(double t, const double* before, const double* q, const double* rounding);
  /// Behind the restart by what was taken last: how fast the state changed before and changes now. Where that turns the
  /// program back or stops it, it is on the side that it came from, for however short a time, and may cross again.
  void turn(double t, const double* before, const double* rate_before, const double* q, const double* rate);
  /// Behind a restart: a rising crossing that was to come at this time is none if the program does not rise. The state
  /// changed by `rate_before` and changes by `rate` now.
  void forget_unless_rising(double t, const double* q, const double* rate_before, const double* rate);
  /// Behind a restart: the motion was held on zero, and goes on as if it came from that side, -1 or 1.
  void stand_on(double t, const double* q, int side);
  /// Whether the last restart was such a turn.
  bool has_turned() const { return has_turned_; }
  /// Finds the first crossing on the Segment behind `from`, which lies on it; remembered until the watch moves on. What
  /// comes behind `until` is not looked for.
  void search(const Segment<>& segment, double from, double until);
  void search(const Segment<>& segment, double from) { search(segment, from, segment.t1()); }
  const Crossing& next() const { return next_; }
  /// The crossing found has been dealt with: it changed nothing.
  void pass() { last_ = std::exchange(next_, {}); }
  /// The crossing found is being dealt with: the motion will be restarted.
  void take() {
    pass();
    is_taken_ = true;
  }

 private:
  bool wanted(int direction) const;
  /// What the program may be at a time and in a state that is off by `rounding` at most.
  Interval enclose(double t, const double* q, const double* rounding);

  /// How fast the program changes, per s.
  double rate_at(double t, const double* q, const double* rate);

  std::shared_ptr<const Program> program_;  // the evaluators keep pointers to it
  CrossingDirection direction_;
  std::vector<int> inputs_;
  std::vector<IntervalJet> state_;
  Evaluator<double> values_;
  Evaluator<IntervalJet> enclosures_;
  int sign_ = 0;             // seen last, 0 unknown
  double at_zero_ = 0.0;     // values as small still belong to the zero on which the motion was restarted
  bool has_landed_ = false;  // by a jump, from the side of sign_
  bool has_turned_ = false;
  bool has_to_leave_ = false;  // it was turned back, and was not searched since
  bool is_taken_ = false;      // the next restart is by the crossing taken last
  Crossing last_;              // that was taken
  Crossing next_;
};

}  // namespace trajet
