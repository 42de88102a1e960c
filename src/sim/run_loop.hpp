#pragma once

#include <limits>
#include <optional>
#include <string>

#include "agenda.hpp"
#include "contact_handler.hpp"
#include "encounters.hpp"
#include "event_handler.hpp"
#include "group_handler.hpp"
#include "lasting_contacts.hpp"
#include "meeting_handler.hpp"
#include "meetings.hpp"
#include "recorder.hpp"
#include "solid_search.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// A run on its way: integrate, find what happens next, let it be handled, go on from there. Nothing else in trajet
/// joins the three.
///
/// Courses advance on their own, each by its own Segments. What happens is handled in the order of time over all of
/// them, so that each time every course's current Segment covers that time.
class RunLoop {
 public:
  RunLoop(const World& world, RunObserver& observer);

  /// Handles what happens next. False when the run is over.
  bool step();
  bool is_over() const { return !running_; }
  /// Ends the run as far as it has come: a step could not get the memory that it needs.
  void run_out_of_memory();
  double next_time() const;
  /// Ends the run where it is. Once.
  RunResult result();

 private:
  friend class RunControl;

  /// What happens next to a course: something of its own, a contact with an obstacle, or one with another body.
  struct Incident {
    double time;
    const Pair* contact = nullptr;
    const Meeting* meeting = nullptr;
    bool is_look = false;  ///< or it is time to look for meetings further on
  };

  Incident next(int course) const;
  void start();
  void handle(int course, const Incident& incident);
  void advance(int course);
  void enqueue(int course);
  void go_on(int course, const Instant& instant);
  /// The law of the course sticks or slips where its last step began.
  void record_slides(int course);
  std::string describe_failed_step(int course, StepStatus status);
  bool is_segment_end(int course, const Incident& incident) const;

  void stop();
  /// A motion whose state runs to infinity just at the end of the run has none there.
  void fail_if_blown_up();
  void fail(double time, const std::string& reason);
  /// Ends the run where it was interrupted.
  void interrupt(double time);

  Course& course(int index) { return *courses_[static_cast<std::size_t>(index)]; }

  const World& world_;
  double direction_;
  Recorder::Courses courses_;
  SolidSearch solids_;
  Encounters encounters_;
  Meetings meetings_;
  Recorder recorder_;
  LastingContacts lasting_contacts_;
  Agenda agenda_;
  RunControl control_;
  EventHandler events_;
  ContactHandler contacts_;
  GroupHandler groups_;
  MeetingHandler meeting_handler_;
  bool has_started_ = false;
  bool running_ = true;
  long step_count_ = 0;
  /// An event has asked for the end of the run.
  struct Stop {
    double time;         // s
    double error_bound;  // s
  };
  std::optional<Stop> stop_;
};

}  // namespace trajet
