#pragma once

#include "separation.hpp"

namespace trajet::detail {

/// Whether the features of an axis touch where its separation is zero.
enum class Touch {
  contact,  ///< they do
  apart,    ///< the separation ends elsewhere: along another axis the solids are still apart
  unclear,  ///< within the margin of the features' ends
};

/// `margin`: of what counts as the inside of a face or an edge, m.
Touch judge(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, const WitnessAxis& axis,
            const SeparationZero& zero, double margin);

/// Where the features of an axis face each other, rounding left out: the points on both, in A.
struct FacingPoints {
  Vector3 on_a = Vector3::Zero();
  Vector3 on_b = Vector3::Zero();
};
FacingPoints facing_points(const ConvexCore& A, const ConvexCore& B, const RelativePose& pose, const WitnessAxis& axis,
                           const SeparationZero& zero);

}  // namespace trajet::detail
