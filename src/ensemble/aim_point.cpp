#include "aim_point.hpp"

#include <string_view>
#include <variant>
#include <vector>

#include "trajet/collide/detect/frame_view.hpp"
#include "trajet/portable.hpp"
#include "trajet/text/did_you_mean.hpp"

namespace trajet {

void AimPoint::check(const Scene& scene, const AimTarget& target, const SourceLocation& where) {
  const auto* name = std::get_if<std::string>(&target);
  if (name == nullptr) return;
  const auto obstacle = ranges::find(scene.obstacles, *name, &ObstacleDefinition::name);
  if (obstacle == scene.obstacles.end()) {
    std::vector<std::string_view> known;
    for (const ObstacleDefinition& each : scene.obstacles) known.push_back(each.name);
    throw InputError(where, "the scene has no obstacle '" + *name + "'" + did_you_mean(*name, known));
  }
  if (std::holds_alternative<PlaneShape>(obstacle->shape) || std::holds_alternative<TerrainShape>(obstacle->shape))
    throw InputError(where, "'" + *name + "' has no centre: a point to aim at expected, --at x,y,z");
}

AimPoint::AimPoint(const World& world, const AimTarget& target) {
  if (const auto* point = std::get_if<Vector3>(&target)) {
    center_ = *point;
    return;
  }
  // of a compound, the middle of its parts' centres
  Vector3 sum = Vector3::Zero();
  int count = 0;
  const World::Obstacle* one = nullptr;
  for (const World::Obstacle& obstacle : world.obstacles) {
    if (obstacle.name != std::get<std::string>(target)) continue;
    sum += obstacle.p_WB;
    ++count;
    one = &obstacle;
  }
  center_ = count == 1 ? one->p_WB : Vector3(sum / count);
  if (!one->drive) return;
  frame_.emplace(*one->drive);
  turns_ = one->drive->turns && center_ != one->drive->pivot;
}

Segment<3> AimPoint::relative(const Segment<>& motion, int offset, double from, double until) {
  Segment<3> view;
  if (frame_) {
    view = view_from(frame_->piece(from, until), turns_, frame_->drive().pivot, motion, offset);
  } else {
    view.resize(3, motion.degree());
    view.set_interval(motion.t0(), until);
    view.coefficients() = motion.coefficients().middleRows(offset, 3);
    view.error_bound() = motion.error_bound().segment(offset, 3);
  }
  view.coefficients().col(0) -= center_;
  return view;
}

}  // namespace trajet
