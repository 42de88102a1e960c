// Which axes a search goes on with.

#include <algorithm>
#include <cmath>

#include "refined_touch.hpp"
#include "turning_search.hpp"

namespace trajet::detail {

/// Along the axis, or where other pieces of the two things touch; zero where nothing is known.
Vector3 TurningSearch::direction_now(const RelativePose& pose) const {
  if (axis_) return axis_direction(A_, B_, pose, *axis_);
  if (starts_in_contact()) return a_.pose(from_).R_WB.transpose() * memory_.direction;
  return Vector3::Zero();
}

/// Where no axis seems clear, the best one is asked for all that it can tell.
AxisCandidate TurningSearch::choose(const RelativeMotion& window, double u, const RelativePose& pose, double tolerance,
                                    const Vector3* place) {
  AxisCandidate c = best_axis(pose, tolerance, place, direction_now(pose));
  if (!c.is_clear() && c.separation > 0.0)
    c.resolution = std::min(c.resolution, Separation(A_, B_, window, c.axis).resolution(u));
  return c;
}

AxisCandidate TurningSearch::best_axis(const RelativePose& pose, double tolerance, const Vector3* place,
                                       const Vector3& near) {
  AxisCandidate best = choice_.choose(pose, tolerance, place);
  if (best.is_clear() || A_.is_half_space || near.isZero(0.0)) return best;
  const auto offer = [&](const Vector3& n) {
    for (const WitnessAxis& axis : {WitnessAxis{.kind = AxisKind::in_a, .direction = n},
                                    WitnessAxis{.kind = AxisKind::in_b, .direction = pose.R_AB.transpose() * n}}) {
      AxisCandidate c = choice_.measure(pose, axis, tolerance);
      c.apart = best.apart;
      if (c.separation > best.separation) best = c;
    }
  };
  if (is_curved()) {
    const RefinedTouch touch = refined_touch(A_, B_, pose, near);
    offer(touch.normal);
    best.apart = std::max(0.0, touch.gap);
  } else if (best.separation < -best.resolution) {
    offer(refined_touch(A_, B_, pose, near).normal);
  }
  return best;
}

void TurningSearch::take_longest(const RelativeMotion& window, double u, const RelativePose& pose, const Vector3& near,
                                 double begin_tolerance) {
  if (A_.is_half_space) return;
  double longest = -2.0;
  const std::optional<WitnessAxis> first = axis_;
  const auto offer = [&](const WitnessAxis& axis) {
    const auto zero = Separation(A_, B_, window, axis).first_zero(u, begin_tolerance);
    const double until = zero ? zero->u : 2.0;
    if (until > longest) {
      longest = until;
      axis_ = axis;
    }
  };
  if (first) offer(*first);
  if (near.isZero(0.0) || (!is_curved() && longest > u)) return;
  const RefinedTouch touch = refined_touch(A_, B_, pose, near);
  const Vector3& n = touch.normal;
  offer({.kind = AxisKind::in_a, .direction = n});
  offer({.kind = AxisKind::in_b, .direction = pose.R_AB.transpose() * n});
  for (const Vector3& e : touch.lines_a)
    for (const Vector3& f : touch.lines_b) {
      WitnessAxis axis{.kind = AxisKind::edges, .direction = e, .line_b = f};
      const Vector3 along = axis_direction(A_, B_, pose, axis);
      if (along.isZero(0.0)) continue;
      if (along.dot(n) < 0.0) axis.direction = -axis.direction;
      offer(axis);
    }
}

bool TurningSearch::parts_behind(const RelativeMotion& window, double time, double tolerance, const Vector3& place,
                                 const Vector3& normal, double first) {
  constexpr double kFirst = 1e-12, kLast = 0.02;  // of the window
  const double length = 2.0 * std::abs(window.half());
  for (double step = std::min(std::max(first, kFirst * length), 0.5 * kLast * length); step < kLast * length;
       step *= 2.0) {
    double t = time + (from_ <= to_ ? step : -step);
    if (!is_before(t, to_)) t = to_;
    const AxisCandidate c = best_axis(pose_at(t), tolerance, &place, normal);
    if (c.is_clear()) return true;
    if (c.separation < -c.resolution || t == to_) return false;
  }
  return false;
}

}  // namespace trajet::detail
