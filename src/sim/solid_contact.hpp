#pragma once

#include <optional>
#include <vector>

#include "instant.hpp"
#include "trajet/scene/driven_frame.hpp"

namespace trajet {

/// The lowest point of each corner of a solid above the flat patch of a contact, world, in the order of its core's
/// vertices; none where a round face lies level. `frame`: of the obstacle, if it is driven; `q`: the state of the
/// body's group.
std::vector<Vector3> places_of_corners(const World& world, const RestingContact& contact,
                                       const std::optional<FrameMotion>& frame, const Eigen::VectorXd& q);

/// How high each corner of a solid is above the flat patch of a contact, m, in the order of its core's vertices; none
/// where a round face lies level. `frame`: of the obstacle, if it is driven; `q`: the state of the body's group.
std::vector<double> heights_of_corners(const World& world, const RestingContact& contact,
                                       const std::optional<FrameMotion>& frame, const Eigen::VectorXd& q);

/// The corners of a solid that touch the flat patch of a contact, in the order of its core's vertices. `frame`: of the
/// obstacle, if it is driven; `q`: the state of the body's group.
std::vector<int> touching_corners(const World& world, const RestingContact& contact,
                                  const std::optional<FrameMotion>& frame, const Eigen::VectorXd& q);

/// What is known of a pair behind such a contact: along the face they are apart, but for what the corners have drifted.
ContactMemory memory_of_corners(const World& world, const RestingContact& contact,
                                const std::optional<FrameMotion>& frame, const Eigen::VectorXd& q,
                                ContactMemory memory);

/// A contact in which a solid that is no point or ball might stay on an obstacle, where it touches that with the normal
/// in the point; none where the solid is not convex, the obstacle not flat there, or a round face lies on it.
std::optional<RestingContact> solid_contact(const World& world, PairId id, const std::optional<FrameMotion>& frame,
                                            const Vector3& point, const Vector3& normal, const Eigen::VectorXd& q);

}  // namespace trajet
