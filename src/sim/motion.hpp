#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rotations.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/collide/sustain/resting_contact.hpp"
#include "trajet/event/event_watch.hpp"
#include "trajet/ode/registry.hpp"
#include "trajet/scene/program_system.hpp"
#include "trajet/scene/world.hpp"
#include "trajet/sim/run_result.hpp"

namespace trajet {

/// The next thing that happens to a motion on its current Segment.
struct Incident {
  enum class Kind { segment_end, event, contact, leave, past_edge };
  double time = 0.0;
  Kind kind = Kind::segment_end;
  int index = 0;  ///< of the event in World::events; of the pair for a contact, else of the resting contact that ends
};

/// One group of a World on its way: its stepper, the Segment it is on, and all it looks out for.
///
/// It advances by Segments; on each, `next()` is the first incident behind what was handled. Whoever handles an
/// incident says how the motion goes on: `pass_event`, `pass_contact`, or `restart` from a new state.
class Motion {
 public:
  /// A body of the group and an obstacle.
  struct Pair {
    int body;      ///< in World::bodies
    int obstacle;  ///< in World::obstacles
    bool resting = false;
    ContactMemory memory{};   ///< what is known of the pair at `known_at`
    double known_at = 0.0;    ///< s
    ContactResult contact{};  ///< the next one behind `known_at` on the current Segment
  };

  /// The observer receives the motion piece by piece. All but the last piece: that is up to `hand_on`.
  Motion(const World& world, int group, RunObserver& observer);

  /// Makes the next Segment, from the current time on.
  StepStatus advance();
  const Incident& next() const { return next_; }
  /// Hands the motion on the current Segment up to time t to the observer, as far as it has not been.
  void hand_on(double t);

  /// The event was noticed; it is not the next one any more.
  void take_event(int event);
  /// Goes on from an event that changed nothing.
  void pass_event(int event);
  /// The body goes through the obstacle, or past it.
  void pass_contact(int pair);
  /// The body moves away from its last contact with the obstacle: what the Segment shows is that contact still, to its
  /// error. Goes on behind it; false if that would hide a flight of that height (m).
  bool stay_in_contact(int pair, double height);
  /// Goes on from state `q` at time `t`, on which the current Segment ends.
  void restart(double t, const Eigen::VectorXd& q);
  /// The body of the pair stays on the obstacle, whose normal is given, from the next restart on.
  void begin_rest(int pair, const Vector3& normal, const Vector3& point);
  /// From the next restart on, at time t, the resting contact of that index has ended. Returns its pair.
  int end_rest(int resting, double t);
  /// After a restart: the body has bounced off.
  void rebound(int pair, const ContactMemory& memory) { pairs_[static_cast<std::size_t>(pair)].memory = memory; }
  /// After a restart that moved a body elsewhere.
  void forget_contacts(int body) {
    for (Pair& pair : pairs_)
      if (pair.body == body) pair.memory = {};
  }

  const World::Group& group() const { return world_.groups[static_cast<std::size_t>(group_)]; }
  /// What the watch of an event of the group has found.
  const EventWatch::Crossing& crossing(int event) const;
  const Pair& pair(int index) const { return pairs_[static_cast<std::size_t>(index)]; }
  const std::vector<Pair>& pairs() const { return pairs_; }
  const std::vector<RestingContact>& resting() const { return resting_; }
  const Segment<>& segment() const { return segment_; }
  /// The state at a time on the current Segment, its orientations settled.
  Eigen::VectorXd state(double t) const;
  /// The law at a state: dq/dt, contact forces included.
  Eigen::VectorXd rate(double t, const Eigen::VectorXd& q) const;
  /// What the resting contacts of the body at `offset` in the state do together.
  Support support(int offset) const;
  /// The acceleration that the law alone gives the body at `offset`, without contacts.
  Vector3 free_acceleration(int offset, double t, const Eigen::VectorXd& q) const;
  bool finished() const { return segment_.t1() == world_.end; }
  StepStatistics statistics() const;
  /// What the method has to say of its work.
  std::vector<std::string> warnings() const;

 private:
  struct Watch {
    int event;  ///< in World::events
    EventWatch watch;
  };

  struct ReleaseWatch {
    int resting;          ///< in resting_
    Incident::Kind kind;  ///< why it ends: leave, past_edge
    EventWatch watch;
  };

  /// Begins anew under the group's law, with the bodies held that rest.
  void use_law();
  void begin(double t, const Eigen::VectorXd& q);
  /// Goes on from settled orientations where a step has ended.
  void settle_rotations();
  /// The pair's first contact on the current Segment between `known_at` and `to`.
  ContactResult first_contact_until(const Pair& pair, double to) const;
  /// Moves what is known of a pair on to time t on the current Segment; all contacts before it are handled.
  void know_until(Pair& pair, double t) const;
  void find_next();
  /// Adds what the current Segment up to time t adds to the error of the state.
  void collect_error(double t);

  const World& world_;
  int group_;
  RunObserver& observer_;
  double handed_on_ = 0.0;   // s
  bool begins_anew_ = true;  // nothing was handed on since the last start
  std::unique_ptr<ProgramSystem> system_;
  std::unique_ptr<AnyStepper> stepper_;
  Rotations rotations_;
  StepStatistics finished_steppers_;
  std::vector<std::string> finished_warnings_;
  Segment<> segment_;
  Eigen::VectorXd end_state_;
  Eigen::VectorXd
      error_;  // estimated, of the state where the current Segment begins: those of all steps before it added up
  std::vector<Pair> pairs_;
  std::vector<Watch> watches_;
  std::vector<RestingContact> resting_;
  std::vector<ReleaseWatch> release_watches_;
  Incident next_;
};

}  // namespace trajet
