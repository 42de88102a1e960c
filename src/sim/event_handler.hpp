#pragma once

#include <optional>
#include <string>
#include <vector>

#include "accumulation.hpp"
#include "run_control.hpp"

namespace trajet {

/// What becomes of a run at its events: records, sets, stops, and motions that stay at the limit of infinitely many.
class EventHandler {
 public:
  explicit EventHandler(const RunControl& control);

  /// The event that is next on a course happens.
  void handle(int course, double time);
  /// What has held the motion where an event happens lets it go.
  void handle_hold_end(int course);
  std::string name_of(int event) const;

 private:
  /// The time before which the event happens infinitely often, if it happens faster and faster; else nothing.
  std::optional<double> limit_of(int course, int event, double time);
  /// The motion stays at the limit of the event, at time `limit`; false if that cannot be decided.
  bool hold(int course, int event, double time, double limit);
  /// The event's `set` changes the state.
  void set(int course, int event, double time);

  const RunControl& run_;
  std::vector<AtOneInstant> last_events_;    // of each course
  std::vector<Accumulation> accumulations_;  // of each event that sets
};

}  // namespace trajet
