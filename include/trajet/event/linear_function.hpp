#pragma once

#include <array>
#include <cmath>
#include <span>

#include "trajet/event/path.hpp"
#include "trajet/math/polynomial.hpp"
#include "trajet/math/roots.hpp"

namespace trajet {

/// offset + sum_i weights[i] x_i(tau) along a Path: again a polynomial, so that its roots are found on the fast way.
///
/// Its coefficients are sums that may have cancelled. What rounding has left of them is known, and enters every bound.
class LinearFunction {
 public:
  /// `offset_error`: bound of the rounding of `offset`.
  template <int Count, class Weights>
  LinearFunction(const Path<Count>& path, const Weights& weights, double offset, double offset_error)
      : size_(static_cast<std::size_t>(path.degree()) + 1) {
    // A term passes its product, at most count sums, and the first coefficient's that of the offset.
    const double rounding = (path.count() + 1.0) * kUnitRoundoff;
    for (std::size_t k = 0; k < size_; ++k) coefficients_[k] = errors_[k] = 0.0;
    for (int i = 0; i < path.count(); ++i) {
      const std::span<const double> component = path.coefficients(i);
      for (std::size_t k = 0; k < size_; ++k) {
        const double term = weights[i] * component[k];
        coefficients_[k] += term;
        errors_[k] += rounding * std::abs(term);
      }
    }
    coefficients_[0] += offset;
    errors_[0] += kUnitRoundoff * std::abs(coefficients_[0]) + offset_error;
  }

  std::span<const double> coefficients() const { return {coefficients_.data(), size_}; }

  /// The function between two tau. Refers to this object. See PolynomialFunction for `touch_tolerance`.
  PolynomialFunction between(double from, double to, double touch_tolerance = 0.0) const {
    return {coefficients(), from, to, touch_tolerance, {errors_.data(), size_}};
  }

 private:
  std::size_t size_;
  std::array<double, kMaxPolynomialDegree + 1> coefficients_;
  std::array<double, kMaxPolynomialDegree + 1> errors_;
};

}  // namespace trajet
