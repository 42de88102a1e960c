#pragma once

#include <variant>

#include "trajet/collide/detect/contact.hpp"
#include "trajet/event/path.hpp"
#include "trajet/geom/shapes.hpp"

namespace trajet {

/// A ball along a piece of a Segment: its centre's path, between two absolute times. Radius 0: a point. Refers to the
/// path.
struct MovingBall {
  const PointPath& path;
  double radius;  ///< m, >= 0
  double from;    ///< s; both within the Segment
  double to;      ///< s; less than `from` where the integration runs backward
  Locator locator = Locator::polynomial;
  double start_error = 0.0;  ///< m: estimated error of the position where the Segment begins
};

/// The table of pairs: the first contact of a ball with each shape. A new shape needs a line here: without it,
/// `first_contact` does not compile.
///
/// A ball is the point against the obstacle grown by the radius, edges and corners rounded, exactly. Shapes are closed:
/// edges and corners belong to them. Both ends of the time belong to the search.
ContactResult first_contact_with(const Plane& plane, const MovingBall& ball, const ContactMemory& memory);
ContactResult first_contact_with(const Disk& disk, const MovingBall& ball, const ContactMemory& memory);
ContactResult first_contact_with(const Rectangle& rectangle, const MovingBall& ball, const ContactMemory& memory);
ContactResult first_contact_with(const Triangle& triangle, const MovingBall& ball, const ContactMemory& memory);
ContactResult first_contact_with(const Sphere& sphere, const MovingBall& ball, const ContactMemory& memory);
ContactResult first_contact_with(const Box& box, const MovingBall& ball, const ContactMemory& memory);
ContactResult first_contact_with(const MeshSurface& surface, const MovingBall& ball, const ContactMemory& memory);
ContactResult first_contact_with(const SolidOfRevolution& solid, const MovingBall& ball, const ContactMemory& memory);
ContactResult first_contact_with(const EllipsoidBody& ellipsoid, const MovingBall& ball, const ContactMemory& memory);
ContactResult first_contact_with(const Cavity& cavity, const MovingBall& ball, const ContactMemory& memory);
/// Points only.
ContactResult first_contact_with(const Terrain& terrain, const MovingBall& point, const ContactMemory& memory);

/// The first contact of a ball with a shape.
///
/// - A ball that starts in contact and moves away is not hit; one that moves inward is, at the start. Where its rate
/// vanishes
///   the motion that follows decides; a contact that lasts is none.
/// - A start inside a solid, or nearer to an obstacle than the radius, is `overlapping_at_start`, unless `memory` says
/// that
///   the body is known to be inside.
/// - To go on after a contact, search again from ContactResult::time with its memory: then the next contact is found,
/// in or out.
inline ContactResult first_contact(const Shape& shape, const MovingBall& ball, const ContactMemory& memory = {}) {
  // Nothing happens in no time, and what was known stays known.
  if (ball.from == ball.to) return {.memory = memory};
  if (!ball.path.is_finite()) return {.status = ContactStatus::unresolved, .time = ball.from, .memory = memory};
  return std::visit([&](const auto& s) { return first_contact_with(s, ball, memory); }, shape);
}

}  // namespace trajet
