#include "driven_outlines.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>
#include <variant>

#include "obstacle_faces.hpp"
#include "trajet/portable.hpp"
#include "trajet/scene/driven_frame.hpp"

namespace trajet::detail {

namespace {

constexpr int kTimes = 4;
constexpr std::size_t kMostFaces = 100;
constexpr int kCircleSides = 48;

std::vector<Face> faces_at_start(const Shape& shape, const Vector3& across) {
  if (std::holds_alternative<Plane>(shape) || std::holds_alternative<Terrain>(shape)) return {};
  if (const auto* ball = std::get_if<Sphere>(&shape))
    return {face(make_disk(ball->center, across, ball->radius), kCircleSides)};
  const Vector3 far = Vector3::Constant(std::numeric_limits<double>::max() / 4.0);
  return obstacle_faces(shape, Eigen::AlignedBox3d(Vector3(-far), far));
}

void add_outlines(const World::Obstacle& obstacle, double duration, const Vector3& across,
                  const Eigen::AlignedBox3d& shown, std::vector<std::vector<Vector3>>& outlines) {
  const std::vector<Face> faces = faces_at_start(obstacle.shape, across);
  if (faces.size() > kMostFaces) return;
  DrivenFrame frame(*obstacle.drive);
  for (int k = 1; k <= kTimes; ++k) {
    const FrameMotion motion = frame.at(duration * k / kTimes);
    std::vector<std::vector<Vector3>> all;
    bool is_near = true;
    for (const Face& each : faces) {
      std::vector<Vector3>& outline = all.emplace_back();
      for (const Vector3& corner : each.corners) outline.push_back(motion.from_start(corner));
      outline.push_back(outline.front());
      is_near = is_near && ranges::all_of(outline, [&](const Vector3& corner) { return shown.contains(corner); });
    }
    if (is_near) std::move(all.begin(), all.end(), std::back_inserter(outlines));
  }
}

}  // namespace

std::vector<std::vector<Vector3>> driven_outlines(const World& world, double duration, const Vector3& across,
                                                  const Eigen::AlignedBox3d& motion) {
  std::vector<std::vector<Vector3>> outlines;
  if (duration == 0.0 || motion.isEmpty()) return outlines;
  const Vector3 reach = Vector3::Constant(motion.sizes().maxCoeff());
  const Eigen::AlignedBox3d shown(Vector3(motion.min() - reach), Vector3(motion.max() + reach));
  for (const World::Obstacle& obstacle : world.obstacles)
    if (obstacle.drive) add_outlines(obstacle, duration, across, shown, outlines);
  return outlines;
}

}  // namespace trajet::detail
