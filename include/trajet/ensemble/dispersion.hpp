#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "trajet/math/vector.hpp"

namespace trajet {

/// Mean and spread of numbers, updated one by one (Welford 1962).
class RunningStatistics {
 public:
  void add(double value);

  std::uint64_t count() const { return count_; }
  double mean() const { return mean_; }
  /// Standard deviation of the population that they are a sample of; not-a-number of fewer than two.
  double deviation() const;
  double min() const { return min_; }
  double max() const { return max_; }

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0.0, squares_ = 0.0;
  double min_ = 0.0, max_ = 0.0;
};

/// Calls its argument with each of some points, in any order, as often as it is called itself.
using PointSource = std::function<void(const std::function<void(const Vector3&)>&)>;

/// How points on a target scatter.
struct Dispersion {
  /// A share of the points lies within this distance.
  struct Circle {
    double share = 0.0;
    double radius = 0.0;           ///< m, empirical
    std::array<double, 2> ci95{};  ///< of the true one, by ranks: whatever the distribution
  };

  std::uint64_t count = 0;
  Vector3 mean = Vector3::Zero();  ///< m
  Vector3 major = Vector3::Zero(),
          minor = Vector3::Zero();  ///< unit axes of the ellipse, across the direction of least spread
  double major_deviation = 0.0, minor_deviation = 0.0;  ///< standard deviations along them, m
  std::array<Circle, 3> about_mean{};                   ///< CEP 50, 90 and 95 %
};

/// Goes through the points a few times, and keeps none of them.
Dispersion dispersion(const PointSource& source);

/// The shares of points whose circles Dispersion has.
inline constexpr std::array<double, 3> kCircleShares{0.5, 0.9, 0.95};

/// Of the points' distances from a centre.
std::array<Dispersion::Circle, 3> circles_about(const Vector3& center, std::uint64_t count, const PointSource& source);

}  // namespace trajet
