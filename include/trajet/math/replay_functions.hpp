#pragma once

#include <cmath>
#include <numbers>

#include "trajet/math/replay.hpp"

/// Functions of Replay numbers: the value at order 0, the recurrence beyond.
namespace trajet {

template <class T, int N>
TRAJET_INLINE Replay<T, N> square(const Replay<T, N>& x) {
  return x * x;
}

template <class T, int N>
TRAJET_INLINE Replay<T, N> sqrt(const Replay<T, N>& x) {
  using std::sqrt;
  if (x.is_constant()) return sqrt(x.constant());
  const Replay<T, N> root = Replay<T, N>::record(x, [&](T* s) {
    return recurrence::sqrt<T>(x.coefficients(), s, s[ReplayTape<T>::kStride - 1], Replay<T, N>::kOrder);
  });
  detail::branch_sign(root);  // a root that reaches zero must not go on below it, as the analytic continuation does
  return root;
}

template <class T, int N>
TRAJET_INLINE Replay<T, N> norm3(const Replay<T, N>& x, const Replay<T, N>& y, const Replay<T, N>& z) {
  if (x.is_constant() || y.is_constant() || z.is_constant()) return sqrt(x * x + y * y + z * z);
  const Replay<T, N> norm = Replay<T, N>::record(x, [&](T* s) {
    return recurrence::norm3<T>(x.coefficients(), y.coefficients(), z.coefficients(), s, s[ReplayTape<T>::kStride - 1],
                                Replay<T, N>::kOrder);
  });
  detail::branch_sign(norm);
  return norm;
}

namespace detail {

/// A function f of one argument by its value at order 0 and its recurrence beyond.
template <class T, int N, class Value, class Recurrence>
TRAJET_INLINE Replay<T, N> replay_function(const Replay<T, N>& x, const Value& value, const Recurrence& next) {
  if (x.is_constant()) return Replay<T, N>(value(x.constant()));
  return Replay<T, N>::record(x, [&](T* f) {
    const T* x_slot = x.coefficients();
    return N == 0 ? value(x_slot[0]) : next(x_slot, f, Replay<T, N>::kOrder);
  });
}

/// A function with a companion: `start(x0, f, g)` at order 0, `next(x, f, g, n)` beyond.
template <class T, int N, class Start, class Recurrence>
TRAJET_INLINE Replay<T, N> replay_pair(const Replay<T, N>& x, const Start& start, const Recurrence& next) {
  return Replay<T, N>::record_pair(x, [&](T* f, T* g) {
    const T* x_slot = x.coefficients();
    if constexpr (N == 0)
      start(x_slot[0], f[0], g[0]);
    else
      next(x_slot, f, g, Replay<T, N>::kOrder);
  });
}

}  // namespace detail

template <class T, int N>
TRAJET_INLINE Replay<T, N> exp(const Replay<T, N>& x) {
  using std::exp;
  return detail::replay_function(
      x, [](const auto& v) { return exp(v); }, [](const T* a, T* e, auto n) { return recurrence::exp<T>(a, e, n); });
}
template <class T, int N>
TRAJET_INLINE Replay<T, N> log(const Replay<T, N>& x) {
  using std::log;
  return detail::replay_function(
      x, [](const auto& v) { return log(v); }, [](const T* a, T* l, auto n) { return recurrence::log<T>(a, l, n); });
}
template <class T, int N>
TRAJET_INLINE Replay<T, N> log10(const Replay<T, N>& x) {
  return log(x) * (1.0 / std::log(Factor<T>(10.0)));
}
template <class T, int N>
TRAJET_INLINE Replay<T, N> cbrt(const Replay<T, N>& x) {
  using std::cbrt;
  return detail::replay_function(
      x, [](const auto& v) { return cbrt(v); },
      [](const T* a, T* p, auto n) { return recurrence::power<T>(a, p, Factor<T>(1.0) / 3, n); });
}
/// x^alpha. Small non-negative integers by products, which need no x != 0.
template <class T, int N>
TRAJET_INLINE Replay<T, N> pow(const Replay<T, N>& x, Factor<T> alpha) {
  if (alpha == std::floor(alpha) && alpha >= 0.0 && alpha <= 64.0) {
    Replay<T, N> result(1.0), base = x;
    for (int exponent = static_cast<int>(alpha); exponent > 0; exponent /= 2) {
      if (exponent % 2 == 1) result = result.is_constant() ? base : result * base;
      if (exponent > 1) base = base * base;
    }
    return result;
  }
  using std::pow;
  return detail::replay_function(
      x, [alpha](const auto& v) { return pow(v, alpha); },
      [alpha](const T* a, T* p, auto n) { return recurrence::power<T>(a, p, alpha, n); });
}
template <class T, int N>
TRAJET_INLINE Replay<T, N> pow(const Replay<T, N>& x, const Replay<T, N>& y) {
  return y.is_constant() ? pow(x, y.constant()) : exp(y * log(x));
}

template <class T, int N>
TRAJET_INLINE Replay<T, N> sin(const Replay<T, N>& x) {
  using std::cos, std::sin;
  if (x.is_constant()) return sin(x.constant());
  return detail::replay_pair(
      x, [](const T& v, T& s, T& c) { s = sin(v), c = cos(v); },
      [](const T* a, T* s, T* c, auto n) { recurrence::sin_cos<T>(a, s, c, n); });
}
template <class T, int N>
TRAJET_INLINE Replay<T, N> cos(const Replay<T, N>& x) {
  if (x.is_constant()) return std::cos(x.constant());
  const Replay<T, N> sine = sin(x);
  return sine.neighbour(sine.slot() == 0 ? 0 : sine.slot() + 1);
}
template <class T, int N>
TRAJET_INLINE Replay<T, N> sinh(const Replay<T, N>& x) {
  using std::cosh, std::sinh;
  if (x.is_constant()) return sinh(x.constant());
  return detail::replay_pair(
      x, [](const T& v, T& s, T& c) { s = sinh(v), c = cosh(v); },
      [](const T* a, T* s, T* c, auto n) { recurrence::sinh_cosh<T>(a, s, c, n); });
}
template <class T, int N>
TRAJET_INLINE Replay<T, N> cosh(const Replay<T, N>& x) {
  if (x.is_constant()) return std::cosh(x.constant());
  const Replay<T, N> sine = sinh(x);
  return sine.neighbour(sine.slot() == 0 ? 0 : sine.slot() + 1);
}
template <class T, int N>
TRAJET_INLINE Replay<T, N> tan(const Replay<T, N>& x) {
  using std::tan;
  if (x.is_constant()) return tan(x.constant());
  return detail::replay_pair(
      x, [](const T& v, T& t, T& w) { t = tan(v), w = 1.0 + t * t; },
      [](const T* a, T* t, T* w, auto n) { recurrence::tan<T>(a, t, w, n); });
}
template <class T, int N>
TRAJET_INLINE Replay<T, N> tanh(const Replay<T, N>& x) {
  using std::tanh;
  if (x.is_constant()) return tanh(x.constant());
  return detail::replay_pair(
      x, [](const T& v, T& t, T& w) { t = tanh(v), w = 1.0 - t * t; },
      [](const T* a, T* t, T* w, auto n) { recurrence::tanh<T>(a, t, w, n); });
}
template <class T, int N>
TRAJET_INLINE Replay<T, N> asin(const Replay<T, N>& x) {
  using std::asin, std::sqrt;
  if (x.is_constant()) return asin(x.constant());
  const Replay<T, N> angle = detail::replay_pair(
      x, [](const T& v, T& y, T& r) { y = asin(v), r = sqrt((1.0 - v) * (1.0 + v)); },
      [](const T* a, T* y, T* r, auto n) { recurrence::asin<T>(a, y, r, n); });
  // where x touches 1 or -1 the angle turns back; its analytic continuation goes on
  detail::branch_sign(angle.neighbour(angle.slot() == 0 ? 0 : angle.slot() + 1));
  return angle;
}
template <class T, int N>
TRAJET_INLINE Replay<T, N> acos(const Replay<T, N>& x) {
  constexpr Factor<T> kHalfPi = std::numbers::pi_v<Factor<T>> / 2;
  return kHalfPi - asin(x);
}
template <class T, int N>
TRAJET_INLINE Replay<T, N> atan(const Replay<T, N>& x) {
  using std::atan;
  if (x.is_constant()) return atan(x.constant());
  return detail::replay_pair(
      x, [](const T& v, T& y, T& w) { y = atan(v), w = 1.0 + v * v; },
      [](const T* a, T* y, T* w, auto n) { recurrence::atan<T>(a, y, w, n); });
}

namespace detail {

template <class T, int N>
TRAJET_INLINE Replay<T, N> angle_of_slots(const Replay<T, N>& y, const Replay<T, N>& x) {
  const double side = branch_sign(y);  // of the cut
  return Replay<T, N>::record_pair(x, [&](T* a, T* w) {
    const T* y_slot = y.coefficients();
    const T* x_slot = x.coefficients();
    if constexpr (N == 0)
      a[0] = angle_on_side(y_slot[0], x_slot[0], side), w[0] = x_slot[0] * x_slot[0] + y_slot[0] * y_slot[0];
    else
      recurrence::atan2<T>(y_slot, x_slot, a, w, Replay<T, N>::kOrder);
  });
}

/// The angle of the point (x, y).
template <class T, int N>
TRAJET_INLINE Replay<T, N> angle_of(const Replay<T, N>& y, const Replay<T, N>& x) {
  using std::atan2;
  if (x.is_constant() && y.is_constant()) return atan2(y.constant(), x.constant());
  if (x.is_constant()) return angle_of_slots(y, x.constant() + 0.0 * y);
  if (y.is_constant()) return angle_of_slots(y.constant() + 0.0 * x, x);
  return angle_of_slots(y, x);
}

/// The side of zero on which x is just after the point of expansion, as far as its coefficients up to n tell: -1, 0, 1.
template <class T>
TRAJET_INLINE double side_after(double decided, const T* x, int n) {
  for (int k = 1; decided == 0.0 && k <= n; ++k) decided = trajet::sign(x[k]);
  return decided;
}

/// The one that is greater just after the point of expansion.
template <class T, int N>
TRAJET_INLINE Replay<T, N> greater_of(const Replay<T, N>& a, const Replay<T, N>& b) {
  const Replay<T, N> difference = a - b;
  if (difference.is_constant()) return difference.constant() < 0.0 ? b : a;
  const double decided = branch_sign(difference);
  return Replay<T, N>::record(difference, [&](T*) {
    const bool second = side_after(decided, difference.coefficients(), N) < 0.0;
    const Replay<T, N>& chosen = second ? b : a;
    return N == 0 ? chosen.newest() : chosen.coefficient();
  });
}

}  // namespace detail

/// |x| on the branch that holds just after the point of expansion.
template <class T, int N>
TRAJET_INLINE Replay<T, N> abs(const Replay<T, N>& x) {
  if (x.is_constant()) return std::abs(x.constant());
  const double decided = detail::branch_sign(x);
  return Replay<T, N>::record(
      x, [&](T*) { return detail::side_after(decided, x.coefficients(), N) < 0.0 ? -x.newest() : x.newest(); });
}
/// Piecewise constant: the value on the branch taken.
template <class T, int N>
TRAJET_INLINE Replay<T, N> sign(const Replay<T, N>& x) {
  if (x.is_constant()) return trajet::sign(x.constant());
  return Replay<T, N>(detail::branch_sign(x));
}

}  // namespace trajet
