#pragma once

#include <optional>
#include <set>
#include <tuple>

#include "encounters.hpp"
#include "instant.hpp"
#include "recorder.hpp"

namespace trajet {

/// The contacts of a run that last: how they begin, what ends them, and their reports.
///
/// They are part of an instant while it is being decided; the course takes them with it.
class LastingContacts {
 public:
  /// All outlive the object.
  LastingContacts(const World& world, const Recorder::Courses& courses, Encounters& encounters, Recorder& recorder)
      : world_(world), courses_(courses), encounters_(encounters), recorder_(recorder) {}

  /// The body stays on the obstacle from the impact on. Its last flights, which nobody can tell from contact, would be
  /// over at `rest_time`: then the rest is reported.
  void begin(Instant& instant, PairId id, const Impact& impact, double rest_time);
  /// After an impact that gave a resting body its velocity: ends the contacts from or into which it moves now, and
  /// takes out of the velocity what the others do not let pass.
  void release_by_speed(Instant& instant, int body);
  /// Ends the contacts that would have to pull at the body.
  void release_by_force(Instant& instant, int body);
  /// Ends the contacts that an event's `set` has broken.
  void release_after_set(Instant& instant);
  /// Ends the contact of that index by itself: what it would have to pull, or an edge that the body has come to.
  /// `time_error_bound`: of its end, s.
  void leave(Instant& instant, int contact, bool is_past_edge, double time_error_bound);
  /// Where the face of a contact goes on without a step ahead of the body, the pair with the obstacle on which it does.
  std::optional<PairId> continuation(const RestingContact& left, const Eigen::VectorXd& q) const;
  /// Whether a face on which the body slides goes on without a step on that obstacle, whose edge is nothing to hit.
  bool slides_onto(PairId id, const Course& course, const Eigen::VectorXd& q) const;
  /// Reports the rests whose time has come.
  void record_until(double time);

 private:
  /// Ends a contact; its pair remembers it.
  ContactMemory& release(Instant& instant, int contact);
  void end(Instant& instant, int contact);
  void record(const RestingContact& contact, ImpactKind kind, double time, const Eigen::VectorXd& q,
              double time_error_bound = 0.0);
  /// Whether the face of a contact goes on on another obstacle ahead of the body.
  bool goes_on(const RestingContact& contact, int next, const Eigen::VectorXd& q) const;
  /// Where a body slides off a face and another one goes on from there without a step, its contact with that one
  /// begins.
  void rest_on_continuation(Instant& instant, const RestingContact& left);
  const World::Body& body(int index) const { return world_.bodies[static_cast<std::size_t>(index)]; }
  const World::Obstacle& obstacle(int index) const { return world_.obstacles[static_cast<std::size_t>(index)]; }

  /// A body that rests already and whose rest is yet to be reported.
  struct Coming {
    double time;
    PairId id;
    double time_error_bound;
    bool operator<(const Coming& other) const {
      return std::tie(time, id.body, id.obstacle) < std::tie(other.time, other.id.body, other.id.obstacle);
    }
  };

  const World& world_;
  const Recorder::Courses& courses_;
  Encounters& encounters_;
  Recorder& recorder_;
  std::set<Coming> coming_;
};

}  // namespace trajet
