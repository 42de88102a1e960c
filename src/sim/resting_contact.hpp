#pragma once

#include <vector>

#include "trajet/geom/shapes.hpp"
#include "trajet/law/program.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// A body that stays on a flat obstacle, without friction: its velocity and acceleration have no part along the normal.
struct RestingContact {
  int pair = 0;    ///< of the Motion
  int offset = 0;  ///< of the body in the group's state
  Vector3 normal;  ///< unit, away from the obstacle
};

/// Whether a body can rest on a shape where its normal is `normal`: on a flat face; not on a curved surface, an edge, a corner.
bool is_flat_at(const Shape& shape, const Vector3& normal);

/// The law of a group with one body held on a flat obstacle: of the rates of its position and its velocity, the parts along
/// the normal are taken out.
Program hold(const Program& law, const RestingContact& contact);

/// Programs of t and the group's state that become positive when the contact ends: the acceleration away from the obstacle
/// that `law` gives the body (m/s^2), and how far the body is past each edge of the face.
std::vector<Program> release_conditions(const Program& law, const Shape& shape, const RestingContact& contact);

}  // namespace trajet
