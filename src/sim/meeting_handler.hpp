#pragma once

#include <string>
#include <vector>

#include "run_control.hpp"

namespace trajet {

/// What becomes of a run where two of its bodies meet.
class MeetingHandler {
 public:
  explicit MeetingHandler(const RunControl& control);

  /// `course`: of one of the two.
  void handle(int course, const Meeting& met);

 private:
  /// The courses of the two bodies go on from something that has changed nothing.
  void pass_on(const Meeting& meeting);
  /// Whether the contact is the last one still, from which the bodies part; then the motion goes on.
  bool goes_on_from_contact(const Meeting& meeting);
  /// Whether they touch and move alike, but for rounding: then the motion goes on.
  bool moves_on_alike(const Meeting& meeting);
  /// Why it is not certain that they meet, as far as the motions are known; else empty.
  std::string describe_doubt(const Meeting& meeting);
  /// Whether a body sticks to an obstacle.
  bool sticks(int body) const;
  void bounce(const Meeting& meeting, const Surface& surface, Impact impact);
  void record(const Meeting& meeting, const Impact& impact);
  void sample(const Meeting& meeting, SamplePhase phase);

  const World::Body& body(int index) const { return run_.world().bodies[static_cast<std::size_t>(index)]; }
  Course& first_course(const Meeting& meeting) const { return run_.course(body(meeting.id.first).group); }
  Course& second_course(const Meeting& meeting) const { return run_.course(body(meeting.id.second).group); }
  /// "'a' with 'b'"
  std::string names(const Meeting& meeting) const;

  const RunControl& run_;
  std::vector<AtOneInstant> last_impacts_;  // of each body
};

}  // namespace trajet
