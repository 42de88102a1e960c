#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "trajet/event/composed_function.hpp"
#include "trajet/event/crossing.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/law/program.hpp"
#include "trajet/math/series.hpp"
#include "trajet/ode/segment.hpp"

namespace trajet {

/// Looks out for the times at which a program of t and the state crosses zero along a motion.
///
/// A crossing at the joint of two Segments counts once: the watch remembers the sign it has seen last. A jump of the
/// program across zero is a crossing. A start on zero, a touch, and a jump of the state across zero are none. A motion
/// that comes to zero where an impact or another event changes its state has crossed.
class EventWatch {
 public:
  struct Crossing {
    bool found = false;
    double time = 0.0;
    double error_bound = 0.0;  ///< s
    int direction = 0;         ///< +1 rising, -1 falling
    bool undecided = false;    ///< neither shown nor excluded from `time` on
  };

  EventWatch(Program when, CrossingDirection direction);

  /// The motion goes on at time `t` from state `q`; it came there in state `before`. A crossing at this time, within
  /// its error bound, that was not taken yet stays the next one.
  void restart(double t, const double* before, const double* q);
  /// Finds the first crossing on the Segment behind `from`, which lies on it; remembered until the watch moves on.
  void search(const Segment<>& segment, double from);
  const Crossing& next() const { return next_; }
  /// The crossing found has been dealt with.
  void take() { last_ = std::exchange(next_, {}); }

 private:
  bool wanted(int direction) const;

  /// The program on enclosures of the inputs it reads.
  struct Function {
    Evaluator<IntervalJet>* evaluator;
    const std::vector<int>* inputs;  // components of the state
    std::vector<IntervalJet>* state;
    template <class Components>
    IntervalJet operator()(const IntervalJet& t, const Components& x) const {
      for (std::size_t i = 0; i < inputs->size(); ++i)
        (*state)[static_cast<std::size_t>((*inputs)[i])] = x[static_cast<Eigen::Index>(i)];
      IntervalJet result;
      (*evaluator)(t, state->data(), &result);
      return result;
    }
  };

  std::shared_ptr<const Program> program_;  // the evaluators keep pointers to it
  CrossingDirection direction_;
  std::vector<int> inputs_;
  std::vector<IntervalJet> state_;
  Evaluator<double> values_;
  Evaluator<IntervalJet> enclosures_;
  int sign_ = 0;          // seen last, 0 unknown
  double at_zero_ = 0.0;  // values as small still belong to the crossing on which the motion was restarted
  Crossing last_;         // that was taken
  Crossing next_;
};

}  // namespace trajet
