#pragma once

#include <array>
#include <cmath>
#include <span>

#include "trajet/event/path.hpp"
#include "trajet/event/polynomial_enclosure.hpp"
#include "trajet/math/vector.hpp"

namespace trajet::detail {

/// A coordinate of a point along a path, in a frame that does not move: direction . (x - origin), again a polynomial.
class Coordinate {
 public:
  Coordinate() {}  // NOLINT(modernize-use-equals-default): to be assigned to
  Coordinate(const PointPath& path, const Vector3& direction, const Vector3& origin)
      : size_(static_cast<std::size_t>(path.degree()) + 1) {
    double magnitude = 0.0;
    for (std::size_t k = 0; k < size_; ++k) {
      double sum = 0.0;
      for (int i = 0; i < 3; ++i) {
        const double coefficient = path.coefficients(i)[k];
        sum += direction[i] * (k == 0 ? coefficient - origin[i] : coefficient);
      }
      coefficients_[k] = sum;
    }
    for (int i = 0; i < 3; ++i)
      magnitude += std::abs(direction[i]) * (std::abs(path.coefficients(i)[0]) + std::abs(origin[i]));
    // three differences, products and sums; the other coefficients' errors are of the size that enclosures allow for
    constexpr double kRoundings = 8.0;
    rounding_ = kRoundings * kUnitRoundoff * magnitude;
  }

  IntervalJet between(double from, double to) const { return widened(enclose_polynomial(coefficients(), from, to)); }
  IntervalJet at(double tau) const { return widened(enclose_polynomial(coefficients(), tau)); }

 private:
  std::span<const double> coefficients() const { return {coefficients_.data(), size_}; }
  IntervalJet widened(IntervalJet x) const {
    x[0] += Interval(-rounding_, rounding_);
    return x;
  }

  std::size_t size_ = 0;
  std::array<double, kMaxPolynomialDegree + 1> coefficients_;
  double rounding_ = 0.0;
};

}  // namespace trajet::detail
