#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "trajet/math/polynomial.hpp"

namespace trajet {

/// A closed range of values.
struct Range {
  double lower;
  double upper;
};

namespace detail {

/// 1 / C(n, k) for all degrees that a BernsteinForm can have, rounded at most twice.  // (degree+1 x degree+1)
inline constexpr auto kInverseBinomials = [] {
  constexpr std::size_t kSize = kMaxPolynomialDegree + 1;
  std::array<std::array<double, kSize>, kSize> table{};
  // Pascal's rule on integers of up to 77 bits: high * 2^40 + low
  std::array<std::uint64_t, kSize> high{};
  std::array<std::uint64_t, kSize> low{1};
  for (std::size_t n = 0; n < kSize; ++n) {
    for (std::size_t k = n; k > 0; --k) {
      low[k] += low[k - 1];
      high[k] += high[k - 1] + (low[k] >> 40U);
      low[k] &= (std::uint64_t{1} << 40U) - 1;
    }
    for (std::size_t k = 0; k <= n; ++k)
      table[n][k] = 1.0 / (static_cast<double>(high[k]) * 0x1p40 + static_cast<double>(low[k]));
  }
  return table;
}();

}  // namespace detail

/// A polynomial on an interval by its Bernstein coefficients: p(begin + s (end - begin)) = sum_i b_i B_i^n(s), 0 <= s
/// <= 1.
///
/// The coefficients bound the polynomial: min b_i <= p <= max b_i on the interval, and their first and second
/// differences bound, up to positive factors n / |h| and n (n-1) / h^2, its first and second derivative [Farouki2012].
/// All bounds include the rounding errors, and those of the coefficients given: docs/design/bernstein_rounding.md
/// proves it.
///
/// Of fixed capacity, so that nothing is allocated. A form of a subinterval is made from the monomial coefficients, not
/// from the form of the interval: its rounding errors are then those of the terms' size there, which after long flights
/// is what counts.
class BernsteinForm {
 public:
  /// An empty form, to be assigned to.
  BernsteinForm() {}  // NOLINT(modernize-use-equals-default): leaves the coefficients uninitialised

  /// The polynomial sum_k coefficients[k] t^k for t between `begin` and `end`, which may be less than `begin`.
  /// At least one and at most kMaxPolynomialDegree + 1 coefficients. `coefficient_errors`: bounds of what is wrong with
  /// each of them; none: they are exact.
  BernsteinForm(std::span<const double> coefficients, double begin, double end,
                std::span<const double> coefficient_errors = {})
      : degree_(static_cast<int>(coefficients.size()) - 1) {
    assert(0 <= degree_ && degree_ <= kMaxPolynomialDegree);
    const double h = end - begin;
    std::array<double, kMaxPolynomialDegree + 1> difference;
    std::copy(coefficients.begin(), coefficients.end(), difference.begin());
    if (begin != 0.0) shift_polynomial(std::span(difference).first(coefficients.size()), begin);

    // p(begin + s h) = sum_k a_k s^k  and  Delta^k b_0 = a_k / C(n, k)
    const auto& inverse_binomial = detail::kInverseBinomials[static_cast<std::size_t>(degree_)];
    double power = 1.0;
    double magnitude = 0.0;
    for (int k = 0; k <= degree_; ++k) {
      const double a = at(difference, k) * power;
      magnitude += std::abs(a);
      at(difference, k) = a * at(inverse_binomial, k);
      power *= h;
    }
    if (begin != 0.0) magnitude = polynomial_magnitude(coefficients, std::abs(begin) + std::abs(h));
    // Delta^k b_{i+1} = Delta^k b_i + Delta^{k+1} b_i
    at(b_, 0) = difference[0];
    for (int i = 1; i <= degree_; ++i) {
      for (int k = 0; k <= degree_ - i; ++k) at(difference, k) += at(difference, k + 1);
      at(b_, i) = difference[0];
    }
    rounding_ = kUnitRoundoff * magnitude;
    error_ = roundings(degree_) * rounding_;
    if (!coefficient_errors.empty()) error_ += polynomial_magnitude(coefficient_errors, std::abs(begin) + std::abs(h));
  }

  int degree() const { return degree_; }
  double coefficient(int i) const { return at(b_, i); }
  /// Bound of the error of each coefficient.
  double error() const { return error_; }

  /// The roundings that the terms of a coefficient pass, at most 4n + 1, and two that pay for the rounding of the
  /// bound.
  static constexpr double roundings(int degree) { return 4.0 * degree + 3.0; }

  /// Encloses the polynomial on the interval. `input_roundings`: how often each coefficient that was given is rounded
  /// already.
  Range value_range(int input_roundings = 0) const {
    const auto [lower, upper] = std::minmax_element(b_.begin(), b_.begin() + degree_ + 1);
    const double error = error_ + input_roundings * rounding_;
    return {*lower - error, *upper + error};
  }

  /// Encloses the first derivative with respect to s on the interval: |h| times the rate, in the direction of travel.
  Range first_difference_range() const {
    if (degree_ < 1) return {0.0, 0.0};
    Range d{kInfinity, -kInfinity};
    for (int i = 0; i < degree_; ++i) extend(d, at(b_, i + 1) - at(b_, i));
    return scaled(d, degree_, 2.0 * difference_error());
  }

  /// Whether the second differences are small: rounding errors spoil them.
  bool is_nearly_straight() const {
    constexpr double kSmall = 4096.0;  // times the error of a coefficient, of which they carry four
    double largest = 0.0;
    for (int i = 0; i + 1 < degree_; ++i)
      largest = std::max(largest, std::abs((at(b_, i + 2) - at(b_, i + 1)) - (at(b_, i + 1) - at(b_, i))));
    return largest <= kSmall * error_;
  }

  /// Encloses the second derivative with respect to s on the interval: h^2 times the second derivative in time.
  Range second_difference_range() const {
    if (degree_ < 2) return {0.0, 0.0};
    Range d{kInfinity, -kInfinity};
    for (int i = 0; i + 1 < degree_; ++i) extend(d, (at(b_, i + 2) - at(b_, i + 1)) - (at(b_, i + 1) - at(b_, i)));
    return scaled(d, degree_ * (degree_ - 1.0), 4.0 * difference_error());
  }

 private:
  using Array = std::array<double, kMaxPolynomialDegree + 1>;
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  static double& at(Array& array, int i) { return array[static_cast<std::size_t>(i)]; }
  static const double& at(const Array& array, int i) { return array[static_cast<std::size_t>(i)]; }
  static void extend(Range& range, double x) {
    range.lower = std::min(range.lower, x);
    range.upper = std::max(range.upper, x);
  }
  /// What each coefficient adds to the error of a difference, whose own roundings and those of `scaled` are paid too.
  double difference_error() const { return error_ + 3.0 * rounding_; }
  static Range scaled(const Range& range, double factor, double error) {
    return {factor * (range.lower - error), factor * (range.upper + error)};
  }

  int degree_ = 0;
  double error_ = 0.0;
  double rounding_ = 0.0;  // one rounding of all terms
  Array b_;
};

}  // namespace trajet
