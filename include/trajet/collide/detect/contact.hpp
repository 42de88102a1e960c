#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "trajet/collide/detect/witness_axis.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// How the times of contacts are found.
enum class Locator {
  polynomial,     ///< every root of the gap on the Segment, by enclosure
  interpolation,  ///< the course's 3.1: a sign change between step ends, then the mean velocity
  subdivision,    ///< the course's 3.2: a sign change between step ends, then repeated subdivision
};

enum class ContactStatus {
  separated,             ///< no contact
  hit,                   ///< reaches the surface and goes on to its other side
  graze,                 ///< touches without crossing
  unresolved,            ///< contact can neither be shown nor excluded
  overlapping_at_start,  ///< begins inside a solid
};

enum class ContactDirection {
  entering,  ///< into a solid, or into the space within a ball's radius of an obstacle
  leaving,   ///< out of it
  through,   ///< a point through a thin obstacle
};

/// What is known of a pair of ball and obstacle before a search, so that Segments join without losing or doubling a
/// contact.
///
/// A pair that has never been searched has the default. After a search that found nothing, and after a contact that the
/// body passed through, ContactResult::memory holds for what follows; after a contact that it bounced off, `rebounded`
/// of it.
struct ContactMemory {
  /// +1 outside a solid or before a thin obstacle, -1 inside or behind, 0 unknown.
  int side = 0;
  /// The time of a contact that was reported last. A search that begins at this very time does not report it again.
  double contact_time = std::numeric_limits<double>::quiet_NaN();
  /// Whether the side is that of the edge of a thin shape, in whose plane a point moves.
  bool is_in_plane = false;
  /// Within this gap (m) a search that begins at `contact_time` is still in that contact.
  double tolerance = 0.0;
  /// Of solids that turn: along which they were apart, or touched.
  std::optional<WitnessAxis> axis{};
  int body_piece = 0;  ///< of what is not convex: whose axis that is
  int obstacle_piece = 0;
  /// Unit, world, of the obstacle at the contact of solids that turn, towards the body; zero without a contact.
  Vector3 normal = Vector3::Zero();
};

/// The memory after a contact at which the body stayed on the side that it came from.
inline ContactMemory rebounded(ContactMemory memory) {
  memory.side = -memory.side;
  return memory;
}

/// A part of a solid's surface.
enum class Feature { vertex, edge, face, surface };  // surface: a round one

/// What touches of two solids.
struct TouchedFeatures {
  Feature of_body = Feature::vertex;
  Feature of_obstacle = Feature::vertex;
  /// The corners of what they have in common: of a face on a face a polygon, of an edge on a face a stretch; else one.
  std::vector<Vector3> points{};
};

/// The first contact of a body with an obstacle. World frame, SI units.
struct ContactResult {
  ContactStatus status = ContactStatus::separated;
  double time = 0.0;                   ///< of the contact; for `unresolved`, from where on nothing is known
  double time_error_bound = 0.0;       ///< s: of the root, and of the Segment's error over the approach speed
  Vector3 point = Vector3::Zero();     ///< of contact, on the obstacle
  Vector3 normal = Vector3::Zero();    ///< unit, of the obstacle at the point, towards the side that the body came from
  Vector3 position = Vector3::Zero();  ///< of the body's centre
  ContactDirection direction = ContactDirection::entering;
  int side_before = 0;                       ///< of a contact: from which the body came, as in ContactMemory
  double time_resolution = 0.0;              ///< s: the part of time_error_bound that rounding makes
  double gap_rate = 0.0;                     ///< m/s, of the gap at the contact
  double gap_curvature = 0.0;                ///< m/s^2
  std::optional<TouchedFeatures> touched{};  ///< of solids that turn
  ContactMemory memory;                      ///< for what follows, if the body passes through

  /// How far the time is off where the ball's position is off by `position_error` (m) along the normal, s: dt = dx /
  /// |gap rate| at a crossing, dx = |gap''| dt^2 / 2 at a graze.
  double time_error(double position_error) const {
    if (!(position_error > 0.0)) return 0.0;
    return std::min(position_error / std::abs(gap_rate), std::sqrt(2.0 * position_error / std::abs(gap_curvature)));
  }
};

}  // namespace trajet
