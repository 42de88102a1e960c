#pragma once

#include <array>

#include "grown_gap.hpp"
#include "trajet/geom/distance.hpp"

namespace trajet::detail {

/// A box in a frame of its own, to which distances are enclosed: what the coordinates are beyond the half sizes are the
/// components of the way to it. A rectangle is a box without height.
class CuboidDistance {
 public:
  CuboidDistance(const PointPath& path, const Box& box)
      : coordinates_{Coordinate(path, box.R_WB.col(0), box.center), Coordinate(path, box.R_WB.col(1), box.center),
                     Coordinate(path, box.R_WB.col(2), box.center)},
        half_size_(box.half_size) {}
  CuboidDistance(const PointPath& path, const Rectangle& rectangle)
      : coordinates_{Coordinate(path, across(rectangle), rectangle.center),
                     Coordinate(path, rectangle.up, rectangle.center),
                     Coordinate(path, rectangle.normal, rectangle.center)},
        half_size_(0.5 * rectangle.width, 0.5 * rectangle.height, 0.0) {}

  template <class Enclose>
  IntervalJet distance(const Enclose& enclose, double far) const {
    std::array<IntervalJet, 3> beyond;
    double least = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      beyond[i] = overhang(enclose(coordinates_[i]), half_size_[static_cast<Eigen::Index>(i)]);
      least = std::max(least, least_size(beyond[i][0]));
      if (least > far) return far_away(least);
    }
    // beyond one face: no square root, and no error of one
    const auto is_zero = [&](std::size_t i) { return beyond[i][0].lower() == 0.0 && beyond[i][0].upper() == 0.0; };
    for (std::size_t i = 0; i < 3; ++i) {
      if (!is_zero((i + 1) % 3) || !is_zero((i + 2) % 3)) continue;
      if (beyond[i][0].lower() > 0.0) return beyond[i];
      if (beyond[i][0].upper() < 0.0) return -beyond[i];
    }
    return distance_of(beyond);
  }

 private:
  std::array<Coordinate, 3> coordinates_;
  Vector3 half_size_;
};

}  // namespace trajet::detail
