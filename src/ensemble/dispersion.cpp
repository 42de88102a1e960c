#include "trajet/ensemble/dispersion.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "trajet/ensemble/distribution.hpp"
#include "trajet/ensemble/quantiles.hpp"

namespace trajet {

void RunningStatistics::add(double value) {
  ++count_;
  const double from_mean = value - mean_;
  mean_ += from_mean / static_cast<double>(count_);
  squares_ += from_mean * (value - mean_);
  min_ = count_ == 1 ? value : std::min(min_, value);
  max_ = count_ == 1 ? value : std::max(max_, value);
}

double RunningStatistics::deviation() const {
  if (count_ < 2) return std::numeric_limits<double>::quiet_NaN();
  return std::sqrt(squares_ / static_cast<double>(count_ - 1));
}

namespace {

/// The share of a sample's ranks below which its quantile of share `p` lies with the probability that `z` standard
/// deviations have: ranks of a sample are binomial.
double rank_share(double p, double z, std::uint64_t count) {
  const auto n = static_cast<double>(count);
  const double rank = n * p + z * std::sqrt(n * p * (1.0 - p));
  return std::clamp(rank / std::max(n - 1.0, 1.0), 0.0, 1.0);
}

}  // namespace

std::array<Dispersion::Circle, 3> circles_about(const Vector3& center, std::uint64_t count, const PointSource& source) {
  const double z = normal_quantile(0.975);
  std::vector<double> shares;
  for (const double p : kCircleShares) {
    shares.push_back(p);
    shares.push_back(rank_share(p, -z, count));
    shares.push_back(rank_share(p, z, count));
  }
  const std::vector<double> radii = quantiles(
      [&](const std::function<void(double)>& use) {
        source([&](const Vector3& point) { use((point - center).norm()); });
      },
      count, shares);
  std::array<Dispersion::Circle, 3> circles;
  for (std::size_t i = 0; i < circles.size(); ++i)
    circles[i] = {kCircleShares[i], radii[3 * i], {radii[3 * i + 1], radii[3 * i + 2]}};
  return circles;
}

Dispersion dispersion(const PointSource& source) {
  Dispersion result;
  Matrix3 squares = Matrix3::Zero();
  source([&](const Vector3& point) {
    ++result.count;
    const Vector3 from_mean = point - result.mean;
    result.mean += from_mean / static_cast<double>(result.count);
    squares += from_mean * (point - result.mean).transpose();
  });
  if (result.count < 2) return result;
  const Matrix3 covariance = 0.5 * (squares + squares.transpose()) / static_cast<double>(result.count - 1);
  const Eigen::SelfAdjointEigenSolver<Matrix3> axes(covariance);  // in the order of their spread
  result.major = axes.eigenvectors().col(2);
  result.minor = axes.eigenvectors().col(1);
  result.major_deviation = std::sqrt(std::max(axes.eigenvalues()[2], 0.0));
  result.minor_deviation = std::sqrt(std::max(axes.eigenvalues()[1], 0.0));
  result.about_mean = circles_about(result.mean, result.count, source);
  return result;
}

}  // namespace trajet
