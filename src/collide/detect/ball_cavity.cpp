#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "ellipsoid_gap.hpp"
#include "grown_gap.hpp"
#include "jet_hull.hpp"
#include "tightened_gap.hpp"
#include "trajet/collide/detect/contact_table.hpp"
#include "trajet/geom/cavity.hpp"

namespace trajet {

namespace {

/// How far a ball is before the nearest of the walls around it.
class CavityGap {
 public:
  CavityGap(const CavityWalls& walls, const MovingBall& ball) : radius_(ball.radius) {
    for (const Plane& plane : walls.planes) planes_.emplace_back(ball.path, plane.normal, plane.point);
    if (walls.round) round_.emplace(*walls.round, ball.path);
    if (walls.ellipsoid) ellipsoid_.emplace(*walls.ellipsoid, ball.path);
  }

  template <class Enclose>
  IntervalJet gap(const Enclose& enclose) const {
    behind_.clear();
    for (const detail::Coordinate& plane : planes_) behind_.push_back(-enclose(plane));
    if (round_) behind_.push_back(round_->behind(enclose));
    if (ellipsoid_) behind_.push_back(ellipsoid_->signed_distance(enclose));
    IntervalJet gap = -detail::greatest(behind_);
    gap[0] -= radius_;
    return gap;
  }

 private:
  struct Round {
    detail::Coordinate x, y, z;
    double half_length, radius;

    Round(const RoundWall& wall, const PointPath& path)
        : x(path, wall.R_WB.col(0), wall.center),
          y(path, wall.R_WB.col(1), wall.center),
          z(path, wall.R_WB.col(2), wall.center),
          half_length(wall.half_length),
          radius(wall.radius) {}

    template <class Enclose>
    IntervalJet behind(const Enclose& enclose) const {
      IntervalJet arm =
          std::isinf(half_length)
              ? detail::distance_of(std::array{enclose(x), enclose(y)})
              : detail::distance_of(std::array{enclose(x), enclose(y), detail::overhang(enclose(z), half_length)});
      arm[0] -= radius;
      return arm;
    }
  };

  double radius_;
  std::vector<detail::Coordinate> planes_;
  std::optional<Round> round_;
  std::optional<detail::EllipsoidDistance> ellipsoid_;
  mutable std::vector<IntervalJet> behind_;  // scratch
};

}  // namespace

ContactResult first_contact_with(const Cavity& cavity, const MovingBall& ball, const ContactMemory& memory) {
  const CavityWalls& walls = *cavity.walls;
  const bool is_flat = walls.planes.size() == 1 && !walls.round && !walls.ellipsoid;
  if (is_flat) return first_contact_with(walls.planes[0], ball, memory);
  const CavityGap gap(walls, ball);
  return detail::contact_with_surface(gap, ball, memory, [&](const Vector3& position) {
    const auto place = detail::nearest_on_walls(cavity, position);
    return detail::SurfacePoint{place.point, place.normal.normalized()};
  });
}

}  // namespace trajet
