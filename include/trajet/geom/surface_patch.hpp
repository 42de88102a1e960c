#pragma once

#include <optional>
#include <vector>

#include "trajet/geom/flat_faces.hpp"
#include "trajet/geom/shapes.hpp"

namespace trajet {

/// A part of a shape's surface on which a point or a ball may stay: all places at one distance from a feature, so that
/// the normal there follows from where the ball's centre is.
struct SurfacePatch {
  enum class Kind {
    plane,   ///< a flat face
    point,   ///< a sphere, or a corner for a ball
    line,    ///< a cylinder's side, or a straight edge for a ball
    circle,  ///< the rim of a disk for a ball
    cone,    ///< a cone's side
  };
  Kind kind = Kind::plane;
  Vector3 center = Vector3::Zero();  ///< of the feature: the point, one of the line, the middle of the circle, m
  Vector3 axis = Vector3::UnitZ();   ///< unit: of line, circle and cone; the normal of a plane
  double radius = 0.0;               ///< of the circle, m
  double slope = 0.0;                ///< of a cone: the normal's part along the axis, the sine of its half angle
  double side = 1.0;                 ///< -1: the body is within, as in a bowl or a pipe
  /// Where the patch ends.
  std::vector<FaceEdge> edges{};       ///< past it where direction . p > limit, p the ball's centre
  std::optional<FaceRim> outer_rim{};  ///< past it where p is further from the axis
  std::optional<FaceRim> inner_rim{};  ///< past it where p is nearer to it

  bool is_flat() const { return kind == Kind::plane; }
};

/// Unit, towards a ball whose centre is at p. For any number type that has `sqrt`.
template <class T>
Vector3T<T> normal_of(const SurfacePatch& patch, const Vector3T<T>& p) {
  using std::sqrt;
  using Kind = SurfacePatch::Kind;
  const auto unit = [](const Vector3T<T>& v) { return Vector3T<T>(v * (T(1.0) / sqrt(v.dot(v)))); };
  const Vector3T<T> axis = patch.axis.template cast<T>();
  if (patch.kind == Kind::plane) return axis;
  const Vector3T<T> arm = p - patch.center.template cast<T>();
  const T side(patch.side);
  if (patch.kind == Kind::point) return Vector3T<T>(unit(arm) * side);
  const Vector3T<T> radial = arm - axis * axis.dot(arm);
  if (patch.kind == Kind::line) return Vector3T<T>(unit(radial) * side);
  const Vector3T<T> outward = unit(radial);
  if (patch.kind == Kind::cone)
    return Vector3T<T>(outward * T(std::sqrt(1.0 - patch.slope * patch.slope)) + axis * T(patch.slope));
  return Vector3T<T>(unit(Vector3T<T>(arm - outward * T(patch.radius))) * side);
}

/// The patch on which a ball of that radius (0: a point) stays whose centre is at `position`, where it touches the
/// shape at `point` with that normal, unit, towards it. None where the surface is none of these: an ellipsoid, a
/// terrain, an edge of a mesh.
std::optional<SurfacePatch> patch_at(const Shape& shape, const Vector3& point, const Vector3& normal,
                                     const Vector3& position);

}  // namespace trajet
