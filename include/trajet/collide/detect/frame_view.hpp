#pragma once

#include "trajet/math/vector.hpp"
#include "trajet/ode/segment.hpp"

namespace trajet {

/// The path of a point as a driven thing sees it: where the point would be if the thing had stayed as it was at the
/// start, so that what is searched is a point against a shape at rest.
///
/// x = c + R^T (r - p), with p the thing's pivot, at c at the start, R its rotation since, and r the point. From
/// frame.t0() on, up to frame.t1() or as long as one polynomial holds it to rounding; the error bound is of position,
/// m.
///
/// `frame`: p and the unit quaternion of R; `motion`: of the point, whose position begins at component `offset`; both
/// cover the time.
Segment<3> view_from(const Segment<7>& frame, bool turns, const Vector3& pivot, const Segment<>& motion, int offset);

}  // namespace trajet
