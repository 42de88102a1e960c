#include "turning_search.hpp"

#include <algorithm>
#include <cmath>

#include "contact_patch.hpp"
#include "refined_touch.hpp"
#include "trajet/math/roots.hpp"

namespace trajet::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Of the size: what counts as the inside of a face or an edge.
constexpr double kMargin = 1e-9;

}  // namespace

TurningSearch::TurningSearch(const ConvexCore& A, const FramePath& a, const ConvexCore& B, const FramePath& b,
                             double from, double to, const TurningMemory& memory, std::vector<WitnessLink>* chain)
    : A_(A),
      B_(B),
      a_(a),
      b_(b),
      from_(from),
      to_(to),
      memory_(memory),
      chain_(chain),
      size_((A.is_half_space ? 0.0 : A.reach) + B.reach),
      choice_(A, B, size_),
      time_(from),
      longest_(std::abs(to - from)),
      axis_(memory.axis),
      is_touching_(memory.contact_time == from && memory.axis.has_value()) {}

TurningContact TurningSearch::run() {
  if (is_touching_ || approach())
    while (!is_done_ && is_before(time_, to_)) search_window();
  if (!is_done_) {
    contact_.memory.axis = axis_;
    if (stays_touching_) {
      contact_.memory.contact_time = to_;
      contact_.memory.tolerance = memory_.tolerance;
    }
  }
  return std::move(contact_);
}

bool TurningSearch::approach() {
  if (A_.is_half_space && !a_.is_at_rest()) return true;
  const double middle = 0.5 * from_ + 0.5 * to_, half = 0.5 * (to_ - from_);
  const WindowVector apart = combined(1.0, position_window(b_, middle, half), -1.0, position_window(a_, middle, half));
  // |p|^2 - size^2, or n . p - size
  LinearSum sum;
  if (A_.is_half_space) {
    sum.add(1.0, dot(Vector3(a_.pose(from_).R_WB.col(2)), apart));
    sum.add(-size_, WindowPolynomial::constant(1.0));
  } else {
    double moved = 0.0;
    Vector3 here;
    for (int i = 0; i < 3; ++i) {
      const WindowPolynomial& p = apart[static_cast<std::size_t>(i)];
      here[i] = p.coefficients()[0];
      moved += p.norm() - std::abs(here[i]) + p.error();
    }
    constexpr double kRounding = 1.0 + 1e-14;
    if (here.norm() > (size_ + moved) * kRounding) {
      axis_ = WitnessAxis{AxisKind::balls};
      link(from_, to_);
      axis_.reset();
      return false;
    }
    sum.add(1.0, dot(apart, apart));
    sum.add(-size_ * size_, WindowPolynomial::constant(1.0));
  }
  const WindowPolynomial gap = sum.value();
  if (!(gap(-1.0) > 2.0 * gap.error())) return true;
  double meet = kInfinity;
  visit_roots(gap.span(), -1.0, 1.0, 2.0 * gap.error(), [&](const Root& root) {
    meet = root.time - root.error_bound;
    return false;
  });
  const std::optional<WitnessAxis> axis = axis_;
  axis_ = WitnessAxis{AxisKind::balls};
  // a little earlier, so that a touch of the balls themselves lies within what is searched
  constexpr double kEarlier = 1e-3;
  const double time = meet == kInfinity ? to_ : middle + half * std::max(-1.0, meet - kEarlier);
  link(from_, time);
  axis_ = axis;
  time_ = time;
  return meet != kInfinity;
}

/// As long as the polynomials are likely to keep their digits.
RelativeMotion TurningSearch::next_window() const {
  constexpr double kTurn = 1.5;  // rad, of both together
  const double rest = std::abs(to_ - time_);
  const double turn = rest * (a_.pose(time_).w_WB_W.norm() + b_.pose(time_).w_WB_W.norm());
  const double length = std::min(rest / std::max(1.0, std::ceil(turn / kTurn)), longest_);
  const double end = length >= rest ? to_ : time_ + (from_ <= to_ ? length : -length);
  return {a_, b_, 0.5 * time_ + 0.5 * end, 0.5 * (end - time_)};
}

bool TurningSearch::begin_axis(const RelativeMotion& window, double tolerance) {
  if (is_touching_) return true;
  const RelativePose pose = pose_at(time_);
  if (axis_ && choice_.measure(pose, *axis_, tolerance).is_clear()) return true;
  const AxisCandidate c = choose(window, -1.0, pose, tolerance, nullptr);
  axis_ = c.axis;
  if (c.is_clear()) return true;
  const bool is_first = time_ == from_ && !memory_.axis && !memory_.is_apart;
  if ((is_first && c.separation >= -c.resolution) || (time_ == from_ && starts_in_contact())) {
    is_touching_ = true;
    return true;
  }
  if (is_first) {
    finish(ContactStatus::overlapping_at_start, time_);
    return false;
  }
  // they were apart: at a joint of paths, or of windows, what is less than the resolution has brought them together
  SeparationZero zero;
  zero.u = -1.0;
  zero.at_begin = true;
  report(window, tolerance, zero, time_, c.apart, false);
  return false;
}

void TurningSearch::search_window() {
  const RelativeMotion window = next_window();
  const double end =
      window.middle() + window.half() == to_ || std::abs(window.time(1.0) - to_) <= 4.0 * kUnitRoundoff * std::abs(to_)
          ? to_
          : window.time(1.0);
  // a choice must not depend on what the search then cannot tell from zero
  const double tolerance = std::max(8.0 * window.rounding(size_), 32.0 * kUnitRoundoff * size_);
  if (!begin_axis(window, tolerance)) return;
  if (is_touching_ && time_ == from_) {
    const RelativePose pose = pose_at(time_);
    take_longest(window, -1.0, pose, direction_now(pose), starts_in_contact() ? memory_.tolerance : 0.0);
  }
  for (double u = -1.0;;) {
    const Separation along(A_, B_, window, *axis_);
    const double here = u == -1.0 ? time_ : window.time(u);
    const bool is_start = u == -1.0 && time_ == from_;
    std::optional<SeparationZero> zero;
    if (!along.is_coarse() || !needs_shorter_window(window, along, zero, u))
      zero = along.first_zero(u, is_start && starts_in_contact() ? memory_.tolerance : 0.0);
    else
      return;
    if (zero && needs_shorter_window(window, along, zero, u)) return;
    if (!zero) {
      link(here, end);
      stays_touching_ = is_touching_ && along.stays_at_zero();
      is_touching_ = stays_touching_;
      time_ = end;
      longest_ *= 2.0;
      zooms_ = 0;
      return;
    }
    const double until = zero->u == 1.0 ? end : zero->u == -1.0 ? time_ : window.time(zero->u);
    link(here, until);
    if (!follow(window, tolerance, *zero, u)) return;
    if (u == 1.0) {
      time_ = end;
      return;
    }
  }
}

/// Ends the window early, or has its begin searched again in a shorter one, where that makes rounding less.
bool TurningSearch::needs_shorter_window(const RelativeMotion& window, const Separation& along,
                                         const std::optional<SeparationZero>& zero, double u) {
  const double here = u == -1.0 ? time_ : window.time(u);
  if (!zero) {
    constexpr double kShortest = 1e-3;
    if (!along.is_coarse() || std::abs(window.half()) <= kShortest * std::abs(to_ - from_)) return false;
    longest_ = std::abs(window.half());
    if (u > -1.0) {
      time_ = here;
      is_touching_ = false;
    }
    return true;
  }
  constexpr int kZooms = 2;
  if (zero->kind != RootKind::touch || zooms_ == kZooms || !(zero->u > u)) return false;
  ++zooms_;
  constexpr double kShorter = 1.0 / 8.0;
  longest_ = kShorter * std::abs(window.half());
  const double before = window.time(zero->u - 0.5 * kShorter);
  const double start = is_before(here, before) ? before : here;
  link(here, start);
  is_touching_ = is_touching_ && start == here;
  time_ = start;
  return true;
}

bool TurningSearch::follow(const RelativeMotion& window, double tolerance, const SeparationZero& zero, double& u) {
  const bool is_start = zero.at_begin && u == -1.0;
  const double time = is_start ? time_
                      : zero.u == 1.0 && window.time(1.0) != to_ && is_before(to_, window.time(1.0))
                          ? to_
                          : window.time(zero.u);
  if (zero.kind == RootKind::unresolved) {
    finish(ContactStatus::unresolved, time);
    return false;
  }
  const RelativePose pose = pose_at(time);
  const Touch touch = judge(A_, B_, pose, *axis_, zero, kMargin * size_);
  if (touch == Touch::contact) {
    report(window, tolerance, zero, time, 0.0, true);
    return false;
  }
  const Vector3 place = facing_points(A_, B_, pose, *axis_, zero).on_a;
  const AxisCandidate next = choose(window, zero.u, pose, tolerance, &place);
  if (!next.is_clear()) {
    axis_ = next.axis;
    report(window, tolerance, zero, time, next.apart, false);
    return false;
  }
  constexpr int kStalls = 8, kLinks = 2000;
  if (zero.u - u <= 4.0 * kUnitRoundoff && ++stalls_ > kStalls) {
    // apart by no more than rounding, and no axis leads away from here: they touch
    constexpr double kFew = 16.0;
    axis_ = next.axis;
    if (next.apart <= kFew * tolerance)
      report(window, tolerance, zero, time, next.apart, false);
    else
      finish(ContactStatus::unresolved, time);
    return false;
  }
  if (++links_ > kLinks) {
    finish(ContactStatus::unresolved, time);
    return false;
  }
  axis_ = next.axis;
  // where lines cross, no direction that is fixed in one of the solids holds for long
  constexpr double kShort = 1e-3;
  if (zero.u - u < kShort) take_longest(window, zero.u, pose, direction_now(pose), 0.0);
  is_touching_ = false;
  u = zero.u;
  return true;
}

void TurningSearch::link(double from, double to) {
  if (chain_ != nullptr) chain_->push_back({*axis_, from, to});
}

void TurningSearch::finish(ContactStatus status, double time) {
  contact_.status = status;
  contact_.time = time;
  contact_.memory.axis = axis_;
  is_done_ = true;
}

/// `is_known`: the features of the axis are those that touch, where its separation is zero. Else no axis tells the
/// solids apart any more, and this is the best there is; `apart` is what is left between them.
void TurningSearch::report(const RelativeMotion& window, double tolerance, const SeparationZero& zero, double time,
                           double apart, bool is_known) {
  FramePose a, b;
  Vector3 normal;
  ContactPatch patch;
  double rate = 0.0;
  const auto look = [&] {
    a = a_.pose(time);
    b = b_.pose(time);
    const RelativePose pose = relative_pose(a, b);
    normal = axis_direction(A_, B_, pose, *axis_);
    std::optional<RefinedTouch> touch;
    if (is_curved()) {
      touch = refined_touch(A_, B_, pose, normal);
      normal = touch->normal;
    }
    patch = contact_patch(A_, B_, pose, normal, kMargin * size_);
    if (touch && touch->is_refined && patch.corners.size() == 1) patch.point = 0.5 * (touch->on_a + touch->on_b);
    const Vector3 point = a.point(patch.point);
    rate = (a.R_WB * normal).dot(b.velocity_at(point) - a.velocity_at(point));
  };
  look();
  double left = 0.0;
  if (apart > tolerance) {
    const double after = time - apart / rate;
    if (!is_before(after, time) && !is_before(to_, after)) {
      left = std::abs(after - time);
      time = after;
      look();
    }
  }
  if (zero.at_begin && rate > 0.0 && patch.corners.size() > 1) {
    // of what lies on each other one corner is driven in where the others depart
    for (const Vector3& corner : patch.corners) {
      const Vector3 p = a.point(corner);
      const double r = (a.R_WB * normal).dot(b.velocity_at(p) - a.velocity_at(p));
      if (r >= rate) continue;
      rate = r;
      patch.point = corner;
    }
    patch.corners = {patch.point};
  }
  bool is_graze = is_known && zero.kind == RootKind::touch;
  if (!is_known && !zero.at_end) {
    // by then what is left of the gap has closed, if it closes
    const double closing = 4.0 * (std::max(0.0, apart) + tolerance) / std::abs(rate);
    is_graze = parts_behind(window, time, tolerance, patch.point, normal, closing);
  }
  finish(is_graze ? ContactStatus::graze : ContactStatus::hit, time);
  TurningContact& c = contact_;
  c.normal = a.R_WB * normal;
  c.point = a.point(patch.point);
  if (patch.corners.size() > 1)
    for (const Vector3& p : patch.corners) c.points.push_back(a.point(p));
  c.feature_a = patch.of_a;
  c.feature_b = patch.of_b;
  c.gap_rate = is_known ? zero.rate / window.half() : rate;
  c.gap_curvature = zero.curvature / (window.half() * window.half());

  const double rounding =
      2.0 * kUnitRoundoff *
      (std::abs(time) + std::abs(a_.is_at_rest() ? 0.0 : a_.t0()) + std::abs(b_.is_at_rest() ? 0.0 : b_.t0()));
  c.time_resolution = zero.error * std::abs(window.half()) + rounding;
  if (!is_known) c.time_resolution += left + c.time_error(tolerance);
  const double reach_a = A_.is_half_space ? size_ : A_.reach;
  c.time_error_bound = c.time_resolution + c.time_error(a_.point_error(reach_a) + b_.point_error(B_.reach));
  c.memory.contact_time = time;
  c.memory.tolerance = std::max(tolerance, 2.0 * rounding * std::abs(c.gap_rate));
}

}  // namespace trajet::detail
