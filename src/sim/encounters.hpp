#pragma once

#include <map>
#include <optional>
#include <vector>

#include "course.hpp"
#include "driven_obstacle.hpp"
#include "instant.hpp"
#include "solid_search.hpp"
#include "trajet/collide/detect/contact.hpp"
#include "trajet/geom/box_tree.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// A body and an obstacle that may meet.
struct Pair {
  PairId id;
  bool is_lasting = false;   ///< they stay in contact: nothing to search
  ContactMemory memory{};    ///< what is known of them at `known_at`
  double known_at = 0.0;     ///< s
  ContactResult contact{};   ///< the next one behind `known_at`, within what was searched
  ContactMemory ahead{};     ///< what is known at `searched_to`, if there is no contact before
  double searched_to = 0.0;  ///< s
};

/// How a body's centre moves as an obstacle's surface sees it, in the axes of the world.
struct RelativeMotion {
  Vector3 velocity;      ///< m/s
  Vector3 acceleration;  ///< m/s^2
};

/// Looks out for the contacts of the bodies of a run with its obstacles: all pairs, what is known of them, and their
/// searches, on each body's current Segment.
///
/// A few obstacles, and those without bounds, are searched over the whole Segment. Of many, the near ones are found by
/// boxes: the Segment is walked piece by piece, each as long as its swept box meets few of them, or few more than it
/// begins in, and the walk ends at the first contact, whichever obstacle it is with. What is far away costs the
/// logarithm of how much there is.
class Encounters {
 public:
  /// Both outlive the object.
  Encounters(const World& world, SolidSearch& solids);

  /// The course of the body has made a Segment: searches its contacts, up to time `until` at least.
  void follow(int body, const Course& course, double until);
  /// Searches on, up to time `until` at least or the first contact.
  void search(int body, const Course& course, double until);
  /// The course ends its Segment at time t: keeps what is known of the body's pairs then. All contacts before are
  /// handled.
  void keep(int body, const Course& course, double t);

  /// The first contact of the body behind what was handled, on what was searched of its Segment; null if there is none.
  const Pair* first(int body) const;
  /// Of a body's pairs, all that are near its course.
  const std::vector<Pair>& pairs(int body) const { return bodies_[static_cast<std::size_t>(body)].pairs; }
  Pair& pair(PairId id);
  /// The other pairs of the same body whose contact cannot be told in time from that of `handled`.
  std::vector<PairId> met_at_once(const Pair& handled) const;

  /// Bounds the errors of the times of the contacts found, by how far the course may be off.
  void bound_times(int body, Course& course);

  /// The body goes through the obstacle, or past it.
  void pass(PairId id, const Course& course);
  /// The body moves away from its last contact with the obstacle: what the Segment shows is that contact still, to its
  /// error. Goes on behind it; false if that would hide a flight of that height (m).
  bool stay_in_contact(PairId id, const Course& course, double height);
  /// A course has restarted at the instant: takes what is known of its pairs from there on.
  void take(const Instant& instant);
  /// The body was moved by a jump at time t, m: forgets on which side of what it is, but where the jump keeps the gap.
  void move(int body, double t, const Vector3& from, const Vector3& to);

  /// Where a driven obstacle is at time t; none of a fixed one.
  std::optional<FrameMotion> frame(int obstacle, double t);
  /// Of the body whose state has that rate.
  RelativeMotion relative_motion(PairId id, double t, const Eigen::VectorXd& q, const Eigen::VectorXd& rate);

  /// How many pairs were searched so far.
  long searches() const { return searches_; }

 private:
  /// The pairs of one body.
  struct Around {
    std::vector<Pair> pairs;
    double searched_to = 0.0;  // s; what is bounded has no contact before but those in `pairs`
    double stride = 0.0;       // s, of the last piece walked
  };

  Around& around(int body) { return bodies_[static_cast<std::size_t>(body)]; }
  Pair& find_or_add(int body, int obstacle, double t);
  ContactResult first_contact_until(const Pair& pair, const ContactMemory& memory, const Course& course, double from,
                                    double to);
  /// Searches a pair on the whole Segment.
  void search_whole(Pair& pair, const Course& course);
  /// The bounded obstacles near a stretch of a body's path, if they are not more than `most`.
  std::optional<std::vector<int>> near(const Aabb& swept, std::size_t most) const;
  std::size_t count_near(const Aabb& swept) const;

  const World& world_;
  std::vector<Around> bodies_;
  std::map<int, DrivenObstacle> driven_;  // by the index of the obstacle
  SolidSearch& solids_;
  std::vector<int> always_;   // obstacles that are searched whatever is near
  std::vector<int> in_tree_;  // the others, in the order of the tree
  std::optional<BoxTree> tree_;
  long searches_ = 0;
  std::vector<bool> is_stuck_;  // of each body, to an obstacle: it meets nothing that would turn it back
};

}  // namespace trajet
