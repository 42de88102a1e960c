#include "trajet/geom/rounded_solid.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "trajet/geom/shape_pictures.hpp"
#include "trajet/portable.hpp"

namespace trajet {
namespace {

/// Moved to the centre of mass.
RoundedSolid centered(RoundedCore core) {
  const Vector3 center = core.properties.center;
  for (Vector3& corner : core.corners) corner -= center;
  for (Eigen::Vector2d& corner : core.profile) corner.y() -= center.z();
  core.properties.center = Vector3::Zero();
  return {std::make_shared<const RoundedCore>(std::move(core))};
}

RoundedSolid turned(std::vector<Eigen::Vector2d> profile, double rounding) {
  const VolumeProperties properties = grown_profile_properties(profile, rounding);
  return centered({.profile = std::move(profile), .rounding = rounding, .properties = properties});
}

void require_left(bool is_left) {
  if (!is_left) throw std::domain_error("the rounding leaves nothing of the shape");
}

}  // namespace

RoundedSolid make_rounded_hull(std::span<const Vector3> corners, double rounding) {
  TriangleMesh core = eroded_hull(convex_hull(corners), rounding);
  const VolumeProperties properties = grown_hull_properties(core, rounding);
  return centered({.corners = std::move(core.vertices), .rounding = rounding, .properties = properties});
}

RoundedSolid make_rounded_cylinder(double radius, double height, double rounding) {
  return turned(cylinder_core_profile(radius, height, rounding), rounding);
}

RoundedSolid make_rounded_cone(double radius, double height, double rounding) {
  return turned(cone_core_profile(radius, height, rounding), rounding);
}

std::vector<Eigen::Vector2d> cylinder_core_profile(double radius, double height, double rounding) {
  const double h = 0.5 * height - rounding, r = radius - rounding;
  require_left(h > 0.0 && r > 0.0);
  return {{0.0, -h}, {r, -h}, {r, h}, {0.0, h}};
}

std::vector<Eigen::Vector2d> cone_core_profile(double radius, double height, double rounding) {
  // The side m . p = c moves inward by the rounding, with m = (height, radius) / side: so the tip sinks by
  // rounding side / radius.
  const double side = std::hypot(radius, height);
  const double base = -0.25 * height + rounding, tip = 0.75 * height - rounding * side / radius;
  require_left(tip > base);
  return {{0.0, base}, {(tip - base) * radius / height, base}, {0.0, tip}};
}

Vector3 farthest_point(const RoundedCore& core, const Vector3& direction) {
  const double norm = direction.norm();
  const Vector3 d = norm > 0.0 ? Vector3(direction / norm) : Vector3(0, 0, 1);
  Vector3 farthest = Vector3::Zero();
  double reach = -std::numeric_limits<double>::infinity();
  const auto look_at = [&](const Vector3& corner) {
    if (corner.dot(d) <= reach) return;
    reach = corner.dot(d);
    farthest = corner;
  };
  for (const Vector3& corner : core.corners) look_at(corner);
  const double across = std::hypot(d.x(), d.y());
  const Vector3 aside = across > 0.0 ? Vector3(d.x() / across, d.y() / across, 0.0) : Vector3(1, 0, 0);
  for (const Eigen::Vector2d& corner : core.profile) look_at(corner.x() * aside + Vector3(0, 0, corner.y()));
  return farthest + core.rounding * d;
}

double bounding_radius(const RoundedCore& core) {
  double reach = 0.0;
  for (const Vector3& corner : core.corners) reach = std::max(reach, corner.norm());
  for (const Eigen::Vector2d& corner : core.profile) reach = std::max(reach, corner.norm());
  return reach + core.rounding;
}

TriangleMesh picture_mesh(const RoundedCore& core) {
  if (!core.profile.empty()) return revolve(profile_outline(core.profile, core.rounding));
  return grown_hull_picture(core.corners, core.rounding);
}

}  // namespace trajet
