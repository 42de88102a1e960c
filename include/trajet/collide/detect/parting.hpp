#pragma once

#include "trajet/collide/detect/turning_contact.hpp"
#include "trajet/geom/convex_pieces.hpp"
#include "trajet/rigid/frame_path.hpp"

namespace trajet {

/// When two things that overlap are apart again.
struct Parting {
  /// `hit`: apart from `contact.time` on, for a while at least; `separated`: not by the end; `unresolved`: nothing is
  /// known from then on. Of `contact` the gap rate is not negative, and the normal that of b, towards a.
  TurningContact contact{};
  int piece_a = 0;  ///< which part last
  int piece_b = 0;
};

/// The first time from `from` to `to`, which both paths cover, at which all pieces of `a` are apart from all of `b`;
/// pieces of b may be half spaces. `touches_at_start`: they have touched at `from`, and go in.
///
/// As long as one pair is deeper within each other than their points can move against each other, all are: time goes on
/// by the depth over a bound of that speed, and nothing in between is passed over. What is less deep than 1e-4 of the
/// size goes on by a part of the time in which its rate would lead it out, and what comes out for less than that is not
/// seen. What overlaps less deep than 1e-12 of the size is looked at ahead: whether it is apart then, or deeper again.
Parting first_parting(const ConvexPieces& a, const FramePath& path_a, const ConvexPieces& b, const FramePath& path_b,
                      double from, double to, bool touches_at_start);

}  // namespace trajet
