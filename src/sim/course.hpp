#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "branched_stepper.hpp"
#include "closed_rotations.hpp"
#include "course_watches.hpp"
#include "held_course_law.hpp"
#include "motion_scale.hpp"
#include "orientation_upkeep.hpp"
#include "state_error.hpp"
#include "tolerance_check.hpp"
#include "trajet/event/time_switches.hpp"
#include "trajet/ode/registry.hpp"
#include "trajet/portable.hpp"
#include "trajet/scene/program_system.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/run_observer.hpp"

namespace trajet {

class Instant;

/// One group of a World on its way: its stepper, the Segment it is on, and the crossings of zero it looks out for.
///
/// It advances by Segments. What changes at an instant — the state, the lasting contacts and with them the law — it
/// takes at once and as a whole by `restart`.
class Course {
 public:
  Course(const World& world, int group);

  const World& world() const { return world_; }
  const World::Group& group() const { return world_.groups[static_cast<std::size_t>(group_)]; }

  /// Makes the next Segment, from the end of the current one on.
  StepStatus advance();
  /// Whether the next Segment belongs to a step that was made already.
  bool is_within_step() const { return !rest_of_step_.empty(); }
  /// Goes on as the instant says; the current Segment ends there.
  void restart(const Instant& instant);
  /// The motion on the current Segment up to time t, as far as it was not handed on.
  std::optional<MotionPiece> hand_on(double t);

  /// The first crossing on the current Segment behind what was handled; its end if there is none.
  const Crossing& next() const { return next_; }
  const CourseWatches& watches() const { return watches_; }
  /// The event has happened and will change the state: it is not the next one any more.
  void take_event(int event) { watches_.take_event(event); }
  /// The event has changed the state, which the course has taken: its rate was this before.
  void turn_event(int event, const Instant& instant, const Eigen::VectorXd& rate_before);
  /// Goes on from an event that changed nothing.
  void pass_event(int event);

  const Segment<>& segment() const { return segment_; }
  /// The law, and what holds the motion.
  const HeldCourseLaw& held_law() const { return held_law_; }
  /// The state at a time on the current Segment.
  Eigen::VectorXd state(double t) const;
  /// Whether the state is carried in extended precision.
  bool is_extended() const { return stepper_->is_extended(); }
  /// The state `tau` (s) behind the start of the current Segment, which is a step of the method, in that precision;
  /// none where it is known in double precision only.
  std::optional<Eigen::VectorX<Extended>> extended_state(Extended tau) const;
  /// The law in a state: dq/dt, without and with the forces of lasting contacts.
  Eigen::VectorXd free_rate(double t, const Eigen::VectorXd& q) const;
  Eigen::VectorXd rate(double t, const Eigen::VectorXd& q) const;
  /// How far the state may be off at a time on the current Segment, in each component's unit: estimated.
  Eigen::VectorXd error_bound(double t) { return error_.bound(law(), segment_, t); }
  /// The same as a sum of errors, each a column times a number between -1 and 1.  // (state x any number)
  Eigen::MatrixXd error_columns(double t) { return error_.columns(law(), segment_, t); }
  /// The same along one direction of the state.
  double error_bound_along(const Eigen::VectorXd& direction, double t) {
    return error_.bound_along(direction, law(), segment_, t);
  }
  /// Where the motion has begun to slide along a border of its law, or has left one, since that was asked last.
  std::vector<BranchedStepper::Slide> take_slides() {
    return branched_ != nullptr ? branched_->take_slides() : std::vector<BranchedStepper::Slide>();
  }
  /// The component of the state whose rate could not be decided, where that has ended the motion; else -1.
  int undecided_component() const { return branched_ != nullptr ? branched_->undecided_component() : -1; }
  bool finished() const { return segment_.t1() == world_.duration; }
  StepStatistics statistics() const;
  /// What the method has to say of its work.
  std::vector<std::string> warnings() const;
  /// Where the tolerance that was asked for is coarser than the motion, a sentence that says so; else empty.
  std::string tolerance_warning() const { return tolerance_check_ ? tolerance_check_->warning() : std::string(); }
  /// Where the tolerance is coarser than the motion, how far the velocity may be off along a direction (unit) of the
  /// state: by the errors of all steps, or by what it lets some steps be off; else 0.
  double velocity_error(const Eigen::VectorXd& direction, double t);

 private:
  /// Of the current Segment.
  System& law() {
    if (branched_ != nullptr) return branched_->law();
    return held_law_.system();
  }
  /// Of the holds of an instant, those that it has not kicked off their borders.
  std::vector<EventHold> kept_holds(const Instant& instant) const;
  /// What holds the motion has changed: a stepper for the new law, and watches.
  void use_law();
  void make_stepper();
  /// Whether the method's steps are as long as a tolerance lets them be.
  bool keeps_tolerance() const;
  /// `instant`: at which the course goes on; null at the start.
  void begin(double t, const Eigen::VectorXd& q, const Instant* instant);
  /// How far a step may go at most up to that time where solids stay on corners.
  double turning_limit(double limit) const;
  /// From time t on, where the law may switch: it stays on its branches up to the next switch.
  void enter_piece(double t);
  /// The step has ended at a switch of the law: goes on behind it.
  void pass_switch();
  /// The current Segment is over: takes on how far it may have gone astray.
  void pass_error(double t);
  /// Puts orientations right where a step has ended, on the Segment too.
  void put_orientations_right();
  /// Replaces the stepper's state by one that means the same.
  void amend_stepper(const Eigen::VectorXd& q);

  const World& world_;
  int group_;
  HeldCourseLaw held_law_;
  std::unique_ptr<AnyStepper> stepper_;
  BranchedStepper* branched_ = nullptr;  // the stepper, where the law has choices by the state
  TimeSwitches switches_;
  TimeSwitches::Piece piece_{};  // that the law is kept within
  OrientationUpkeep orientations_;
  ClosedRotations closed_rotations_;
  StateError error_;
  std::optional<MotionScale> scale_;               // where tolerances follow it
  std::optional<ToleranceCheck> tolerance_check_;  // where one was asked for
  StepStatistics finished_steppers_;
  std::vector<std::string> finished_warnings_;
  Segment<> segment_;
  std::deque<Segment<>> rest_of_step_;  // the Segments behind it, where a step is more than one
  Eigen::VectorXd end_state_;           // of the step
  double handed_on_ = 0.0;              // s
  bool begins_anew_ = true;             // nothing was handed on since the last start
  CourseWatches watches_;
  Crossing next_;
};

}  // namespace trajet
