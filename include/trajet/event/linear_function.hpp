#pragma once

#include <array>
#include <cmath>
#include <span>

#include "trajet/event/path.hpp"
#include "trajet/math/polynomial.hpp"
#include "trajet/math/roots.hpp"

namespace trajet {

/// offset + sum_i weights[i] x_i(tau) along a Path: again a polynomial, so that its roots are found on the fast way.
class LinearFunction {
 public:
  template <int Count, class Weights>
  LinearFunction(const Path<Count>& path, const Weights& weights, double offset)
      : size_(static_cast<std::size_t>(path.degree()) + 1) {
    double magnitude = std::abs(offset);
    for (std::size_t k = 0; k < size_; ++k) coefficients_[k] = 0.0;
    for (int i = 0; i < path.count(); ++i) {
      const std::span<const double> component = path.coefficients(i);
      for (std::size_t k = 0; k < size_; ++k) coefficients_[k] += weights[i] * component[k];
      magnitude += std::abs(weights[i] * component[0]);
    }
    coefficients_[0] += offset;
    // The constant coefficient may have cancelled: count + 1 products and sums, and as much again in making the offset.
    rounding_ = 2.0 * (path.count() + 1.0) * kUnitRoundoff * magnitude;
  }

  std::span<const double> coefficients() const { return {coefficients_.data(), size_}; }

  /// The function between two tau. Refers to this object. See PolynomialFunction for `touch_tolerance`.
  PolynomialFunction between(double from, double to, double touch_tolerance = 0.0) const {
    return {coefficients(), from, to, std::max(touch_tolerance, 3.0 * rounding_)};
  }

 private:
  std::size_t size_;
  std::array<double, kMaxPolynomialDegree + 1> coefficients_;
  double rounding_;
};

}  // namespace trajet
