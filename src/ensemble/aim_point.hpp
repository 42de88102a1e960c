#pragma once

#include <optional>

#include "trajet/ensemble/aim.hpp"
#include "trajet/scene/driven_frame.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// What is aimed at, in one world: a point at rest, or the centre of an obstacle that moves.
class AimPoint {
 public:
  /// The world lives as long as this.
  AimPoint(const World& world, const AimTarget& target);

  /// Throws InputError at `where` if there is no such obstacle, or none with a centre.
  static void check(const Scene& scene, const AimTarget& target, const SourceLocation& where);

  /// The way of a point, whose position begins at component `offset`, as the target sees it: the distance to the origin
  /// is that to the target. From `from` on, up to `until` or as far as one polynomial reaches.
  Segment<3> relative(const Segment<>& motion, int offset, double from, double until);

 private:
  Vector3 center_;  ///< at the start, m
  std::optional<DrivenFrame> frame_;
  bool turns_ = false;  ///< and the centre is not what it turns about
};

}  // namespace trajet
