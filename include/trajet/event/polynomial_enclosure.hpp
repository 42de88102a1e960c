#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "trajet/math/bernstein.hpp"
#include "trajet/math/interval.hpp"
#include "trajet/portable.hpp"

namespace trajet {

namespace detail {

/// Turns the coefficients of a polynomial into those of its derivative; a constant's is one zero.
inline std::span<double> differentiate(std::span<double> coefficients) {
  for (std::size_t k = 1; k < coefficients.size(); ++k) coefficients[k - 1] = static_cast<double>(k) * coefficients[k];
  if (coefficients.size() > 1) return coefficients.first(coefficients.size() - 1);
  coefficients[0] = 0.0;
  return coefficients;
}

inline Interval interval(const Range& r) { return {r.lower, r.upper}; }

}  // namespace detail

/// Encloses a polynomial in tau and its derivatives between two tau.
inline IntervalJet enclose_polynomial(std::span<const double> coefficients, double from, double to) {
  const BernsteinForm form(coefficients, from, to);
  const Interval h = Interval(to) - Interval(from);
  IntervalJet x(detail::interval(form.value_range()));
  if (form.is_nearly_straight()) {
    // differences of rounded coefficients over a short time say little of the derivatives
    std::array<double, kMaxPolynomialDegree + 1> derivative;
    ranges::copy(coefficients, derivative.begin());
    std::span<double> d(derivative.data(), coefficients.size());
    for (const int order : {1, 2}) {
      d = detail::differentiate(d);
      // each differentiation rounds the coefficients once
      x[order] = detail::interval(BernsteinForm(d, from, to).value_range(order)) / static_cast<double>(order);
    }
    return x;
  }
  x[1] = detail::interval(form.first_difference_range()) / h;
  x[2] = detail::interval(form.second_difference_range()) / (2.0 * square(h));
  return x;
}

/// Encloses a polynomial at one tau, whose rounding error is the width of the value. Of the derivatives it has numbers.
inline IntervalJet enclose_polynomial(std::span<const double> coefficients, double tau) {
  const MeasuredJet m = evaluate_polynomial(coefficients, tau);
  const auto degree = static_cast<int>(coefficients.size()) - 1;
  const double error = BernsteinForm::roundings(degree) * kUnitRoundoff * m.magnitude;
  IntervalJet x(Interval(m.jet.value - error, m.jet.value + error));
  x[1] = m.jet.rate;
  x[2] = 0.5 * m.jet.curvature;
  return x;
}

}  // namespace trajet
