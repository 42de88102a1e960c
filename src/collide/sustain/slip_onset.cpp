#include "slip_onset.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace trajet {
namespace {

using Wrench = Eigen::Vector3d;
using Square = Eigen::Matrix3d;

/// The wrench less the friction of the accelerations to which it leads, with a creep; and its derivative.
struct Residual {
  Wrench value;
  Square derivative;
};

Residual residual_of(const std::vector<OnsetPoint>& points, double coefficient, double creep, const Wrench& wrench) {
  Residual r{wrench, Square::Identity()};
  for (const OnsetPoint& point : points) {
    const Eigen::Vector2d rate = point.free + point.by_wrench * wrench;
    const double normal = point.normal + point.normal_by_wrench * wrench;
    if (!(normal > 0.0)) continue;
    const double size = std::sqrt(rate.squaredNorm() + creep * creep);
    const Eigen::Vector2d direction = rate / size;
    const Eigen::Matrix2d turned = (Eigen::Matrix2d::Identity() - direction * direction.transpose()) / size;
    r.value += coefficient * normal * (point.share.transpose() * direction);
    r.derivative += coefficient * (point.share.transpose() *
                                   (direction * point.normal_by_wrench + normal * (turned * point.by_wrench)));
  }
  return r;
}

/// Newton's method with shortened steps; false if it does not come to zero.
bool solve(const std::vector<OnsetPoint>& points, double coefficient, double creep, double scale, Wrench& wrench) {
  constexpr int kSteps = 60, kShorter = 40;
  constexpr double kZero = 1e-13;
  Residual r = residual_of(points, coefficient, creep, wrench);
  for (int step = 0; step < kSteps; ++step) {
    const double size = r.value.norm();
    if (size <= kZero * scale) return true;
    const Wrench change = r.derivative.fullPivLu().solve(r.value);
    double part = 1.0;
    for (int i = 0; i < kShorter; ++i, part *= 0.5) {
      const Wrench tried = wrench - part * change;
      const Residual at = residual_of(points, coefficient, creep, tried);
      if (at.value.norm() < size) {
        wrench = tried;
        r = at;
        break;
      }
    }
    if (r.value.norm() == size) break;
  }
  constexpr double kNearZero = 1e-5;  // where points hold, rounding of their rates shows in their friction
  return r.value.norm() <= kNearZero * scale;
}

}  // namespace

bool SlipOnset::hold_all() const {
  return std::all_of(holds.begin(), holds.end(), [](bool each) { return each; });
}

SlipOnset find_onset(const std::vector<OnsetPoint>& points, double coefficient) {
  SlipOnset onset;
  double scale = 0.0, load = 0.0;
  for (const OnsetPoint& point : points) {
    scale = std::max(scale, point.free.norm());
    load += coefficient * std::abs(point.normal) * point.share.norm();
  }
  Wrench wrench = Wrench::Zero();
  constexpr double kFirst = 16.0, kLess = 0.25, kHardlyLess = 0.999, kLast = 1e-9, kHolds = 1e3;
  onset.creep = kLast * scale;
  onset.is_found = scale == 0.0;
  // from large creep to small, in smaller steps where Newton's method does not follow
  double ratio = kLess;
  for (double solved = kFirst / kLess * scale; !onset.is_found && ratio < kHardlyLess;) {
    const double creep = std::max(ratio * solved, onset.creep);
    Wrench tried = wrench;
    if (!solve(points, coefficient, creep, load, tried)) {
      ratio = std::sqrt(ratio);
      continue;
    }
    wrench = tried;
    solved = creep;
    ratio = std::max(kLess, ratio * ratio);
    onset.is_found = creep == onset.creep;
  }
  for (const OnsetPoint& point : points) {
    onset.rates.emplace_back(point.free + point.by_wrench * wrench);
    onset.holds.push_back(onset.rates.back().norm() <= kHolds * onset.creep);
  }
  return onset;
}

}  // namespace trajet
