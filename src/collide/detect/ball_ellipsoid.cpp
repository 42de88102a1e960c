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
  // in the ellipsoid's own frame: far from the origin the world's places are rounded to more than a thin one's size
  const auto place = [&](const Vector3& position) {
    const Vector3 p_CP = ellipsoid.R_WB.transpose() * (position - ellipsoid.center);
    const auto foot = detail::ellipsoid_foot<double>(ellipsoid.radii, p_CP);
    return detail::SurfacePoint{ellipsoid.center + ellipsoid.R_WB * foot.point, ellipsoid.R_WB * foot.normal};
  };
  return detail::contact_with_surface(gap, ball, memory, place,
                                      [&] { return ellipsoid.radii.minCoeff() + ball.radius; });
}

}  // namespace trajet
