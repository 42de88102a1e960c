#pragma once

#include <memory>
#include <vector>

#include "trajet/event/composed_function.hpp"
#include "trajet/law/evaluate.hpp"
#include "trajet/law/program.hpp"
#include "trajet/math/series.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/sim/scene.hpp"

namespace trajet {

/// Looks out for the times at which a program of t and the state crosses zero along a motion.
///
/// A crossing at the joint of two Segments counts once: the watch remembers the sign it has seen last. A start on zero, a
/// touch, and a jump of the state across zero are no crossings.
class EventWatch {
 public:
  struct Crossing {
    bool found = false;
    double time = 0.0;
    int direction = 0;        ///< +1 rising, -1 falling
    bool undecided = false;   ///< neither shown nor excluded from `time` on
  };

  EventWatch(Program when, CrossingDirection direction);

  /// Forgets what it has seen: the state is `q` at time `t` now.
  void restart(double t, const double* q);
  /// The first crossing on the Segment behind `from`, which lies on it; remembered until the watch moves on.
  void search(const Segment<>& segment, double from);
  const Crossing& next() const { return next_; }

 private:
  bool wanted(int direction) const;

  /// The program on enclosures of the inputs it reads.
  struct Function {
    Evaluator<IntervalJet>* evaluator;
    const std::vector<int>* inputs;        // components of the state
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
  int sign_ = 0;  // seen last, 0 unknown
  Crossing next_;
};

}  // namespace trajet
