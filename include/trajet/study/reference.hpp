#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "trajet/law/evaluate.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet {

/// A closed form has no value where it is needed.
class ReferenceError : public InputError {
  using InputError::InputError;
};

/// A motion that others are compared with: the state of each group of a World as a function of time.
class Reference {
 public:
  virtual ~Reference() = default;

  /// How far it goes, s since the start; nothing if it has no end.
  virtual std::optional<double> end_time() const = 0;
  /// Whether it holds only as long as the law alone makes the motion: no bounce, no rest, no event that sets a state.
  virtual bool ends_at_jumps() const = 0;
  /// The state of a group at a time from the start to the end, into `q`; not-a-number in the components that it does
  /// not know.
  virtual void state(int group, double t, Eigen::VectorXd& q) = 0;
};

/// The scene's `[exact]` block.
class ClosedFormReference : public Reference {
 public:
  explicit ClosedFormReference(const World& world);
  ClosedFormReference(const ClosedFormReference&) = delete;  // its evaluators point to its closed forms
  ClosedFormReference& operator=(const ClosedFormReference&) = delete;

  std::optional<double> end_time() const override { return std::nullopt; }
  bool ends_at_jumps() const override { return true; }
  /// Throws ReferenceError that points at the formula if its value is not finite.
  void state(int group, double t, Eigen::VectorXd& q) override;

 private:
  /// Of one body.
  struct Rotation {
    int group;
    World::Rotation place;
    std::string body;
    World::ClosedRotation closed_form;
    std::optional<Evaluator<double>> orientation{}, angular_velocity{};

    void write(double t, double epoch, Eigen::VectorXd& q);
  };

  double epoch_;  // s, of the clock in messages
  std::vector<World::ClosedForm> closed_forms_;
  std::vector<Eigen::Index> sizes_;            // of the groups' states
  std::vector<Evaluator<double>> evaluators_;  // one for each closed form
  std::vector<Rotation> rotations_;
};

/// A run, kept as it goes on: it is given to `run` as its observer.
class RecordedReference : public Reference, public RunObserver {
 public:
  RunWishes wishes() const override { return {.motion = true}; }
  void begin(const World& world) override;
  void motion(const MotionPiece& piece) override;

  std::optional<double> end_time() const override { return end_; }
  bool ends_at_jumps() const override { return false; }
  /// At a jump: the state behind it.
  void state(int group, double t, Eigen::VectorXd& q) override;

 private:
  struct Piece {
    double to;  // s
    Segment<> segment;
  };

  double direction_ = 1.0;
  double end_ = 0.0;  // s; how far the run has come
  std::vector<Eigen::VectorXd> starts_;
  std::vector<std::vector<Piece>> pieces_;  // of each group
};

}  // namespace trajet
