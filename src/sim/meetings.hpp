#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "recorder.hpp"
#include "solid_search.hpp"
#include "trajet/collide/detect/contact.hpp"
#include "trajet/geom/aabb.hpp"
#include "trajet/geom/moving_boxes.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// Two bodies that may meet, the lower index first.
struct Meeting {
  using Id = std::pair<int, int>;
  Id id{};
  ContactMemory memory{};   ///< what is known of them at `known_at`
  double known_at = 0.0;    ///< s
  ContactResult contact{};  ///< the next one behind it, of the first body with the second, within what was searched
};

/// Looks out for the contacts of the bodies of a run with each other, on what their current Segments have in common.
///
/// Each body has a window, a stretch of its Segment that begins now, as long as its swept box meets few others'. A pair
/// whose boxes meet is searched where their windows overlap; where the one ends first its body looks further, at the
/// pair too. So nothing is missed, and what is far away costs the logarithm of how much there is. A body whose motion
/// changes leaves: what was found of it is void.
class Meetings {
 public:
  /// All outlive the object.
  Meetings(const World& world, const Recorder::Courses& courses, SolidSearch& solids);

  /// The course of the body has made a Segment: looks for meetings from its start on, up to time `until` at most.
  void follow(int body, double until);
  /// Looks further, from `from` on, where the body's last window ends.
  void look_on(int body, double from, double until);
  /// How far was looked for the body; nothing where that is the end of its Segment.
  std::optional<double> looked_to(int body) const;
  /// The motion of the body ends at time t: what was found of it behind that is void.
  void leave(int body, double t);
  /// The body was moved by a jump: nothing is known of it any more.
  void forget(int body);

  /// The first meeting of the body on what was searched; null if there is none.
  const Meeting* first(int body) const;
  /// The bodies that are near enough to be looked at, in order, and what is known of the body with one of them.
  const std::vector<int>& others(int body) const { return window(body).others; }
  const Meeting& meeting(const Meeting::Id& id) const { return meetings_.find(id)->second; }
  /// The other meetings of either body whose time cannot be told from that of this one.
  std::vector<Meeting::Id> met_at_once(const Meeting& meeting) const;
  /// Bodies meet at `first` or later in other ways than they did when that was asked last: their courses, in order.
  std::vector<int> take_changed();

  /// Goes on behind a contact that has changed nothing.
  void pass(const Meeting::Id& id);
  /// What is known of a pair behind a contact, of which both have left.
  void remember(const Meeting::Id& id, const ContactMemory& memory);
  /// A contact is still the last one, from which the bodies part: the gap may stay as small as it is up to this part of
  /// `height` (m). False if it already was.
  bool stay_in_contact(const Meeting::Id& id, double height);
  /// The two touch at their meeting and go on together: gaps up to `tolerance` (m) are of that contact. False if that
  /// was tried at this time already.
  bool stay_in_touch(const Meeting::Id& id, double tolerance);

  /// How many pairs were searched so far.
  long searches() const { return searches_; }

 private:
  struct Window {
    double from = 0.0, to = 0.0;  // s
    Aabb box{};
    double stride = 0.0;  // s, of the last one
    bool is_open = false;
    std::vector<int> others{};  // whose boxes met this one, in order; some may be about to look
  };

  Window& window(int body) { return windows_[static_cast<std::size_t>(body)]; }
  const Window& window(int body) const { return windows_[static_cast<std::size_t>(body)]; }
  const Course& course_of(int body) const;
  const World::Body& body(int index) const { return world_.bodies[static_cast<std::size_t>(index)]; }
  void close(int body);
  /// Goes on behind a meeting with what is known then.
  void go_on(Meeting& meeting, const ContactMemory& memory);
  /// The bodies that meet `body` and whose boxes overlap one, unless they are more than `most`.
  std::optional<std::vector<int>> near(int body, const Aabb& box, std::size_t most) const;
  /// Nothing happens to a pair up to time t: keeps what is known of it then.
  static void keep(Meeting& meeting, double t);
  /// Searches a pair from `from` on, as far as both windows reach.
  void search(Meeting& meeting, double from);
  void add_other(int body, int other);
  /// The pair is far apart: it is forgotten.
  void part(int body, int other);

  const World& world_;
  const Recorder::Courses& courses_;
  SolidSearch& solids_;
  double direction_;
  bool is_possible_;
  bool has_windows_;
  std::vector<Window> windows_;  // of each body
  MovingBoxes boxes_;
  std::map<Meeting::Id, Meeting> meetings_;
  std::vector<int> changed_;
  long searches_ = 0;
};

}  // namespace trajet
