#pragma once

#include <optional>

#include "instant.hpp"
#include "trajet/scene/driven_frame.hpp"

namespace trajet {

/// A point of a face a little ahead of where a body is: at an edge, in the face into which it moves.
Vector3 ahead_of(const Vector3& point, const Vector3& velocity);

/// A contact in which a point or a ball might stay on an obstacle, where it touches that with the normal in the point;
/// none where the surface is no patch. `frame`: of the obstacle, if it is driven; `q`: the state of the body's group.
std::optional<RestingContact> round_contact(const World& world, PairId id, const std::optional<FrameMotion>& frame,
                                            const Vector3& point, const Vector3& normal, const Eigen::VectorXd& q);

/// The contact with the part of the same obstacle that goes on where a ball comes past the end of a patch.
std::optional<RestingContact> next_round_contact(const World& world, const RestingContact& left,
                                                 const std::optional<FrameMotion>& frame, const Eigen::VectorXd& q);

}  // namespace trajet
