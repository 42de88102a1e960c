#pragma once

#include "trajet/math/quaternion.hpp"

namespace trajet {

/// Principal moments of inertia and their axes: inertia = R_BP diag(moments) R_BP^T.
struct PrincipalAxes {
  Vector3 moments;  ///< kg m^2, rising unless the inertia is diagonal, whose order then stays
  Matrix3 R_BP;     ///< a rotation; its columns are the axes in the body's frame
};

/// Of an inertia, symmetric. A diagonal one keeps its axes, to the last bit.
PrincipalAxes principal_axes(const Matrix3& inertia);

/// Whether a symmetric matrix can be the inertia of a body: positive moments of which none is more than the sum of the
/// other two, but for rounding.
bool is_possible_inertia(const Matrix3& inertia);

/// The inertia about a point at p (m) from the centre of mass, from that about the centre of mass; Steiner's theorem.
Matrix3 shifted_inertia(const Matrix3& inertia, double mass, const Vector3& p);

}  // namespace trajet
