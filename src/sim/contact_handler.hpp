#pragma once

#include <string>
#include <vector>

#include "run_control.hpp"

namespace trajet {

/// What becomes of a run at its contacts with obstacles: impacts, crossings, and the beginnings and ends of contacts
/// that last.
class ContactHandler {
 public:
  explicit ContactHandler(const RunControl& control);

  void handle(int course, const Pair& met);
  /// A lasting contact of the course would pull from now on, or has come to its edge.
  void handle_end(int course);
  /// Begins a rest where a body, behind its impact at the instant, will not fly any more; false if it cannot be
  /// followed: then the run has ended.
  bool settle(Instant& instant, const Pair& pair, const Impact& impact, double restitution);

 private:
  std::string describe_lasting(int body, const std::string& failure) const;
  /// A time behind a contact's last at which the force surely points away from it: what has left then is not found in
  /// it again.
  double end_of_pull(const Course& moving, const Crossing& crossing) const;
  /// Whether a face on which the body slides goes on on the obstacle that it meets; then the motion does.
  bool goes_on_sliding(int course, const Pair& met);
  /// Whether a solid that touches is pressed on what it touches, and does not come or go.
  bool is_pressed(const Course& moving, const Pair& pair) const;
  /// Why it is not certain that a contact is one, as far as the motion is known; else empty.
  std::string describe_doubt(Course& moving, const Pair& pair);
  /// Whether a contact is the last one still, from which the body moves away by its law; then the motion goes on.
  bool goes_on_from_contact(int course, const Pair& pair, const Impact& impact);
  void bounce(int course, Pair pair, Impact impact);
  /// The same of a body that is no point or ball.
  void bounce_off(int course, Pair pair, Impact impact);
  /// The body sticks to the obstacle.
  void stick(int course, const Pair& pair, Impact impact);
  /// Whether a solid that has bounced does not fly any more.
  bool does_not_fly(const Instant& instant, const Pair& pair) const;
  /// A solid that does not fly any more stays in contact, and the course goes on so.
  void stay(int course, const Pair& pair, const Impact& impact, Instant& instant);
  /// The same within the instant alone; false if it cannot be followed, and the run has ended.
  bool begin_stay(Instant& instant, const Pair& pair, const Impact& impact);
  /// The course goes on as the instant says, from the contact, on the side that the body came from.
  void go_on_from(int course, const Pair& pair, Instant& instant);
  /// Begins a rest where the body, after its impact, will not fly any more; false if it cannot be followed.
  bool rest(Instant& instant, const Pair& pair, const Impact& impact, double restitution, bool is_hidden);

  const World::Body& body_of(const Pair& pair) const {
    return run_.world().bodies[static_cast<std::size_t>(pair.id.body)];
  }
  const World::Obstacle& obstacle_of(const Pair& pair) const {
    return run_.world().obstacles[static_cast<std::size_t>(pair.id.obstacle)];
  }
  const Surface& surface_of(const Pair& pair) const { return run_.world().surface(pair.id.body, pair.id.obstacle); }

  const RunControl& run_;
  /// A bounce of a body that is no point or ball.
  struct Bounce {
    int obstacle = -1;
    double time = 0.0;                // s
    Vector3 point = Vector3::Zero();  // m
  };

  std::vector<AtOneInstant> last_impacts_;  // of each body
  std::vector<AtOneInstant> last_changes_;  // of how its contacts last
  std::vector<Bounce> last_bounces_;        // of each body
};

}  // namespace trajet
