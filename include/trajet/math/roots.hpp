#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>

#include "trajet/math/bernstein.hpp"
#include "trajet/math/polynomial.hpp"
#include "trajet/math/root_search.hpp"

namespace trajet {

/// sum_k coefficients[k] t^k between `begin` and `end`, as a function whose roots can be searched. Refers to the
/// spans it is given.
class PolynomialFunction {
 public:
  using Piece = BernsteinForm;

  /// `touch_tolerance` (unit of the value, >= 0): values as small count as zero; what rounding needs is added.
  /// `coefficient_errors`: bounds of what is wrong with each coefficient; none: they are exact.
  /// Throws std::length_error for a degree above kMaxPolynomialDegree, std::domain_error for no coefficient at all.
  PolynomialFunction(std::span<const double> coefficients, double begin, double end, double touch_tolerance,
                     std::span<const double> coefficient_errors = {})
      : coefficients_(coefficients),
        coefficient_errors_(coefficient_errors),
        begin_(begin),
        end_(end),
        touch_tolerance_(touch_tolerance) {
    if (coefficients_.empty()) throw std::domain_error("a polynomial needs a coefficient");
    while (coefficients_.size() > 1 && coefficients_.back() == 0.0) {
      coefficients_ = coefficients_.first(coefficients_.size() - 1);
    }
    if (coefficients_.size() > kMaxPolynomialDegree + 1) throw std::length_error("polynomial of too high a degree");
  }

  double begin() const { return begin_; }
  double end() const { return end_; }

  BernsteinForm piece(double from, double to) const { return {coefficients_, from, to, coefficient_errors_}; }
  Range value_range(const BernsteinForm& piece) const { return piece.value_range(); }
  Range rate_range(const BernsteinForm& piece) const { return piece.first_difference_range(); }
  Range curvature_range(const BernsteinForm& piece) const { return piece.second_difference_range(); }
  FunctionSample at(double t) const {
    const MeasuredJet at_t = evaluate_polynomial(coefficients_, t);
    const double size = kUnitRoundoff * at_t.magnitude;
    const double given = polynomial_magnitude(coefficient_errors_, std::abs(t));
    // Horner's rule rounds 2n times; a value that is not finite must not look like a touch.
    return {at_t.jet, 2.0 * degree() * size + given,
            std::max(3.0 * (BernsteinForm::roundings(degree()) * size + given), touch_tolerance_)};
  }

 private:
  int degree() const { return static_cast<int>(coefficients_.size()) - 1; }

  std::span<const double> coefficients_;
  std::span<const double> coefficient_errors_;
  double begin_;
  double end_;
  double touch_tolerance_;
};

/// Visits the roots of sum_k coefficients[k] t^k for t from `begin` to `end`, both included, in that order.
///
/// `touch_tolerance`: values as small count as zero; what rounding needs is added. A polynomial that is not finite
/// gives one root of kind `unresolved`. `visit(const Root&) -> bool` returns whether to go on. See the general
/// `visit_roots`.
template <class Visitor>
SearchStatus visit_roots(std::span<const double> coefficients, double begin, double end, double touch_tolerance,
                         Visitor&& visit) {
  return visit_roots(PolynomialFunction(coefficients, begin, end, touch_tolerance), visit);
}

/// The first crossing of sum_k coefficients[k] t^k behind `begin`, up to and including `end`, or nothing.
///
/// A root at `begin` itself is left behind, touches are passed over. A crossing that cannot be shown to be absent is
/// returned as a root of kind `unresolved`.
inline std::optional<Root> first_root(std::span<const double> coefficients, double begin, double end) {
  std::optional<Root> first;
  visit_roots(coefficients, begin, end, 0.0, [&](const Root& root) {
    if (root.at_begin || root.kind == RootKind::touch) return true;
    first = root;
    return false;
  });
  return first;
}

}  // namespace trajet
