#pragma once

#include <limits>
#include <string>

#include "encounters.hpp"
#include "instant.hpp"
#include "lasting_contacts.hpp"
#include "meetings.hpp"
#include "recorder.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

class GroupHandler;
class RunLoop;

/// What those who handle an incident of a run may do with it: read and change its parts, let its courses go on, or end
/// it.
class RunControl {
 public:
  explicit RunControl(RunLoop& loop) : loop_(loop) {}

  const World& world() const;
  Course& course(int index) const;
  int course_of(int body) const { return world().bodies[static_cast<std::size_t>(body)].group; }
  Encounters& encounters() const;
  Meetings& meetings() const;
  Recorder& recorder() const;
  LastingContacts& lasting_contacts() const;
  GroupHandler& groups() const;

  /// The course goes on as the instant says; then it must be advanced.
  void go_on(int course, const Instant& instant) const;
  /// Makes the next Segment of a course, searches it, and puts what happens then on the agenda.
  void advance(int course) const;
  /// Puts what happens next to a course on the agenda.
  void enqueue(int course) const;
  /// The same where a course goes on from something that has changed nothing.
  void pass_on(int course) const;
  /// Whether an event of the course cannot be told in time from t.
  bool has_event_at(int course, double t) const;
  void handle_event(int course, double time) const;
  /// Ends the run here and now.
  void stop() const;
  /// Ends it when all that happens at this instant is done.
  void stop_after(double time, double error_bound) const;
  void fail(double time, const std::string& reason) const;
  /// Ends it where nobody can tell whether, or when, two things meet. `why` may be empty.
  void fail_unresolved(double time, const std::string& body, const std::string& with, const std::string& why) const;

 private:
  RunLoop& loop_;
};

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

}  // namespace trajet
