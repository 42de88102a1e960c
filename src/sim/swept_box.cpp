#include "swept_box.hpp"

#include <algorithm>

#include "trajet/event/path.hpp"

namespace trajet {

Aabb swept_box(const World::Body& body, const Segment<>& segment, double from, double to) {
  const PointPath path(segment, body.offset);
  Aabb box;
  for (int i = 0; i < 3; ++i) {
    const Range range = path.range(i, from - path.t0(), to - path.t0());
    box.lower[i] = range.lower;
    box.upper[i] = range.upper;
  }
  // far above the rounding of boxes and of the contacts that touch them
  constexpr double kMargin = 1e-9;
  const double size = std::max(box.lower.lpNorm<Eigen::Infinity>(), box.upper.lpNorm<Eigen::Infinity>());
  const double radius = bounding_radius(body.solid);
  return grown(box, radius + kMargin * (radius + size));
}

}  // namespace trajet
