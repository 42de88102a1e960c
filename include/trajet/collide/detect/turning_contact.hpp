#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "trajet/collide/detect/contact.hpp"
#include "trajet/collide/detect/witness_axis.hpp"
#include "trajet/geom/convex_core.hpp"
#include "trajet/rigid/frame_path.hpp"

namespace trajet {

/// What is known of a pair of turning solids before a search, so that paths join without losing or doubling a contact.
///
/// A pair that has never been searched has the default. TurningContact::memory holds for what follows, whether the
/// solids bounced off, go on as they came, or nothing was found.
struct TurningMemory {
  /// Along which they were apart, or touched.
  std::optional<WitnessAxis> axis{};
  /// The time of a contact that was reported last. A search that begins at this very time does not report it again
  /// where the solids depart; where they go on into each other it is a hit at the start.
  double contact_time = std::numeric_limits<double>::quiet_NaN();
  /// Within this gap (m) a search that begins at `contact_time` is still in that contact.
  double tolerance = 0.0;
  /// Whether they are known not to overlap where the search begins; so they are where there is an axis.
  bool is_apart = false;
  /// Unit, world, from a to b: along which, at `contact_time`, other pieces of the same two things touched; or zero.
  Vector3 direction = Vector3::Zero();
};

/// The first contact of two convex solids, a and b. World frame, SI units.
struct TurningContact {
  ContactStatus status = ContactStatus::separated;
  double time = 0.0;              ///< of the contact; for `unresolved`, from where on nothing is known
  double time_error_bound = 0.0;  ///< s: of the root, and of the paths' errors over the approach speed
  double time_resolution = 0.0;   ///< s: the part of time_error_bound that rounding makes
  Vector3 point = Vector3::Zero();
  Vector3 normal = Vector3::Zero();  ///< unit, of b at the point, towards a
  double gap_rate = 0.0;             ///< m/s, of the gap at the contact
  double gap_curvature = 0.0;        ///< m/s^2
  Feature feature_a = Feature::vertex;
  Feature feature_b = Feature::vertex;
  /// The corners of what the features have in common, in order: of a face on a face, an edge on a face, an edge along
  /// an edge. `point` is their mean. Else that point alone.
  std::vector<Vector3> points{};
  TurningMemory memory{};  ///< for what follows

  /// How far the time is off where the gap is off by `gap_error` (m).
  double time_error(double gap_error) const;
};

/// The first contact of two convex solids on their paths between two times that both paths cover, `to` before `from` if
/// time runs backward. At most one of them is a half space.
///
/// Along a witness axis the separation of the solids is a polynomial in time for each pair of vertices; up to its first
/// root there is no contact. There another axis takes over, or the features of the axis touch. So nothing earlier is
/// missed, whatever the spin, and what cannot be told is `unresolved`: docs/design/first_contact.md.
///
/// `chain`, if given, gets the witnesses of this search, in order: the proof that there is no contact before.
TurningContact first_contact(const ConvexCore& a, const FramePath& path_a, const ConvexCore& b, const FramePath& path_b,
                             double from, double to, const TurningMemory& memory = {},
                             std::vector<WitnessLink>* chain = nullptr);

}  // namespace trajet
