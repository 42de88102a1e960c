#pragma once

#include "shape_numbers.hpp"
#include "trajet/geom/solid.hpp"

namespace trajet {

/// A shape with its numbers, moved to its centre of mass.
struct ShapedSolid {
  Solid solid;
  Vector3 center;  ///< of mass, in the frame of the shape's keys, m
};

/// Of a body or a part of one; none has `rounding` that is sharp. Throws InputError, or std::domain_error where the
/// numbers do not make a solid.
ShapedSolid shaped_solid(const ShapeDefinition& shape, const std::optional<Expression>& rounding,
                         const ShapeNumbers& numbers);

/// The corners of a box around the origin.
std::vector<Vector3> box_corners(const Vector3& size);

/// A shape without edges stays as it is, if its bends are not sharper than the rounding. Throws std::domain_error else.
void require_blunt(const Vector3& radii, std::optional<double> rounding);

}  // namespace trajet
