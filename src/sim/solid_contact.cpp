#include "solid_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <variant>

#include "impact_sides.hpp"
#include "sustained.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// A corner so much above a face, of the solid's size, lies on it.
constexpr double kTouching = 1e-9;
/// The round face of a disk is level where so little of its rim's size points down.
constexpr double kLevel = 1e-9;
/// So many points stand for the rim of a round face that lies flat. Spread evenly they give the friction of a ring that
/// slides and turns up to a part of about (v / (w R))^16, or its inverse.
constexpr int kRimPoints = 16;

std::shared_ptr<const ConvexCore> core_of(const Solid& solid) {
  if (std::holds_alternative<Mesh>(solid)) return nullptr;
  try {
    return std::make_shared<const ConvexCore>(convex_core(solid));
  } catch (const std::domain_error&) {
    return nullptr;
  }
}

/// Whether a face with a round rim is level, seen from above in the frame of the body.
bool is_level(const SupportCorner& corner, const Vector3& down_B) {
  return corner.is_spread() && (corner.spread.transpose() * down_B).norm() <= kLevel * corner.spread.norm();
}

/// The same core with points of a round face's rim instead of that.
std::shared_ptr<const ConvexCore> with_points_of_rim(const ConvexCore& core, std::size_t face) {
  ConvexCore result{.rounding = core.rounding, .reach = core.reach};
  const auto add = [&](const Vector3& vertex, const Matrix3& spread) {
    result.vertices.push_back(vertex);
    result.spreads.push_back(spread);
  };
  for (int i = 0; i < kRimPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRimPoints;
    add(core.vertices[face] + core.spreads[face] * Vector3(std::cos(angle), std::sin(angle), 0.0), Matrix3::Zero());
  }
  for (std::size_t i = 0; i < core.vertices.size(); ++i)
    if (i != face) add(core.vertices[i], core.spreads[i]);
  return std::make_shared<const ConvexCore>(std::move(result));
}

/// Where a body touches with a round face that is level, it does so on the rim of that.
void lie_on_rim(const World& world, const std::optional<FrameMotion>& frame, const Eigen::VectorXd& q,
                RestingContact& contact) {
  const World::Body& body = world.bodies[static_cast<std::size_t>(contact.body)];
  const Vector3& axis = contact.patch.axis;
  const Vector3 up = frame ? Vector3(frame->R * axis) : axis;
  const Vector3 down_B = -(rotation_of(body, body.slice(), q).transpose() * up);
  const auto on_rim = ranges::find_if(
      contact.corners, [&](int corner) { return is_level(support_corner(*contact.core, corner), down_B); });
  if (on_rim == contact.corners.end()) return;
  contact.core = with_points_of_rim(*contact.core, static_cast<std::size_t>(*on_rim));
  contact.corners = touching_corners(world, contact, frame, q);
  contact.is_on_rim = true;
}

}  // namespace

std::vector<Vector3> places_of_corners(const World& world, const RestingContact& contact,
                                       const std::optional<FrameMotion>& frame, const Eigen::VectorXd& q) {
  const World::Body& body = world.bodies[static_cast<std::size_t>(contact.body)];
  const Matrix3 R = rotation_of(body, body.slice(), q);
  const Vector3 position = body.slice().position(q);
  const Vector3& axis = contact.patch.axis;
  const Vector3 down_B = -(R.transpose() * (frame ? Vector3(frame->R * axis) : axis));
  std::vector<Vector3> places;
  for (int i = 0; i < static_cast<int>(contact.core->vertices.size()); ++i) {
    const SupportCorner corner = support_corner(*contact.core, i);
    Vector3 p_B = corner.p_B + corner.rounding * down_B;
    if (corner.is_spread()) {
      // of a face that is level all its rim is as high as its middle
      const Vector3 pulled = corner.spread.transpose() * down_B;
      if (!is_level(corner, down_B)) p_B += corner.spread * pulled.normalized();
    }
    places.push_back(position + R * p_B);
  }
  return places;
}

std::vector<double> heights_of_corners(const World& world, const RestingContact& contact,
                                       const std::optional<FrameMotion>& frame, const Eigen::VectorXd& q) {
  std::vector<double> heights;
  for (const Vector3& place : places_of_corners(world, contact, frame, q))
    heights.push_back(contact.patch.axis.dot((frame ? frame->to_start(place) : place) - contact.patch.center));
  return heights;
}

std::vector<int> touching_corners(const World& world, const RestingContact& contact,
                                  const std::optional<FrameMotion>& frame, const Eigen::VectorXd& q) {
  std::vector<int> touching;
  const std::vector<double> heights = heights_of_corners(world, contact, frame, q);
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (heights[i] <= kTouching * contact.core->reach) touching.push_back(static_cast<int>(i));
  return touching;
}

ContactMemory memory_of_corners(const World& world, const RestingContact& contact,
                                const std::optional<FrameMotion>& frame, const Eigen::VectorXd& q,
                                ContactMemory memory) {
  const World::Obstacle& obstacle = world.obstacles[static_cast<std::size_t>(contact.obstacle)];
  const Matrix3 R = rotation_matrix(obstacle.q_WB);
  const Matrix3 R_now = frame ? Matrix3(frame->R * R) : R;
  memory.axis = WitnessAxis{.kind = AxisKind::in_b, .direction = -(R_now.transpose() * contact.normal)};
  memory.normal = contact.normal;
  memory.body_piece = 0;
  memory.side = 1;
  for (const double height : heights_of_corners(world, contact, frame, q))
    memory.tolerance = std::max(memory.tolerance, -2.0 * height);
  return memory;
}

std::optional<RestingContact> solid_contact(const World& world, PairId id, const std::optional<FrameMotion>& frame,
                                            const Vector3& point, const Vector3& normal, const Eigen::VectorXd& q) {
  const World::Body& body = world.bodies[static_cast<std::size_t>(id.body)];
  const World::Obstacle& obstacle = world.obstacles[static_cast<std::size_t>(id.obstacle)];
  const Vector3 seen = frame ? frame->to_start(point) : point;
  const Vector3 seen_normal = frame ? Vector3(frame->R.transpose() * normal) : normal;
  const std::optional<SurfacePatch> patch = patch_at(obstacle.shape, seen, seen_normal, seen);
  if (!patch || !patch->is_flat()) return std::nullopt;
  RestingContact contact{id.body, id.obstacle, body.offset, normal, point, normal};
  contact.is_plain = false;
  contact.patch = *patch;
  contact.core = core_of(body.solid);
  if (!contact.core || contact.core->is_half_space) return std::nullopt;
  contact.corners = touching_corners(world, contact, frame, q);
  if (contact.corners.empty()) return std::nullopt;
  lie_on_rim(world, frame, q, contact);
  return contact;
}

}  // namespace trajet
