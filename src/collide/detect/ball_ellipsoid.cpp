#include "ellipsoid_gap.hpp"
#include "tightened_gap.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/ellipsoid_distance.hpp"

namespace trajet {

namespace {

struct EllipsoidGap {
  detail::EllipsoidDistance distance;
  double radius;

  template <class Enclose>
  IntervalJet gap(const Enclose& enclose) const {
    IntervalJet gap = distance.signed_distance(enclose);
    gap[0] -= radius;
    return gap;
  }
};

}  // namespace

ContactResult first_contact_with(const EllipsoidBody& ellipsoid, const MovingBall& ball, const ContactMemory& memory) {
  if (detail::stays_clear(bounding_ball(ellipsoid), ball)) return detail::stays_separated(1);
  const EllipsoidGap gap{detail::EllipsoidDistance(ellipsoid, ball.path), ball.radius};
  return detail::contact_with_surface(gap, ball, memory, [&](const Vector3& position) {
    const Vector3 point = closest_point(ellipsoid, position);
    const Vector3 q = ellipsoid.R_WB.transpose() * (point - ellipsoid.center);
    // the gradient of sum (q_i / a_i)^2
    const Vector3 gradient = q.cwiseQuotient(ellipsoid.radii.cwiseAbs2());
    return detail::SurfacePoint{point, Vector3((ellipsoid.R_WB * gradient).stableNormalized())};
  });
}

}  // namespace trajet
