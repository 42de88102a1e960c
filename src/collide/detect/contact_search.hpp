#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "trajet/collide/detect/contact.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/math/root_search.hpp"

namespace trajet::detail {

/// What the search of a gap function found, in the path's own time.
struct GapContact {
  ContactStatus status = ContactStatus::separated;
  double tau = 0.0;
  double root_error = 0.0;
  int side_before = 0;
  int side_after = 0;             ///< separated: the side at the end, 0 unknown
  bool stays_at_zero = false;     ///< separated: the gap is zero all the time
  bool stays_in_contact = false;  ///< separated: no new contact, the handled one lasts
};

/// The first contact by a gap function, positive outside, negative inside.
///
/// `is_solid`: the negative side is matter, where a motion cannot start. `accept(tau)`: whether a root is a contact at
/// all; a point that crosses the plane of a disk beside it is none.
template <EnclosedFunction F, class Accept>
class ContactSearch {
 public:
  ContactSearch(const F& gap, bool is_solid, const ContactMemory& memory, bool is_handled, Accept accept)
      : gap_(gap), is_solid_(is_solid), side_(memory.side), is_handled_(is_handled), accept_(accept) {}

  GapContact run() {
    start();
    if (contact_) return *contact_;
    const SearchStatus status = visit_roots(gap_, [this](const Root& root) {
      root.at_begin ? take_start(root) : take(root);
      return !contact_;
    });
    if (contact_) return *contact_;
    return {.side_before = side_, .side_after = side_, .stays_at_zero = status == SearchStatus::identically_zero};
  }

 private:
  void start() {
    const FunctionSample begin = gap_.at(gap_.begin());
    const double value = begin.jet.value;
    if (!std::isfinite(value) || std::abs(value) <= begin.tolerance) return;
    const int sign = value > 0.0 ? 1 : -1;
    bool is_touching = is_handled_;
    if (side_ == 0 && is_solid_ && sign < 0) {
      // A first position within the rounding of the motion to come is not inside yet.
      is_touching = -value <= gap_.at(gap_.end()).tolerance;
      if (!is_touching) {
        contact_ = {ContactStatus::overlapping_at_start, gap_.begin(), 0.0, sign, sign, false};
        return;
      }
      side_ = 1;
    }
    if (side_ == 0) side_ = sign;
    if (sign == side_) return;
    // The body came to the other side between two searches by rounding at a joint of Segments, or it touches and may be
    // on its way back to its side.
    const double forward = gap_.end() < gap_.begin() ? -1.0 : 1.0;
    const bool returns = is_touching && forward * begin.jet.rate * side_ > 0.0;
    if (!returns) cross({gap_.begin(), 0.0, RootKind::crossing, side_, sign, true, false});
  }

  /// The gap is zero from the start on to this root: only what follows it tells where the body goes.
  void take_start(const Root& root) {
    if (root.kind == RootKind::unresolved) return report(ContactStatus::unresolved, root, root.sign_after);
    if (side_ == 0) {
      side_ = root.sign_after;
      if (is_solid_ && root.sign_after < 0 && accept_(root.time)) {
        side_ = 1;
        report(ContactStatus::hit, root, -1);
      }
    } else if (root.sign_after == -side_) {
      cross(root);
    } else if (!is_handled_ && accept_(root.time)) {
      report(ContactStatus::graze, root, side_);
    }
  }

  void take(const Root& root) {
    if (root.kind == RootKind::unresolved) return report(ContactStatus::unresolved, root, root.sign_after);
    if (root.kind == RootKind::crossing) {
      if (root.sign_after != side_) cross(root);
    } else if (root.sign_before == side_ && accept_(root.time)) {
      report(ContactStatus::graze, root, side_);
    }
  }

  void cross(const Root& root) {
    if (accept_(root.time)) {
      report(ContactStatus::hit, root, root.sign_after);
    } else {
      side_ = root.sign_after;
    }
  }

  void report(ContactStatus status, const Root& root, int side_after) {
    const double tau = root.at_begin ? gap_.begin() : root.time;
    contact_ = {status, tau, root.error_bound, side_, side_after, false};
  }

  const F& gap_;
  bool is_solid_;
  int side_;
  bool is_handled_;
  Accept accept_;
  std::optional<GapContact> contact_;
};

}  // namespace trajet::detail
