#pragma once

#include <Eigen/Core>
#include <vector>

#include "crossing.hpp"
#include "held_course_law.hpp"
#include "trajet/event/event_watch.hpp"
#include "trajet/ode/segment.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// The crossings of zero that a course looks out for: its events, and the ends of what holds its motion.
class CourseWatches {
 public:
  /// Both outlive the object.
  CourseWatches(const World& world, int group, const HeldCourseLaw& law);

  bool empty() const { return watches_.empty(); }
  /// What holds the motion has changed: looks out for the ends of what does now.
  void watch_holders();
  /// Looks for crossings on a Segment.
  void search(const Segment<>& segment);
  /// The first crossing behind what was handled; the Segment's end if there is none.
  Crossing next(const Segment<>& segment) const;

  /// What the watch of an event of the group has found.
  const EventWatch::Crossing& event_crossing(int event) const { return watches_[place_of(event)].watch.next(); }
  /// The event has happened and will change the state: it is not the next one any more.
  void take_event(int event) { watches_[place_of(event)].watch.take(); }
  /// The event has changed the state from one with that rate to one with the other.
  void turn_event(int event, double t, const Eigen::VectorXd& before, const Eigen::VectorXd& rate_before,
                  const Eigen::VectorXd& behind, const Eigen::VectorXd& rate_behind);
  /// Whether the event's own set has turned or stopped what it watches.
  bool has_turned(int event) const { return watches_[place_of(event)].watch.has_turned(); }
  /// Goes on from an event that changed nothing.
  void pass_event(int event, const Segment<>& segment);
  /// The motion stood on the zero of the event, and leaves it to that side.
  void stand_on(int event, double t, const Eigen::VectorXd& q, int side);

  /// The state jumps, at time t, on the Segment so far. `are_held_anew`: what holds has changed.
  void jump(double t, const Eigen::VectorXd& before, const Eigen::VectorXd& behind, const Segment<>& segment,
            bool are_held_anew);
  /// Behind a jump what watches edges forgets that it stands on one, unless the motion goes over it.
  void forget_edges(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& rate_before,
                    const Eigen::VectorXd& rate_behind);

 private:
  struct Watch {
    Crossing::Kind kind;
    int index;
    EventWatch watch;
    ContactEnd end = ContactEnd::pull;  // of a lasting contact
    int detail = 0;                     // as in ContactEndCondition
  };

  /// The place of an event's watch.
  std::size_t place_of(int event) const;
  void watch_contacts();
  void watch_holds();
  bool is_asleep(const Watch& watch) const { return watch.kind == Crossing::Kind::event && law_.is_held(watch.index); }
  const World::Group& group() const { return world_.groups[static_cast<std::size_t>(group_)]; }

  const World& world_;
  int group_;
  const HeldCourseLaw& law_;
  std::vector<Watch> watches_;  // the events', then those of contacts and holds
};

}  // namespace trajet
