#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "trajet/collide/sustain/contact_forces.hpp"
#include "trajet/geom/convex_core.hpp"
#include "trajet/geom/shapes.hpp"
#include "trajet/geom/surface_patch.hpp"
#include "trajet/law/program.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {

/// A body that stays on an obstacle.
struct RestingContact {
  int body = 0;      ///< in World::bodies
  int obstacle = 0;  ///< in World::obstacles
  int offset = 0;    ///< of the body in the group's state
  Vector3 normal;    ///< unit, away from the obstacle; of a curved or moving one where it was looked at last
  Vector3 point;     ///< of the face on which the body stays, m
  Vector3 release =
      normal;  ///< the contact would have to pull where release . a > 0, a the acceleration without contacts
  /// Whether it is on a flat face at rest, without friction: all it does is to hold the body back along its normal.
  bool is_plain = true;
  SurfacePatch patch{};  ///< on which the body stays, where the obstacle stands at the start
  ContactMode mode{};    ///< how the contact lasts
  /// Of a solid that is no point or ball: its corners, and which of them touch.
  std::shared_ptr<const ConvexCore> core{};
  std::vector<int> corners{};
  /// Whether it lies flat on a round face: the corners are points of its rim (`level_rim`).
  bool is_on_rim = false;
  std::vector<ContactUnknown> unknowns{};  ///< of its forces; `contact` counts the contacts of the body
  /// Where the body's centre sticks to the obstacle, m, as that stood at the start; none: it does not stick.
  std::optional<Vector3> stuck_at{};
};

/// The contact in which a body sticks to an obstacle; null if it does not.
const RestingContact* sticking_contact(const std::vector<RestingContact>& contacts, int body);

/// What the contacts of one body on several obstacles with the normals n_i do together.
struct Support {
  std::vector<Vector3> blocked;  ///< orthonormal: the directions in which the body does not move
  /// One for each contact: with N = [n_1 n_2 …], forces N lambda per mass hold the body for lambda = -N^+ a, a its
  /// acceleration without contacts, N^+ the pseudo-inverse. These are the rows of N^+.
  std::vector<Vector3> release;
};
Support support(const std::vector<Vector3>& normals);

/// The law of a group with the body at `offset` held back in a direction (unit): of the rates of its position and its
/// velocity, the parts along it are taken out.
Program hold(const Program& law, int offset, const Vector3& direction);

/// Programs of t and the group's state that become positive when a contact ends.
struct ReleaseConditions {
  Program pull;                     ///< release . a, a the acceleration that the law gives the body, m/s^2
  std::vector<Program> past_edges;  ///< how far the body is past each edge of the face to which it may come
};
/// `blocked`: by all contacts of the body, as in Support. Where they hold it along an edge, it does not come past it.
ReleaseConditions release_conditions(const Program& law, const Shape& shape, const RestingContact& contact,
                                     const std::vector<Vector3>& blocked);

}  // namespace trajet
