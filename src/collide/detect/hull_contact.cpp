#include "hull_contact.hpp"

#include "hull_gap.hpp"
#include "tightened_gap.hpp"
#include "trajet/geom/triangle_surface.hpp"

namespace trajet::detail {

namespace {

/// The side that is deepest in front of a place near the surface.
const ConvexFaces::Side& side_at(const ConvexFaces& faces, const Vector3& p) {
  const auto above = [&](const ConvexFaces::Side& side) { return side.normal.dot(p - side.point); };
  const ConvexFaces::Side* highest = &faces.sides[0];
  for (const ConvexFaces::Side& side : faces.sides)
    if (above(side) > above(*highest)) highest = &side;
  return *highest;
}

}  // namespace

ContactResult hull_contact(const MeshSurface& surface, const MovingBall& ball, const ContactMemory& memory) {
  if (stays_clear(bounding_ball(surface), ball)) return stays_separated(1);
  const SurfaceTriangles& triangles = *surface.triangles;
  const double radius = ball.radius + triangles.growth;
  const HullGap gap(*triangles.convex, ball.path, radius);
  return contact_with_surface(gap, ball, memory, [&](const Vector3& position) {
    if (radius == 0.0) {
      const ConvexFaces::Side& side = side_at(*triangles.convex, position);
      return SurfacePoint{position - side.normal.dot(position - side.point) * side.normal, side.normal};
    }
    const Vector3 nearest = nearest_place(triangles, position).point;
    const Vector3 normal = (position - nearest).stableNormalized();
    return SurfacePoint{nearest + triangles.growth * normal, normal};
  });
}

}  // namespace trajet::detail
