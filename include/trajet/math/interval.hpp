#pragma once

#include <algorithm>
#include <boost/numeric/interval.hpp>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>

#include "trajet/math/number_traits.hpp"
#include "trajet/math/polynomial.hpp"
#include "trajet/math/series.hpp"

namespace trajet {

namespace detail {

/// Just above half an ulp of 1: x - kHalfUlp |x|, rounded, is below every real number that rounds to x [Rump2009],
/// unless x is so small that results underflow.
inline constexpr double kHalfUlp = kUnitRoundoff * (1.0 + 0x1p-52);

/// A double that is certainly below all real numbers that differ from x by at most `ulps` halves of an ulp.
inline double next_below(double x, double ulps = 1.0) {
  // Far below, the error of an underflow; far above the subnormal numbers, with which processors are slow.
  constexpr double kTiny = 0x1p-900;
  // inf - inf: an overflow, whose lower bound is the largest double
  if (x == std::numeric_limits<double>::infinity()) return std::numeric_limits<double>::max();
  return std::abs(x) < kTiny ? x - kTiny : x - ulps * kHalfUlp * std::abs(x);
}
inline double next_above(double x, double ulps = 1.0) { return -next_below(-x, ulps); }

/// Outward rounding for boost::numeric::interval without touching the processor's rounding mode: operations round to
/// nearest, and each result is then moved outward by an ulp. The rounding mode would be slow to switch, and compilers
/// move arithmetic across the switch.
class OutwardRounding {
 public:
  using unprotected_rounding = OutwardRounding;

  template <class Number>
  double conv_down(Number x) const {
    return static_cast<double>(x);
  }
  template <class Number>
  double conv_up(Number x) const {
    return static_cast<double>(x);
  }
  double add_down(double a, double b) const { return sum_below(a + b); }
  double add_up(double a, double b) const { return -sum_below(-a - b); }
  double sub_down(double a, double b) const { return sum_below(a - b); }
  double sub_up(double a, double b) const { return -sum_below(b - a); }
  double mul_down(double a, double b) const { return a == 0.0 || b == 0.0 ? 0.0 : next_below(a * b); }
  double mul_up(double a, double b) const { return a == 0.0 || b == 0.0 ? 0.0 : next_above(a * b); }
  double div_down(double a, double b) const { return a == 0.0 ? 0.0 : next_below(a / b); }
  double div_up(double a, double b) const { return a == 0.0 ? 0.0 : next_above(a / b); }
  double sqrt_down(double x) const { return std::max(0.0, next_below(std::sqrt(x))); }
  double sqrt_up(double x) const { return next_above(std::sqrt(x)); }
  double int_down(double x) const { return std::floor(x); }
  double int_up(double x) const { return std::ceil(x); }
  double median(double a, double b) const { return 0.5 * a + 0.5 * b; }

  double exp_down(double x) const { return std::max(0.0, below(std::exp(x))); }
  double exp_up(double x) const { return above(std::exp(x)); }
  double log_down(double x) const { return below(std::log(x)); }
  double log_up(double x) const { return above(std::log(x)); }
  double sin_down(double x) const { return below(std::sin(x)); }
  double sin_up(double x) const { return above(std::sin(x)); }
  double cos_down(double x) const { return below(std::cos(x)); }
  double cos_up(double x) const { return above(std::cos(x)); }
  double tan_down(double x) const { return below(std::tan(x)); }
  double tan_up(double x) const { return above(std::tan(x)); }
  double asin_down(double x) const { return below(std::asin(x)); }
  double asin_up(double x) const { return above(std::asin(x)); }
  double acos_down(double x) const { return below(std::acos(x)); }
  double acos_up(double x) const { return above(std::acos(x)); }
  double atan_down(double x) const { return below(std::atan(x)); }
  double atan_up(double x) const { return above(std::atan(x)); }
  double sinh_down(double x) const { return below(std::sinh(x)); }
  double sinh_up(double x) const { return above(std::sinh(x)); }
  double cosh_down(double x) const { return below(std::cosh(x)); }
  double cosh_up(double x) const { return above(std::cosh(x)); }
  double tanh_down(double x) const { return below(std::tanh(x)); }
  double tanh_up(double x) const { return above(std::tanh(x)); }

 private:
  /// Sums do not underflow: where they are small they are exact.
  static double sum_below(double x) {
    if (x == std::numeric_limits<double>::infinity()) return std::numeric_limits<double>::max();
    return x - kHalfUlp * std::abs(x);
  }

  // glibc states at most 2 ulp for these functions; C libraries in use stay below 4.
  static constexpr double kFunctionUlps = 8.0;
  static double below(double x) { return next_below(x, kFunctionUlps); }
  static double above(double x) { return next_above(x, kFunctionUlps); }
};

}  // namespace detail

/// In this namespace, so that its functions of Intervals are found beside the type.
struct IntervalPolicies {
  using rounding = detail::OutwardRounding;
  using checking = boost::numeric::interval_lib::checking_base<double>;
};

/// A closed interval of real numbers that certainly encloses the result of every operation on all its members.
/// Not-a-number, or a function outside its domain, gives an empty interval, whose bounds are not-a-number.
using Interval = boost::numeric::interval<double, IntervalPolicies>;

/// The answer to a comparison of Intervals.
enum class Decision { no, yes, undecided };

inline Decision decide(bool is_certain, bool is_impossible) {
  return is_certain ? Decision::yes : is_impossible ? Decision::no : Decision::undecided;
}

inline Decision less(const Interval& a, const Interval& b) {
  return decide(a.upper() < b.lower(), a.lower() >= b.upper());
}
inline Decision less_equal(const Interval& a, const Interval& b) {
  return decide(a.upper() <= b.lower(), a.lower() > b.upper());
}
inline Decision equal(const Interval& a, const Interval& b) {
  return decide(singleton(a) && singleton(b) && a.lower() == b.lower(), a.upper() < b.lower() || a.lower() > b.upper());
}

/// `a` where the condition holds, `b` where it fails, the hull of both where it is undecided, empty where one of them
/// is.
inline Interval where(Decision condition, const Interval& a, const Interval& b) {
  if (condition != Decision::undecided) return condition == Decision::yes ? a : b;
  return empty(a) || empty(b) ? Interval::empty() : hull(a, b);
}

inline Interval sign(const Interval& x) { return {sign(x.lower()), sign(x.upper())}; }
inline Interval floor(const Interval& x) { return {std::floor(x.lower()), std::floor(x.upper())}; }

inline Interval cbrt(const Interval& x) {
  return {detail::next_below(std::cbrt(x.lower()), 8.0), detail::next_above(std::cbrt(x.upper()), 8.0)};
}

inline Interval norm3(const Interval& x, const Interval& y, const Interval& z) {
  return sqrt(square(x) + square(y) + square(z));
}

/// x^y = exp(y log x), x >= 0
inline Interval pow(const Interval& x, const Interval& y) { return exp(y * log(x)); }

/// Angle of (x, y) in [-pi, pi]. Where the box touches the cut behind the origin, the whole range.
inline Interval atan2(const Interval& y, const Interval& x) {
  if (x.lower() <= 0.0 && zero_in(y)) {
    const double pi_above = detail::next_above(std::numbers::pi);
    return {-pi_above, pi_above};
  }
  // Without the cut the angle is monotone along every side of the box: its bounds are at corners.
  const auto corners = {std::atan2(y.lower(), x.lower()), std::atan2(y.lower(), x.upper()),
                        std::atan2(y.upper(), x.lower()), std::atan2(y.upper(), x.upper())};
  return {detail::next_below(std::min(corners), 8.0), detail::next_above(std::max(corners), 8.0)};
}

/// Encloses a function of time with its first two derivatives on an interval of time: coefficient k encloses f^(k) /
/// k!.
///
/// Where a choice between two functions is undecided, the coefficients hold what the function may do where it changes
/// over: its rate is anything if it may jump, its second derivative is anything if it may have a corner.
using IntervalJet = Series<Interval, 2>;

/// A multiple: a third of the products that a general one costs.
inline IntervalJet operator*(double a, const IntervalJet& x) {
  return IntervalJet::from([&](int k) { return a * x[k]; });
}

/// A choice that may jump.
inline IntervalJet where(Decision condition, const IntervalJet& a, const IntervalJet& b) {
  if (condition != Decision::undecided) return condition == Decision::yes ? a : b;
  IntervalJet c(where(condition, a[0], b[0]));
  c[1] = c[2] = Interval::whole();
  return c;
}

/// A choice between functions whose values agree where the condition changes.
inline IntervalJet where_continuous(Decision condition, const IntervalJet& a, const IntervalJet& b) {
  if (condition != Decision::undecided) return condition == Decision::yes ? a : b;
  IntervalJet c(where(condition, a[0], b[0]));
  c[1] = where(condition, a[1], b[1]);
  c[2] = Interval::whole();
  return c;
}

/// A choice between functions whose values and rates agree where the condition changes.
inline IntervalJet where_smooth(Decision condition, const IntervalJet& a, const IntervalJet& b) {
  return IntervalJet::from([&](int k) { return where(condition, a[k], b[k]); });
}

inline IntervalJet abs(const IntervalJet& x) { return where_continuous(less(x[0], Interval(0.0)), -x, x); }

namespace detail {
/// Constant between its jumps.
inline IntervalJet step_function(const Interval& value) {
  IntervalJet c(value);
  if (!singleton(value)) c[1] = c[2] = Interval::whole();
  return c;
}
}  // namespace detail

/// Jumps from pi to -pi behind the origin.
inline IntervalJet atan2(const IntervalJet& y, const IntervalJet& x) {
  IntervalJet angle = atan2<Interval, 2>(y, x);
  if (!(x[0].lower() > 0.0) && !(y[0].lower() > 0.0) && !(y[0].upper() < 0.0)) angle[1] = angle[2] = Interval::whole();
  return angle;
}

inline IntervalJet sign(const IntervalJet& x) { return detail::step_function(sign(x[0])); }
inline IntervalJet floor(const IntervalJet& x) { return detail::step_function(floor(x[0])); }

}  // namespace trajet

/// Eigen vectors and matrices of Intervals.
template <>
struct Eigen::NumTraits<trajet::Interval> : trajet::NumberTraits<trajet::Interval, 2, 4, 12> {};
