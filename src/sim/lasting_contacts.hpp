#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "contact_settling.hpp"
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

  /// A contact in which a body might stay on an obstacle, where it touches that now; none where the surface is such
  /// that trajet cannot follow it there.
  std::optional<RestingContact> contact_at(const Instant& instant, PairId id, const Vector3& point,
                                           const Vector3& normal) const;
  /// The contact with the part of the same obstacle that goes on where a ball comes past the end of a patch.
  std::optional<RestingContact> next_patch(const Instant& instant, const RestingContact& left) const;
  /// How strongly the body is pressed on it, as its law has it without contacts: m/s^2 along the normal.
  double pull_on(const Instant& instant, const RestingContact& contact) const;
  /// The body stays on the obstacle from the impact on. Its last flights, which nobody can tell from contact, would be
  /// over at `rest_time`: then the rest is reported. Why it cannot be followed; empty if it is.
  std::string begin(Instant& instant, RestingContact contact, const Impact& impact, double rest_time);
  /// Takes from a body that lies flat on a round face the speed, too low for a flight, at which it still departs as a
  /// whole. How long the flights to come would have taken, s; 0 of other contacts.
  double lay_flat(Instant& instant, const RestingContact& contact, const Pair& pair) const;
  /// The body sticks to the obstacle from the impact on, of which it tells what came of it. Why that cannot be
  /// followed; empty if it is.
  std::string stick(Instant& instant, PairId id, Impact& impact);
  /// After an impact that gave a resting body its velocity: ends the contacts from or into which it moves now, and
  /// takes out of the velocity what the others do not let pass.
  std::string release_by_speed(Instant& instant, int body);
  /// Ends the contacts that would have to pull at the body, and decides how the others go on. Why that cannot be
  /// decided; empty if it is.
  std::string release_by_force(Instant& instant, int body, const std::vector<EndedMode>& ended = {});
  /// Ends the contacts that an event's `set` has broken.
  std::string release_after_set(Instant& instant);
  /// Ends the contact of that index by itself, or the way in which it lasts. `time_error_bound`: of its end, s. Why it
  /// cannot be followed; empty if it is.
  std::string handle_end(Instant& instant, int contact, ContactEnd end, int detail, double time_error_bound);
  /// Where the face of a contact goes on without a step ahead of the body, the pair with the obstacle on which it does.
  std::optional<PairId> continuation(const RestingContact& left, const Eigen::VectorXd& q) const;
  /// Whether a face on which the body slides goes on without a step on that obstacle, whose edge is nothing to hit.
  bool slides_onto(PairId id, const Course& course, const Eigen::VectorXd& q) const;
  /// Reports the rests whose time has come.
  void record_until(double time);

 private:
  /// Takes the speed at which the contacts of a body, not all plain, depart or close.
  void release_moving(Instant& instant, int body);
  void keep_kind(PairId id, ImpactKind kind);
  /// Keeps and reports how contacts go on.
  void keep_kinds(const ContactSettling& settling, const Instant& instant);
  /// An event's `set` has moved a body that sticks: it goes on freely.
  void let_go(Instant& instant, const RestingContact& contact);
  /// Another corner of a solid comes to the surface on which the solid stays.
  std::string touch(Instant& instant, int contact, double time_error_bound);
  /// Ends a contact; its pair remembers it.
  ContactMemory& release(Instant& instant, int contact);
  void end(Instant& instant, int contact);
  void record(const RestingContact& contact, ImpactKind kind, double time, const Eigen::VectorXd& q,
              double time_error_bound = 0.0);
  /// Whether the face of a contact goes on on another obstacle ahead of the body.
  bool goes_on(const RestingContact& contact, int next, const Eigen::VectorXd& q) const;
  /// Where a body slides off a face and another one goes on from there without a step, its contact with that one
  /// begins.
  bool rest_on_continuation(Instant& instant, const RestingContact& left);
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
  std::map<std::pair<int, int>, ImpactKind> kinds_;  // of body and obstacle, as contacts last
};

}  // namespace trajet
