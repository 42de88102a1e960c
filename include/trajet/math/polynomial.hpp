#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace trajet {

/// The highest degree of the polynomials whose roots are searched, and of power series: far above that of any Segment.
inline constexpr int kMaxPolynomialDegree = 80;

/// Half the distance from 1 to the next double: the relative error of one rounded operation.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// A function and its first two derivatives at one time.
struct Jet {
  double value;
  double rate;
  double curvature;
};

/// A Jet and the size of the terms whose rounding errors its value carries.
struct MeasuredJet {
  Jet jet;
  double magnitude;
};

/// sum_k coefficients[k] t^k, its first two derivatives and sum_k |coefficients[k]| |t|^k, by Horner's rule.
/// At least one coefficient.
inline MeasuredJet evaluate_polynomial(std::span<const double> coefficients, double t) {
  std::size_t k = coefficients.size() - 1;
  double value = coefficients[k];
  double rate = 0.0;
  double half_curvature = 0.0;
  double magnitude = std::abs(value);
  while (k-- > 0) {
    half_curvature = half_curvature * t + rate;
    rate = rate * t + value;
    value = value * t + coefficients[k];
    magnitude = magnitude * std::abs(t) + std::abs(coefficients[k]);
  }
  return {{value, rate, 2.0 * half_curvature}, magnitude};
}

/// sum_k |coefficients[k]| t^k: the size of the terms, whose rounding errors the sum carries. t >= 0.
inline double polynomial_magnitude(std::span<const double> coefficients, double t) {
  double sum = 0.0;
  for (std::size_t k = coefficients.size(); k-- > 0;) sum = sum * t + std::abs(coefficients[k]);
  return sum;
}

/// Replaces p(t) by p(begin + t), by repeated synthetic division.
inline void shift_polynomial(std::span<double> coefficients, double begin) {
  const std::size_t n = coefficients.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    for (std::size_t k = n - 1; k-- > i;) coefficients[k] += begin * coefficients[k + 1];
  }
}

}  // namespace trajet
