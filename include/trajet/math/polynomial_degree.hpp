#pragma once

#include <algorithm>
#include <limits>

#include "trajet/math/number.hpp"
#include "trajet/math/number_traits.hpp"

namespace trajet {

/// A number type that computes no value but the degree in time: what a law makes of polynomials.
///
/// A law evaluated on it tells whether all its solutions are polynomials, and of which degree, so that a power series
/// is known to end rather than seen to have small coefficients. Anything that is not + - * of polynomials, or a
/// quotient by a constant, has no degree; so has whatever depends on a comparison.
class PolynomialDegree {
 public:
  static constexpr int kNone = std::numeric_limits<int>::max();

  constexpr PolynomialDegree() = default;
  /// A constant.
  constexpr PolynomialDegree(double) {}  // NOLINT(google-explicit-constructor)
  static constexpr PolynomialDegree of(int degree) {
    PolynomialDegree d;
    d.degree_ = degree;
    return d;
  }

  /// kNone where the function is not known to be a polynomial.
  constexpr int degree() const { return degree_; }

  PolynomialDegree& operator+=(PolynomialDegree b) { return *this = *this + b; }
  PolynomialDegree& operator-=(PolynomialDegree b) { return *this = *this - b; }
  PolynomialDegree& operator*=(PolynomialDegree b) { return *this = *this * b; }
  PolynomialDegree& operator/=(PolynomialDegree b) { return *this = *this / b; }
  friend PolynomialDegree operator-(PolynomialDegree a) { return a; }
  friend PolynomialDegree operator+(PolynomialDegree a, PolynomialDegree b) {
    return of(std::max(a.degree_, b.degree_));
  }
  friend PolynomialDegree operator-(PolynomialDegree a, PolynomialDegree b) { return a + b; }
  friend PolynomialDegree operator*(PolynomialDegree a, PolynomialDegree b) {
    return of(a.degree_ == kNone || b.degree_ == kNone ? kNone : a.degree_ + b.degree_);
  }
  friend PolynomialDegree operator/(PolynomialDegree a, PolynomialDegree b) { return b.degree_ == 0 ? a : of(kNone); }

  /// A function other than a polynomial: of constants, a constant.
  static PolynomialDegree transcendental(PolynomialDegree a) { return of(a.degree_ == 0 ? 0 : kNone); }

 private:
  int degree_ = 0;
};

/// The answer to a comparison of two PolynomialDegrees: known only between constants, which a law need not tell.
/// As a bool it is false, and what a law computes behind an `if` is then one branch of several: `LawExpansion` sees to
/// that by never calling a law polynomial whose comparisons it has met.
struct DegreeComparison {
  explicit operator bool() const {
    met = true;
    return false;
  }
  static inline thread_local bool met = false;
};

inline DegreeComparison operator<(PolynomialDegree, PolynomialDegree) { return {}; }
inline DegreeComparison operator<=(PolynomialDegree, PolynomialDegree) { return {}; }
inline DegreeComparison operator>(PolynomialDegree, PolynomialDegree) { return {}; }
inline DegreeComparison operator>=(PolynomialDegree, PolynomialDegree) { return {}; }
inline DegreeComparison operator==(PolynomialDegree, PolynomialDegree) { return {}; }
inline DegreeComparison operator!=(PolynomialDegree, PolynomialDegree) { return {}; }
inline DegreeComparison less(PolynomialDegree, PolynomialDegree) { return {}; }
inline DegreeComparison less_equal(PolynomialDegree, PolynomialDegree) { return {}; }
inline DegreeComparison equal(PolynomialDegree, PolynomialDegree) { return {}; }
inline PolynomialDegree where(DegreeComparison, PolynomialDegree, PolynomialDegree) {
  return PolynomialDegree::of(PolynomialDegree::kNone);
}

#define TRAJET_NO_DEGREE(function) \
  inline PolynomialDegree function(PolynomialDegree x) { return PolynomialDegree::transcendental(x); }
TRAJET_NO_DEGREE(sqrt)
TRAJET_NO_DEGREE(cbrt)
TRAJET_NO_DEGREE(exp)
TRAJET_NO_DEGREE(log)
TRAJET_NO_DEGREE(log10)
TRAJET_NO_DEGREE(sin)
TRAJET_NO_DEGREE(cos)
TRAJET_NO_DEGREE(tan)
TRAJET_NO_DEGREE(asin)
TRAJET_NO_DEGREE(acos)
TRAJET_NO_DEGREE(atan)
TRAJET_NO_DEGREE(sinh)
TRAJET_NO_DEGREE(cosh)
TRAJET_NO_DEGREE(tanh)
TRAJET_NO_DEGREE(abs)
TRAJET_NO_DEGREE(sign)
TRAJET_NO_DEGREE(floor)
#undef TRAJET_NO_DEGREE
inline PolynomialDegree square(PolynomialDegree x) { return x * x; }
inline PolynomialDegree atan2(PolynomialDegree y, PolynomialDegree x) {
  return PolynomialDegree::transcendental(y + x);
}
inline PolynomialDegree min(PolynomialDegree a, PolynomialDegree b) { return PolynomialDegree::transcendental(a + b); }
inline PolynomialDegree max(PolynomialDegree a, PolynomialDegree b) { return PolynomialDegree::transcendental(a + b); }
inline PolynomialDegree pow(PolynomialDegree x, PolynomialDegree y) { return PolynomialDegree::transcendental(x + y); }
inline PolynomialDegree norm3(PolynomialDegree x, PolynomialDegree y, PolynomialDegree z) {
  return PolynomialDegree::transcendental(x + y + z);
}

}  // namespace trajet

template <>
struct Eigen::NumTraits<trajet::PolynomialDegree> : trajet::NumberTraits<trajet::PolynomialDegree, 1, 1, 1> {};
