#include "trajet/collide/detect/parting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "contact_patch.hpp"
#include "penetration.hpp"
#include "refined_touch.hpp"
#include "separation.hpp"
#include "trajet/math/polynomial.hpp"

namespace trajet {
namespace {

using detail::contact_patch;
using detail::ContactPatch;
using detail::Penetration;
using detail::penetration;
using detail::refined_touch;
using detail::RefinedTouch;
using detail::relative_pose;
using detail::separation_along;

/// Bounds a path's derivatives on a stretch of time.
struct Rates {
  double acceleration = 0.0;  ///< m/s^2
  double spin = 0.0;          ///< rad/s

  Rates(const FramePath& path, double t, double length) {
    if (path.is_at_rest()) return;
    const double farthest = std::max(std::abs(t - path.t0()), std::abs(t + length - path.t0()));
    // sum k (k - 1) |c_k| tau^(k - 2)
    const auto second = [&](const Eigen::Matrix<double, 4, Eigen::Dynamic>& rows) {
      double sum = 0.0, power = 1.0;
      for (Eigen::Index k = 2; k < rows.cols(); ++k, power *= farthest)
        sum += static_cast<double>(k * (k - 1)) * rows.col(k).norm() * power;
      return sum;
    };
    acceleration = second(path.position());
    const auto& q = path.orientation();
    const double tau = t - path.t0();
    Eigen::Vector4d value = Eigen::Vector4d::Zero(), rate = Eigen::Vector4d::Zero();
    for (Eigen::Index k = q.cols(); k-- > 0;) {
      rate = rate * tau + value;
      value = value * tau + Eigen::Vector4d(q.col(k));
    }
    // w = 2 q' / |q|
    const double fastest = rate.norm() + std::abs(length) * second(q);
    const double least = value.norm() - std::abs(length) * fastest;
    spin = least > 0.0 ? 2.0 * fastest / least : std::numeric_limits<double>::infinity();
  }
};

class PartingSearch {
 public:
  PartingSearch(const ConvexPieces& a, const FramePath& path_a, const ConvexPieces& b, const FramePath& path_b,
                double from, double to)
      : a_(a), b_(b), path_a_(path_a), path_b_(path_b), from_(from), to_(to), forward_(to < from ? -1.0 : 1.0) {
    for (const ConvexCore& piece : a) reach_a_ = std::max(reach_a_, piece.reach);
    for (const ConvexCore& piece : b)
      if (!piece.is_half_space) reach_b_ = std::max(reach_b_, piece.reach);
    size_ = reach_a_ + reach_b_;
    constexpr double kThin = 1e-12;
    thin_ = kThin * size_;
  }

  Parting run(bool touches_at_start) {
    double t = from_;
    std::optional<double> inside{};
    constexpr int kMostSteps = 3000;
    for (int i = 0; i < kMostSteps && is_before(t); ++i) {
      const Penetration depth = depth_at(t);
      if (depth.at_least > thin_) {
        inside = t;
        t = advanced(t, depth);
        continue;
      }
      const Ahead ahead = look_ahead(t);
      if (ahead.kind == Ahead::end) return parting_;
      if (ahead.kind == Ahead::inside) {
        t = ahead.time;
        continue;
      }
      if (inside && is_clear(t)) t = between(*inside, t);
      const bool is_dip = touches_at_start && t == from_;
      report(is_dip ? ahead.time : t, is_dip ? std::abs(ahead.time - t) : 0.0);
      return parting_;
    }
    if (is_before(t)) {
      parting_.contact.status = ContactStatus::unresolved;
      parting_.contact.time = t;
    }
    return parting_;
  }

 private:
  static constexpr double kClear = 4.0;     // times what is thin
  static constexpr double kShallow = 1e-4;  // of the size
  struct Ahead {
    enum Kind { inside, apart, end } kind = end;
    double time = 0.0;
  };

  bool is_before(double t) const { return forward_ * (to_ - t) > 0.0; }
  RelativePose pose_at(double t) const { return relative_pose(path_b_.pose(t), path_a_.pose(t)); }

  Penetration of_pair(std::size_t i, std::size_t j, const RelativePose& pose) const {
    constexpr double kRelative = 0.25;
    const ConvexCore &b = b_[j], &a = a_[i];
    if (!b.is_half_space && pose.p_AB.norm() > (b.reach + a.reach) * (1.0 + 1e-12)) return {0.0, -thin_ * 8.0, {}};
    if (b.is_half_space || normal_.isZero(0.0)) return penetration(b, a, pose, kRelative, 0.25 * thin_);
    // near the last direction: what is apart there is, and what is curved and shallow is as deep as it is there
    if (const double apart = separation_along(b, a, pose, normal_); apart > kClear * thin_)
      return {0.0, -apart, normal_};
    if (i == last_a_ && j == last_b_ && (a.is_spread() || b.is_spread() || a.rounding + b.rounding > 0.0)) {
      const RefinedTouch touch = refined_touch(b, a, pose, normal_);
      if (touch.is_refined && -touch.gap < kShallow * size_)
        return {std::max(0.0, -touch.gap), -touch.gap, touch.normal};
    }
    return penetration(b, a, pose, kRelative, 0.25 * thin_);
  }

  /// Of the pair that overlapped last, or else of the first one found that is not thin.
  Penetration depth_at(double t) {
    const RelativePose pose = pose_at(t);
    if (const Penetration depth = of_pair(last_a_, last_b_, pose); depth.at_least > thin_) {
      normal_ = depth.normal;
      return depth;
    }
    for (std::size_t i = 0; i < a_.size(); ++i)
      for (std::size_t j = 0; j < b_.size(); ++j)
        if (const Penetration depth = of_pair(i, j, pose); depth.at_least > thin_) {
          last_a_ = i;
          last_b_ = j;
          normal_ = depth.normal;
          return depth;
        }
    return {};
  }

  /// By how much points of both can move against each other at most on a stretch of time, m/s.
  double speed(double t, double length) const {
    const FramePose a = path_a_.pose(t), b = path_b_.pose(t);
    const Rates of_a(path_a_, t, length), of_b(path_b_, t, length);
    const double linear = (a.v_WB - b.v_WB).norm() + std::abs(length) * (of_a.acceleration + of_b.acceleration);
    // points of b that matter are where a is
    const double near =
        b_[last_b_].is_half_space ? (a.p_WB - b.p_WB).norm() + std::abs(length) * linear + reach_a_ : b_[last_b_].reach;
    return linear + of_a.spin * a_[last_a_].reach + (of_b.spin > 0.0 ? of_b.spin * near : 0.0);
  }

  /// As long as what is so deep cannot be out; what is shallow, by how fast it gets so.
  double advanced(double t, const Penetration& depth) {
    double length = std::abs(to_ - t);
    if (stride_ > 0.0) length = std::min(length, 4.0 * stride_);
    for (;; length *= 0.5) {
      const double fastest = speed(t, forward_ * length);
      double step = depth.at_least / fastest;
      if (depth.at_least < kShallow * size_) step = std::max(step, shallow_step(t, length, depth, fastest));
      step = std::min(length, step);
      // a bound over a stretch much longer than the step is a bad one
      if (step < 0.25 * length && std::isfinite(length) && length > 1e-300) continue;
      stride_ = step;
      const double next = length >= std::abs(to_ - t) && step == length ? to_ : t + forward_ * step;
      return next == t ? std::nextafter(t, to_) : next;
    }
  }

  /// A part of the time in which the rate, or the acceleration, would lead out.
  double shallow_step(double t, double length, const Penetration& depth, double fastest) const {
    const FramePose a = path_a_.pose(t), b = path_b_.pose(t);
    const ConvexCore& core_b = b_[last_b_];
    const Vector3 n =
        b.R_WB * (core_b.is_half_space ? depth.normal
                                       : refined_touch(core_b, a_[last_a_], relative_pose(b, a), depth.normal).normal);
    const Vector3 p = a.point(support(a_[last_a_], -(a.R_WB.transpose() * n)).point);
    const double rate = std::abs(n.dot(a.velocity_at(p) - b.velocity_at(p)));
    const Rates of_a(path_a_, t, forward_ * length), of_b(path_b_, t, forward_ * length);
    const double bend = of_a.acceleration + of_b.acceleration + 2.0 * (of_a.spin + of_b.spin) * fastest;
    constexpr double kPart = 0.4;
    return kPart * std::min(depth.at_least / rate, std::sqrt(depth.at_least / bend));
  }

  bool is_clear(double t) const {
    const RelativePose pose = pose_at(t);
    for (std::size_t i = 0; i < a_.size(); ++i)
      for (std::size_t j = 0; j < b_.size(); ++j)
        if (!(of_pair(i, j, pose).at_most < -kClear * thin_)) return false;
    return true;
  }

  /// A time at which they touch, between one at which they overlap and one at which they are apart.
  double between(double inside, double apart) {
    for (;;) {
      const double middle = 0.5 * inside + 0.5 * apart;
      if (middle == inside || middle == apart) return apart;
      if (depth_at(middle).at_least > thin_) {
        inside = middle;
      } else if (is_clear(middle)) {
        apart = middle;
      } else {
        return middle;
      }
    }
  }

  Ahead look_ahead(double t) {
    const double rest = std::abs(to_ - t);
    constexpr double kLonger = 2.0;
    const double first = std::min(rest, kClear * thin_ / std::max(speed(t, forward_ * 1e-6 * rest), 1e-300));
    for (double step = first;; step *= kLonger) {
      const double next = step >= rest ? to_ : t + forward_ * step;
      const RelativePose pose = pose_at(next);
      bool is_clear = true;
      for (std::size_t i = 0; i < a_.size(); ++i)
        for (std::size_t j = 0; j < b_.size(); ++j) {
          const Penetration depth = of_pair(i, j, pose);
          if (depth.at_least > kClear * thin_) {
            last_a_ = i;
            last_b_ = j;
            return {Ahead::inside, next};
          }
          is_clear = is_clear && depth.at_most < -kClear * thin_;
        }
      if (is_clear) return {Ahead::apart, next};
      if (next == to_) return {Ahead::end, to_};
    }
  }

  void report(double t, double unknown) {
    const FramePose a = path_a_.pose(t), b = path_b_.pose(t);
    const ConvexCore &core_a = a_[last_a_], &core_b = b_[last_b_];
    const RelativePose pose = relative_pose(b, a);
    const Penetration depth = of_pair(last_a_, last_b_, pose);
    Vector3 n = depth.normal.isZero(0.0) ? pose.p_AB.stableNormalized() : depth.normal;
    if (!core_b.is_half_space) n = refined_touch(core_b, core_a, pose, n).normal;
    constexpr double kMargin = 1e-9;
    const ContactPatch patch = contact_patch(core_b, core_a, pose, n, kMargin * size_);
    TurningContact& c = parting_.contact;
    c.status = ContactStatus::hit;
    c.normal = b.R_WB * n;
    c.point = b.point(patch.point);
    if (patch.corners.size() > 1)
      for (const Vector3& p : patch.corners) c.points.push_back(b.point(p));
    c.feature_a = patch.of_b;
    c.feature_b = patch.of_a;
    c.gap_rate = std::max(0.0, c.normal.dot(a.velocity_at(c.point) - b.velocity_at(c.point)));
    // what the path shows as its depth is out at that rate
    const double left = std::clamp(-separation_along(core_b, core_a, pose, n), 0.0, 2.0 * thin_) / c.gap_rate;
    c.time = t;
    if (unknown == 0.0 && std::isfinite(left) && is_before(t + forward_ * left)) c.time = t + forward_ * left;
    c.time_resolution = unknown + 2.0 * kUnitRoundoff * (std::abs(t) + std::abs(path_a_.t0())) +
                        (std::isfinite(left) ? left : 0.0) + 0.01 * thin_ / std::max(c.gap_rate, 1e-300);
    c.time_error_bound = c.time_resolution + c.time_error(path_a_.point_error(reach_a_) + path_b_.point_error(size_));
    c.memory = {.axis = WitnessAxis{.kind = AxisKind::in_b, .direction = -n},
                .contact_time = c.time,
                .tolerance = 4.0 * thin_,
                .is_apart = true,
                .direction = -c.normal};
    parting_.piece_a = static_cast<int>(last_a_);
    parting_.piece_b = static_cast<int>(last_b_);
  }

  const ConvexPieces& a_;
  const ConvexPieces& b_;
  const FramePath& path_a_;
  const FramePath& path_b_;
  double from_;
  double to_;
  double forward_;
  double reach_a_ = 0.0;  // m
  double reach_b_ = 0.0;
  double size_ = 0.0;
  double thin_ = 0.0;       // m: such a depth cannot be told from touching
  double stride_ = 0.0;     // s, the last step
  std::size_t last_a_ = 0;  // the pair that overlaps
  std::size_t last_b_ = 0;
  Vector3 normal_ = Vector3::Zero();  // of it, in b, unit; zero at first
  Parting parting_{};
};

}  // namespace

Parting first_parting(const ConvexPieces& a, const FramePath& path_a, const ConvexPieces& b, const FramePath& path_b,
                      double from, double to, bool touches_at_start) {
  return PartingSearch(a, path_a, b, path_b, from, to).run(touches_at_start);
}

}  // namespace trajet
