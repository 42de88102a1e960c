#pragma once

#include <vector>

#include "trajet/math/vector.hpp"

namespace trajet {

/// The perfectly inelastic, frictionless impact of a body on several surfaces at one instant: the impulses lambda_i >=
/// 0 per mass along the normals n_i (unit, towards the body) after which it approaches none of them, v+ . n_i >= 0, and
/// that act only where it stays, lambda_i (v+ . n_i) = 0.
///
/// So v+ = v + sum lambda_i n_i is the point nearest to v of the cone of velocities that the surfaces let pass,
/// whatever the order of the surfaces. The energy does not grow: v+ . (v+ - v) = sum lambda_i (v+ . n_i) = 0, hence
/// |v|^2 = |v+|^2 + |v - v+|^2.
///
/// \param normals   of the surfaces, at least one
/// \param velocity  before the impact, m/s
std::vector<double> plastic_impulses(const std::vector<Vector3>& normals, const Vector3& velocity);

}  // namespace trajet
