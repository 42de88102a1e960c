#include "round_contact.hpp"

#include <cmath>
#include <variant>

#include "sustained.hpp"
#include "trajet/geom/closest_point.hpp"

namespace trajet {

Vector3 ahead_of(const Vector3& point, const Vector3& velocity) {
  constexpr double kAhead = 1e-9;  // of the size of the coordinates
  return point + kAhead * point.norm() * velocity.stableNormalized();
}

std::optional<RestingContact> round_contact(const World& world, PairId id, const std::optional<FrameMotion>& frame,
                                            const Vector3& point, const Vector3& normal, const Eigen::VectorXd& q) {
  const BodySlice slice = world.bodies[static_cast<std::size_t>(id.body)].slice();
  const Vector3 position = slice.position(q), velocity = slice.velocity(q);
  const Vector3 place = ahead_of(point, velocity - velocity.dot(normal) * normal);
  const auto seen = [&](const Vector3& p) { return frame ? frame->to_start(p) : p; };
  const Vector3 seen_normal = frame ? Vector3(frame->R.transpose() * normal) : normal;
  // at an edge, a flat face is that into which it moves
  const Shape& shape = world.obstacles[static_cast<std::size_t>(id.obstacle)].shape;
  std::optional<SurfacePatch> patch = patch_at(shape, seen(place), seen_normal, seen(position));
  if (!patch) patch = patch_at(shape, seen(point), seen_normal, seen(position));
  if (!patch) return std::nullopt;
  RestingContact contact{id.body, id.obstacle, slice.first, normal, place, normal};
  contact.is_plain = is_plain_contact(world, id.body, id.obstacle, *patch);
  contact.patch = *patch;
  return contact;
}

std::optional<RestingContact> next_round_contact(const World& world, const RestingContact& left,
                                                 const std::optional<FrameMotion>& frame, const Eigen::VectorXd& q) {
  const double radius = bounding_radius(world.bodies[static_cast<std::size_t>(left.body)].solid);
  if (radius == 0.0) return std::nullopt;
  const Vector3 position = q.segment<3>(left.offset);
  Vector3 velocity = q.segment<3>(left.offset + 3);
  if (frame) velocity -= frame->velocity_at(position);
  // so far ahead that another part of the surface shows itself by its normal
  constexpr double kAhead = 1e-6;
  const Vector3 ahead = position + kAhead * radius * velocity.stableNormalized();
  const Vector3 seen = frame ? frame->to_start(ahead) : ahead;
  const Shape& shape = world.obstacles[static_cast<std::size_t>(left.obstacle)].shape;
  const Vector3 foot = std::visit([&](const auto& s) { return closest_point(s, seen); }, shape);
  const Vector3 normal = (seen - foot).normalized() * left.patch.side;
  constexpr double kTouch = 1e-6;
  if (std::abs((seen - foot).norm() - radius) > kTouch * radius) return std::nullopt;
  const std::optional<SurfacePatch> patch = patch_at(shape, foot, normal, seen);
  if (!patch || patch->kind == left.patch.kind) return std::nullopt;
  RestingContact next = left;
  next.patch = *patch;
  next.is_plain = is_plain_contact(world, left.body, left.obstacle, *patch);
  next.normal = frame ? Vector3(frame->R * normal) : normal;
  next.point = frame ? frame->from_start(foot) : foot;
  return next;
}

}  // namespace trajet
