#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "switched_system.hpp"
#include "trajet/event/law_branches.hpp"
#include "trajet/ode/registry.hpp"
#include "trajet/scene/program_system.hpp"

namespace trajet {

/// A method at work on a law with choices by the state: each step is made on the branches on which it begins, and ends
/// where the first of them does. So no stage of a step looks over a border, and a branch that is shorter than a step is
/// met all the same. Where the branches on both sides of a border lead to it, the steps go along it.
///
/// Where a branch cannot be followed, because the law is not finite beyond its border or because it cannot be decided,
/// the step is one of the whole law.
class BranchedStepper final : public AnyStepper {
 public:
  /// `whole` must outlive it.
  BranchedStepper(const MethodInfo& method, const StepOptions& options, ProgramSystem& whole,
                  std::unique_ptr<LawBranches> branches);

  void start(double t, const State& q) override;
  void start_extended(double t, const ExtendedState& q) override;
  StepStatus advance(double t_limit) override;
  void fill_segment(Segment<>& segment) override { segment = segment_; }
  double time() const override { return time_; }
  const State& state() const override { return state_; }
  const StepStatistics& statistics() const override { return stepper_->statistics(); }
  bool amend(const State& q) override;
  /// What the method remembers beside the state is void: the law has a corner here. Its branches stay.
  void forget();
  bool is_extended() const override { return stepper_->is_extended(); }
  std::optional<ExtendedState> extended_state(Extended tau) const override { return stepper_->extended_state(tau); }
  std::vector<std::string> warnings() const override { return stepper_->warnings(); }

  /// The motion has begun to slide along a border, or has left it.
  struct Slide {
    double time = 0.0;    ///< s
    int component = -1;   ///< of the state, whose rate chooses by the border
    bool begins = false;  ///< else it ends
    int direction = 0;    ///< +1: the border's function has come rising, or goes on so
  };
  /// Those of the last step, or nothing if they were taken.
  std::vector<Slide> take_slides() { return std::exchange(slides_, {}); }
  bool is_sliding() const { return !branches_->sliding().empty(); }
  /// The law on the last step.
  void rate(double t, const double* q, double* dq) { system_.rate(t, q, dq); }
  /// Where the last step has begun by passing a border: the derivative of the state behind by the state before it, of
  /// which the time of passing is part; nothing where it was taken or the step has begun otherwise.  // (state x state)
  std::optional<Eigen::MatrixXd> take_switch() { return std::exchange(switch_, std::nullopt); }
  /// The law of the last step.
  System& law() { return system_; }
  /// The component of the state whose rate chooses in a way that was not decided; -1 where that did not end the motion.
  int undecided_component() const { return undecided_component_; }

 private:
  /// The stepper goes on from the state, on the branches that are found there, or on none.
  void begin(double direction, bool may_pin);
  /// The state goes where the branches have found that it has to begin.
  void displace();
  /// Whether a vector whose direction the law reads has come to zero; else the step is not to come to its end at once.
  bool approach(double& t_limit, double direction);
  void record_slides(const std::vector<SlidingBorder>& before);
  /// The motion stands at the end of a branch, by the law before.
  void arrive(const LawBranches::End& end);
  /// A step has begun where the last one has come to a border.
  void find_switch();
  /// The motion is back where the last step began: it was none.
  void undo_step();
  /// A step towards `t_limit`, and the end of a branch on it. One of a set length is made shorter where its law is lost
  /// so far beyond its border.
  StepStatus step(double t_limit);
  /// Where the step has passed the end of a branch, it is made again, up to it: the ends of steps are more exact than
  /// what lies between them, and steps of a set length are as exact as they are short.
  void retake_to_end();
  /// The step ends at the end of a branch.
  void cut(const LawBranches::End& end);

  int most_retakes_;
  bool is_fixed_;
  std::unique_ptr<LawBranches> branches_;
  SwitchedSystem system_;
  std::unique_ptr<AnyStepper> stepper_;
  Segment<> segment_;
  double time_ = 0.0;  // s, where the last step has ended
  State state_;
  std::optional<ExtendedState> extended_;   // where the stepper is to begin, if it is known so
  std::optional<LawBranches::End> end_;     // of a branch, on the last step
  std::optional<LawBranches::End> passed_;  // where the stepper is to begin
  bool begins_ = true;                      // the stepper does not stand there yet
  std::vector<Slide> slides_;
  /// How a step has come to a border.
  struct Arrival {
    double time;  // s
    State state, rate;
    Eigen::RowVectorXd gradient;  // of the border, by state and time
  };
  std::optional<Arrival> arrival_;  // of the last step
  std::optional<Eigen::MatrixXd> switch_;
  int undecided_ = 0;  // so often was it not decided which branch holds
  int undecided_component_ = -1;
};

}  // namespace trajet
