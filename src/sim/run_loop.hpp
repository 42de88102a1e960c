#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "accumulation.hpp"
#include "agenda.hpp"
#include "encounters.hpp"
#include "lasting_contacts.hpp"
#include "recorder.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// A run on its way: integrate, find what happens next, respond, go on from there. Nothing else in trajet joins the
/// three.
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
  /// What happens next to a course: a contact, or a crossing of its own.
  struct Incident {
    double time;
    const Pair* contact;  // null: the course's next crossing
  };

  Incident next(int course) const;
  void start();
  void advance(int course);
  void enqueue(int course);
  /// The law of the course sticks or slips where its last step began.
  void record_slides(int course);
  std::string describe_failed_step(int course, StepStatus status);
  /// The course goes on as the instant says.
  void go_on(int course, const Instant& instant);

  bool is_segment_end(int course, const Incident& incident) const;
  void handle_event(int course, double time);
  /// The time before which the event happens infinitely often, if it happens faster and faster; else nothing.
  std::optional<double> limit_of(int course, int event, double time);
  /// The motion stays at the limit of the event, at time `limit`; false if that cannot be decided.
  bool hold(int course, int event, double time, double limit);
  std::string name_of_event(int event) const;
  /// The event's `set` changes the state.
  void set(int course, int event, double time);
  void handle_contact(int course, const Pair& met);
  void handle_contact_end(int course);
  /// What has held the motion where an event happens lets it go.
  void handle_hold_end(int course);
  /// A time behind a contact's last at which the force surely points away from it: what has left then is not found in
  /// it again.
  double end_of_pull(const Course& moving, const Crossing& crossing) const;
  /// Whether a face on which the body slides goes on on the obstacle that it meets; then the motion does.
  bool goes_on_sliding(int course, const Pair& met);
  /// Why it is not certain that a contact is one, as far as the motion is known; else empty.
  std::string describe_doubt(Course& moving, const Pair& pair);
  /// Whether a contact is the last one still, from which the body moves away by its law; then the motion goes on.
  bool goes_on_from_contact(int course, const Pair& pair, const Impact& impact);
  void bounce(int course, Pair pair, Impact impact);
  /// The same of a body that is no point or ball.
  void bounce_off(int course, Pair pair, Impact impact);
  /// Begins a rest where the body, after its impact, will not fly any more; false if it cannot be followed.
  bool rest(Instant& instant, const Pair& pair, const Impact& impact, double restitution, bool is_hidden);

  void stop();
  /// A motion whose state runs to infinity just at the end of the run has none there.
  void fail_if_blown_up();
  void fail(double time, const std::string& reason);
  /// Ends the run where it was interrupted.
  void interrupt(double time);

  Course& course(int index) { return *courses_[static_cast<std::size_t>(index)]; }
  const World::Body& body_of(const Pair& pair) const { return world_.bodies[static_cast<std::size_t>(pair.id.body)]; }
  const World::Obstacle& obstacle_of(const Pair& pair) const {
    return world_.obstacles[static_cast<std::size_t>(pair.id.obstacle)];
  }

  const World& world_;
  double direction_;
  Recorder::Courses courses_;
  Encounters encounters_;
  Recorder recorder_;
  LastingContacts lasting_contacts_;
  Agenda agenda_;
  bool has_started_ = false;
  bool running_ = true;
  long step_count_ = 0;
  /// How often something has happened at the last instant at which it did.
  struct AtOneInstant {
    double time = std::numeric_limits<double>::quiet_NaN();
    int count = 0;
    /// It happens at time t, s: so often did it there.
    int count_at(double t) {
      count = time == t ? count + 1 : 1;
      time = t;
      return count;
    }
  };
  std::vector<AtOneInstant> last_impacts_;   // of each body
  /// A bounce of a body that is no point or ball.
  struct Bounce {
    int obstacle = -1;
    double time = 0.0;                // s
    Vector3 point = Vector3::Zero();  // m
  };
  std::vector<Bounce> last_bounces_;  // of each body
  std::vector<AtOneInstant> last_events_;    // of each course
  std::vector<Accumulation> accumulations_;  // of each event that sets
  /// An event has asked for the end of the run.
  struct Stop {
    double time;         // s
    double error_bound;  // s
  };
  std::optional<Stop> stop_;
};

}  // namespace trajet
