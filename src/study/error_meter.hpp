#pragma once

#include <vector>

#include "rotation_meter.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/study/compare.hpp"
#include "trajet/study/reference.hpp"

namespace trajet {

/// Measures a run against a reference while it goes on.
class ErrorMeter : public RunObserver {
 public:
  /// `reference_world` says what the numbers of the reference's states mean: its orientations may be carried in another
  /// way. Both outlive the meter.
  ErrorMeter(Reference& reference, const World& reference_world)
      : reference_(reference), reference_world_(reference_world) {}

  RunWishes wishes() const override { return {.motion = true}; }
  void begin(const World& world) override;
  void motion(const MotionPiece& piece) override;

  Deviation at_end() const;
  Deviation at_samples() const { return at_samples_; }
  Deviation at_nodes() const { return at_nodes_; }
  RotationDeviation rotation_at_end() const;
  RotationDeviation rotation_at_samples() const { return rotation_at_samples_; }
  std::vector<RotationSample> rotation_history() const { return rotation_history_; }
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
    RotationDeviation rotation_at_end;
  };

  /// At a time on the piece.
  Deviation deviation(const MotionPiece& piece, double t);
  /// Of `state_` from `reference_state_`.
  Deviation deviation(const Group& group) const;
  void read_reference(int group, double t);
  /// Of the states that are at hand, those of the sample of that index.
  void note_rotation(int group, long sample, double t);

  Reference& reference_;
  const World& reference_world_;
  const World* world_ = nullptr;  // while the run lasts
  double sample_ = 0.0;           // s, signed
  std::vector<Group> groups_;
  Deviation at_samples_;
  Deviation at_nodes_;
  RotationMeter rotation_;
  RotationDeviation rotation_at_samples_;
  std::vector<RotationSample> rotation_history_;
  long history_stride_ = 1;  // samples for each entry of the history
  Eigen::VectorXd state_;    // scratch
  Eigen::VectorXd reference_state_;
};

}  // namespace trajet
