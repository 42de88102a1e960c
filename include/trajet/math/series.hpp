#pragma once

#include <array>
#include <cmath>

#include "trajet/math/number.hpp"
#include "trajet/math/number_traits.hpp"
#include "trajet/math/recurrences.hpp"

namespace trajet {

/// A power series in time truncated after t^N: a number type that carries a function's value and N exact derivatives.
///
/// `x[k]` is the coefficient of t^k, the k-th derivative divided by k!. Arithmetic and functions are exact up to
/// rounding in every coefficient; a product costs O(N^2). `T` is double, Pack or Interval. Comparisons look at the
/// value alone; abs, min and max take the branch that holds just after t = 0.
///
/// A whole expansion of a differential equation is cheaper order by order: see Replay and ProgramExpansion, which use
/// the same recurrences.
template <class T, int N>
class Series {
 public:
  using Coefficient = T;
  static constexpr int kOrder = N;

  /// Zero.
  constexpr Series() : coefficients_{} {}
  /// A constant.
  // NOLINTNEXTLINE(google-explicit-constructor)
  constexpr Series(const T& value) : coefficients_{} { coefficients_[0] = value; }
  /// A constant given as a plain number.
  template <class Number>
  // NOLINTNEXTLINE(google-explicit-constructor)
  requires(std::is_arithmetic_v<Number> && !std::is_same_v<Number, T>) constexpr Series(Number value)
      : Series(T(static_cast<double>(value))) {}

  /// value + t: the independent variable at `value`.
  static Series variable(const T& value) {
    Series x(value);
    if constexpr (N >= 1) x[1] = T(1.0);
    return x;
  }

  T& operator[](int k) { return coefficients_[static_cast<std::size_t>(k)]; }
  const T& operator[](int k) const { return coefficients_[static_cast<std::size_t>(k)]; }
  T* data() { return coefficients_.data(); }
  const T* data() const { return coefficients_.data(); }

  /// Value of the truncated series at time t.
  T operator()(const T& t) const {
    T sum = coefficients_[N];
    for (int k = N - 1; k >= 0; --k) sum = sum * t + (*this)[k];
    return sum;
  }

  Series& operator+=(const Series& b) {
    for (int k = 0; k <= N; ++k) (*this)[k] += b[k];
    return *this;
  }
  Series& operator-=(const Series& b) {
    for (int k = 0; k <= N; ++k) (*this)[k] -= b[k];
    return *this;
  }
  Series& operator*=(const Series& b) { return *this = *this * b; }
  Series& operator/=(const Series& b) { return *this = *this / b; }

  friend Series operator-(const Series& a) {
    return from([&](int k) { return -a[k]; });
  }
  friend Series operator+(Series a, const Series& b) { return a += b; }
  friend Series operator-(Series a, const Series& b) { return a -= b; }
  friend Series operator*(const Series& a, const Series& b) {
    return from([&](int k) { return recurrence::multiply(a.data(), b.data(), k); });
  }
  friend Series operator/(const Series& a, const Series& b) {
    Series c;
    for (int k = 0; k <= N; ++k) c[k] = recurrence::divide(a[k], b.data(), c.data(), k);
    return c;
  }

  friend auto less(const Series& a, const Series& b) { return less(a[0], b[0]); }
  friend auto less_equal(const Series& a, const Series& b) { return less_equal(a[0], b[0]); }
  friend auto equal(const Series& a, const Series& b) { return equal(a[0], b[0]); }
  friend auto operator<(const Series& a, const Series& b) { return less(a[0], b[0]); }
  friend auto operator<=(const Series& a, const Series& b) { return less_equal(a[0], b[0]); }
  friend auto operator>(const Series& a, const Series& b) { return less(b[0], a[0]); }
  friend auto operator>=(const Series& a, const Series& b) { return less_equal(b[0], a[0]); }
  friend auto operator==(const Series& a, const Series& b) { return equal(a[0], b[0]); }

  template <class Condition>
  friend Series where(const Condition& condition, const Series& a, const Series& b) {
    return from([&](int k) { return where(condition, a[k], b[k]); });
  }

  /// The greater and the lesser just after t = 0; friends, so that either may be a plain number.
  friend Series max(const Series& a, const Series& b) { return where_continuous(is_less_behind_start(a, b), b, a); }
  friend Series min(const Series& a, const Series& b) { return where_continuous(is_less_behind_start(b, a), b, a); }

  /// The series whose k-th coefficient is f(k), computed in rising order.
  template <class F>
  static Series from(const F& f) {
    Series c;
    for (int k = 0; k <= N; ++k) c[k] = f(k);
    return c;
  }

 private:
  static auto is_less_behind_start(const Series& a, const Series& b) {
    if constexpr (std::is_same_v<T, double>) {
      const int k = recurrence::first_difference(a.data(), b.data(), N);
      return k <= N && a[k] < b[k];
    } else {
      return less(a[0], b[0]);
    }
  }

  std::array<T, N + 1> coefficients_;
};

/// A choice between functions whose values agree where the condition changes. Coefficients that are Intervals have an
/// overload of their own, which knows of the corner.
template <class Condition, class T, int N>
Series<T, N> where_continuous(const Condition& condition, const Series<T, N>& a, const Series<T, N>& b) {
  return where(condition, a, b);
}

template <class T, int N>
Series<T, N> square(const Series<T, N>& x) {
  return Series<T, N>::from([&](int k) { return recurrence::square(x.data(), k); });
}

template <class T, int N>
Series<T, N> sqrt(const Series<T, N>& x) {
  Series<T, N> s;
  T half_inverse{};
  for (int k = 0; k <= N; ++k) s[k] = recurrence::sqrt(x.data(), s.data(), half_inverse, k);
  return s;
}

template <class T, int N>
Series<T, N> norm3(const Series<T, N>& x, const Series<T, N>& y, const Series<T, N>& z) {
  Series<T, N> s;
  T half_inverse{};
  for (int k = 0; k <= N; ++k) s[k] = recurrence::norm3(x.data(), y.data(), z.data(), s.data(), half_inverse, k);
  return s;
}

template <class T, int N>
Series<T, N> exp(const Series<T, N>& x) {
  using std::exp;
  Series<T, N> e(exp(x[0]));
  for (int k = 1; k <= N; ++k) e[k] = recurrence::exp(x.data(), e.data(), k);
  return e;
}

template <class T, int N>
Series<T, N> log(const Series<T, N>& x) {
  using std::log;
  Series<T, N> l(log(x[0]));
  for (int k = 1; k <= N; ++k) l[k] = recurrence::log(x.data(), l.data(), k);
  return l;
}

template <class T, int N>
Series<T, N> log10(const Series<T, N>& x) {
  return log(x) * Series<T, N>(T(1.0 / std::log(10.0)));
}

/// x^alpha for a constant exponent; x[0] must not vanish unless alpha is a non-negative integer, where products serve.
template <class T, int N>
Series<T, N> pow(const Series<T, N>& x, double alpha) {
  if (alpha == std::floor(alpha) && alpha >= 0.0 && alpha <= 64.0) {
    Series<T, N> result(T(1.0)), base = x;
    for (int exponent = static_cast<int>(alpha); exponent > 0; exponent /= 2) {
      if (exponent % 2 == 1) result *= base;
      if (exponent > 1) base = square(base);
    }
    return result;
  }
  using std::pow;
  Series<T, N> p(pow(x[0], T(alpha)));
  for (int k = 1; k <= N; ++k) p[k] = recurrence::power(x.data(), p.data(), alpha, k);
  return p;
}

/// x^y = exp(y log x), x > 0
template <class T, int N>
Series<T, N> pow(const Series<T, N>& x, const Series<T, N>& y) {
  return exp(y * log(x));
}

template <class T, int N>
Series<T, N> cbrt(const Series<T, N>& x) {
  using std::cbrt;
  Series<T, N> p(cbrt(x[0]));
  for (int k = 1; k <= N; ++k) p[k] = recurrence::power(x.data(), p.data(), 1.0 / 3.0, k);
  return p;
}

namespace detail {

/// A pair of series that are computed together, such as sine and cosine.
template <class T, int N>
struct SeriesPair {
  Series<T, N> first, second;
};

template <class T, int N>
SeriesPair<T, N> sin_cos(const Series<T, N>& x) {
  using std::cos, std::sin;
  SeriesPair<T, N> f{sin(x[0]), cos(x[0])};
  for (int k = 1; k <= N; ++k) recurrence::sin_cos(x.data(), f.first.data(), f.second.data(), k);
  return f;
}

template <class T, int N>
SeriesPair<T, N> sinh_cosh(const Series<T, N>& x) {
  using std::cosh, std::sinh;
  SeriesPair<T, N> f{sinh(x[0]), cosh(x[0])};
  for (int k = 1; k <= N; ++k) recurrence::sinh_cosh(x.data(), f.first.data(), f.second.data(), k);
  return f;
}

}  // namespace detail

template <class T, int N>
Series<T, N> sin(const Series<T, N>& x) {
  return detail::sin_cos(x).first;
}
template <class T, int N>
Series<T, N> cos(const Series<T, N>& x) {
  return detail::sin_cos(x).second;
}
template <class T, int N>
Series<T, N> sinh(const Series<T, N>& x) {
  return detail::sinh_cosh(x).first;
}
template <class T, int N>
Series<T, N> cosh(const Series<T, N>& x) {
  return detail::sinh_cosh(x).second;
}

template <class T, int N>
Series<T, N> tan(const Series<T, N>& x) {
  using std::tan;
  Series<T, N> t(tan(x[0])), w(T(1.0) + t[0] * t[0]);
  for (int k = 1; k <= N; ++k) recurrence::tan(x.data(), t.data(), w.data(), k);
  return t;
}

template <class T, int N>
Series<T, N> tanh(const Series<T, N>& x) {
  using std::tanh;
  Series<T, N> t(tanh(x[0])), w(T(1.0) - t[0] * t[0]);
  for (int k = 1; k <= N; ++k) recurrence::tanh(x.data(), t.data(), w.data(), k);
  return t;
}

template <class T, int N>
Series<T, N> asin(const Series<T, N>& x) {
  using std::asin, std::sqrt;
  Series<T, N> y(asin(x[0])), r(sqrt((T(1.0) - x[0]) * (T(1.0) + x[0])));
  for (int k = 1; k <= N; ++k) recurrence::asin(x.data(), y.data(), r.data(), k);
  return y;
}

template <class T, int N>
Series<T, N> acos(const Series<T, N>& x) {
  using std::acos;
  Series<T, N> y = -asin(x);
  y[0] = acos(x[0]);
  return y;
}

template <class T, int N>
Series<T, N> atan(const Series<T, N>& x) {
  using std::atan;
  Series<T, N> y(atan(x[0])), w(T(1.0) + x[0] * x[0]);
  for (int k = 1; k <= N; ++k) recurrence::atan(x.data(), y.data(), w.data(), k);
  return y;
}

template <class T, int N>
Series<T, N> atan2(const Series<T, N>& y, const Series<T, N>& x) {
  using std::atan2;
  Series<T, N> a(atan2(y[0], x[0])), w(x[0] * x[0] + y[0] * y[0]);
  for (int k = 1; k <= N; ++k) recurrence::atan2(y.data(), x.data(), a.data(), w.data(), k);
  return a;
}

/// |x| on the branch that holds just after t = 0; for coefficients whose comparison has more answers than yes and no,
/// coefficient by coefficient with `where`.
template <class T, int N>
Series<T, N> abs(const Series<T, N>& x) {
  return max(x, -x);
}

template <class T, int N>
Series<T, N> sign(const Series<T, N>& x) {
  return Series<T, N>(sign(x[0]));
}
template <class T, int N>
Series<T, N> floor(const Series<T, N>& x) {
  using std::floor;
  return Series<T, N>(floor(x[0]));
}

}  // namespace trajet

/// Eigen vectors and matrices of series.
template <class T, int N>
struct Eigen::NumTraits<trajet::Series<T, N>>
    : trajet::NumberTraits<trajet::Series<T, N>, N + 1, N + 1, (N + 1) * (N + 2) / 2> {};
