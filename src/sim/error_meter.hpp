#pragma once

#include <vector>

#include "trajet/sim/compare.hpp"
#include "trajet/sim/reference.hpp"
#include "trajet/sim/world.hpp"

namespace trajet {

/// Measures a run against a reference while it goes on, and passes it on to an onlooker.
class ErrorMeter : public RunObserver {
 public:
  /// `onlooker` may be null. Both outlive the meter.
  ErrorMeter(const Reference& reference, RunObserver* onlooker) : reference_(reference), onlooker_(onlooker) {}

  void begin(const World& world) override;
  void motion(const MotionPiece& piece) override;
  bool interrupted(double time) override { return onlooker_ != nullptr && onlooker_->interrupted(time); }

  Deviation at_end() const;
  Deviation at_samples() const { return at_samples_; }
  Deviation at_nodes() const { return at_nodes_; }
  /// Until when all groups were compared, s.
  double compared_until() const;

 private:
  /// What is known of a group of the World.
  struct Group {
    std::vector<bool> is_position;  // of each component of its state
    bool open = true;               // the reference still holds
    long next_sample = 1;
    double until = 0.0;  // s
    Deviation at_end;
  };

  /// At a time on the piece.
  Deviation deviation(const MotionPiece& piece, double t);
  /// Of `state_` from `reference_state_`.
  Deviation deviation(const Group& group) const;
  void read_reference(int group, double t);

  const Reference& reference_;
  RunObserver* onlooker_;
  const World* world_ = nullptr;  // while the run lasts
  double start_ = 0.0;            // s
  double sample_ = 0.0;  // s, signed
  std::vector<Group> groups_;
  Deviation at_samples_;
  Deviation at_nodes_;
  Eigen::VectorXd state_;  // scratch
  Eigen::VectorXd reference_state_;
};

}  // namespace trajet
