#include "hull_contact.hpp"

#include <algorithm>
#include <limits>

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

/// The depth of the deepest place, m, or a little more: half of the least distance from a face to the farthest corner.
double depth(const ConvexFaces& faces) {
  double least = std::numeric_limits<double>::infinity();
  for (const ConvexFaces::Side& side : faces.sides) {
    double farthest = 0.0;
    for (const Vector3& corner : faces.corners) farthest = std::max(farthest, side.normal.dot(side.point - corner));
    least = std::min(least, 0.5 * farthest);
  }
  return least;
}

}  // namespace

ContactResult hull_contact(const MeshSurface& surface, const MovingBall& ball, const ContactMemory& memory) {
  if (stays_clear(bounding_ball(surface), ball)) return stays_separated(1);
  const SurfaceTriangles& triangles = *surface.triangles;
  const double radius = ball.radius + triangles.growth;
  const HullGap gap(*triangles.convex, ball.path, radius);
  const auto place = [&](const Vector3& position) {
    if (radius == 0.0) {
      const ConvexFaces::Side& side = side_at(*triangles.convex, position);
      return SurfacePoint{position - side.normal.dot(position - side.point) * side.normal, side.normal};
    }
    const Vector3 nearest = nearest_place(triangles, position).point;
    const Vector3 normal = (position - nearest).stableNormalized();
    return SurfacePoint{nearest + triangles.growth * normal, normal};
  };
  return contact_with_surface(gap, ball, memory, place, [&] { return depth(*triangles.convex) + radius; });
}

}  // namespace trajet::detail
