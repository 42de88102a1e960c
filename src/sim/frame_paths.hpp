#pragma once

#include "trajet/ode/segment.hpp"
#include "trajet/rigid/frame_path.hpp"
#include "trajet/scene/driven_frame.hpp"
#include "trajet/scene/world.hpp"

namespace trajet {

/// Where the frame of a body is on a Segment of its group, from time `from` on, up to the Segment's end or as far as
/// one path holds it to rounding: as it is reported, whatever way its orientation is carried.
FramePath body_path(const World::Body& body, const Segment<>& segment, double from);

/// The same of the frame of a driven obstacle, which stood like this at the start, from `from` towards `until`.
FramePath driven_path(DrivenFrame& frame, const Vector3& p_WB_start, const Quaternion& q_WB_start, double from,
                      double until);

}  // namespace trajet
