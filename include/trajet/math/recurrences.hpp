#pragma once

#include <cmath>

#include "trajet/math/force_inline.hpp"
#include "trajet/math/number.hpp"

/// Recurrences of power series: the n-th Taylor coefficient of each elementary operation from the coefficients of its
/// operands up to n and its own up to n - 1. One place for all that computes with series: `Series` runs them for
/// n = 0..N, the replay of a law and the expansion of a scene's program one order at a time.
///
/// Conventions: x(t) = sum_k x[k] t^k. `n` is an int or a std::integral_constant, which unrolls the sums. Functions of
/// n >= 1 only say so; order 0 is the function's value. Sums take the newest coefficients last, to keep the chain of
/// dependent operations short. Sources: [Moore1966] ch. 11, [GriewankWalther2008] ch. 13, [JorbaZou2005] prop. 2.1.
namespace trajet::recurrence {

/// sum over k = first..last of a[k] b[n - k]
template <class T, class Order>
TRAJET_INLINE T convolution(const T* a, const T* b, int first, int last, Order n) {
  T even = T(0.0), odd = T(0.0);
  int k = first;
  for (; k + 1 <= last; k += 2) {
    even += a[k] * b[n - k];
    odd += a[k + 1] * b[n - k - 1];
  }
  if (k <= last) even += a[k] * b[n - k];
  return even + odd;
}

/// sum over k = 1..last of k a[k] b[n - k]: the convolution of t a'(t) with b(t)
template <class T, class Order>
TRAJET_INLINE T derivative_convolution(const T* a, const T* b, int last, Order n) {
  T even = T(0.0), odd = T(0.0);
  int k = 1;
  for (; k + 1 <= last; k += 2) {
    even += (static_cast<double>(k) * a[k]) * b[n - k];
    odd += (static_cast<double>(k + 1) * a[k + 1]) * b[n - k - 1];
  }
  if (k <= last) even += (static_cast<double>(k) * a[k]) * b[n - k];
  return even + odd;
}

/// (a b)[n] = sum_k a[k] b[n - k]
template <class T, class Order>
TRAJET_INLINE T multiply(const T* a, const T* b, Order n) {
  if (n == 0) return a[0] * b[0];
  return (convolution(a, b, 1, n - 1, n) + a[0] * b[n]) + a[n] * b[0];
}

/// (a^2)[n]: half the products of multiply
template <class T, class Order>
TRAJET_INLINE T square(const T* a, Order n) {
  if (n == 0) return a[0] * a[0];
  const int half = (n - 1) / 2;
  T sum = convolution(a, a, 1, half, n);
  sum = sum + sum;
  if (n % 2 == 0) sum += a[n / 2] * a[n / 2];
  return sum + (2.0 * a[0]) * a[n];
}

/// c = a / b:  c[n] = (a[n] - sum_{k=1..n} b[k] c[n - k]) / b[0]
template <class T, class Order>
TRAJET_INLINE T divide(T a_n, const T* b, const T* c, Order n) {
  if (n == 0) return a_n / b[0];
  return (a_n - (convolution(b, c, 2, n, n) + b[1] * c[n - 1])) / b[0];
}

/// s = sqrt(x):  s[n] = (x[n] - sum_{k=1..n-1} s[k] s[n - k]) / (2 s[0]),  `half_inverse` = 1 / (2 s[0]).
/// Where x[0] = 0 there is no series unless x vanishes altogether: not-a-number then.
template <class T, class Order>
TRAJET_INLINE T sqrt(const T* x, const T* s, T& half_inverse, Order n) {
  if (n == 0) {
    using std::sqrt;
    const T root = sqrt(x[0]);
    half_inverse = 0.5 / root;
    return root;
  }
  const int half = (n - 1) / 2;
  T sum = convolution(s, s, 1, half, n);
  sum = sum + sum;
  if (n % 2 == 0) sum += s[n / 2] * s[n / 2];
  return (x[n] - sum) * half_inverse;
}

/// e = exp(x), n >= 1:  n e[n] = sum_{k=1..n} k x[k] e[n - k]
template <class T, class Order>
TRAJET_INLINE T exp(const T* x, const T* e, Order n) {
  return derivative_convolution(x, e, n, n) * (Factor<T>(1.0) / n);
}

/// l = log(x), n >= 1:  x[0] l[n] = x[n] - (1/n) sum_{k=1..n-1} k l[k] x[n - k]
template <class T, class Order>
TRAJET_INLINE T log(const T* x, const T* l, Order n) {
  return (x[n] - derivative_convolution(l, x, n - 1, n) * (Factor<T>(1.0) / n)) / x[0];
}

/// p = x^alpha, n >= 1:  n x[0] p[n] = sum_{k=1..n} (alpha k - (n - k)) x[k] p[n - k]
template <class T, class Order>
TRAJET_INLINE T power(const T* x, const T* p, Factor<T> alpha, Order n) {
  T sum = T(0.0);
  for (int k = n; k >= 1; --k) sum += ((alpha * k - (n - k)) * x[k]) * p[n - k];
  return sum / (static_cast<double>(n) * x[0]);
}

/// (s, c) = (sin x, cos x), n >= 1:  n s[n] = sum k x[k] c[n - k],  n c[n] = - sum k x[k] s[n - k]
template <class T, class Order>
TRAJET_INLINE void sin_cos(const T* x, T* s, T* c, Order n) {
  s[n] = derivative_convolution(x, c, n, n) * (Factor<T>(1.0) / n);
  c[n] = derivative_convolution(x, s, n, n) * (Factor<T>(-1.0) / n);
}

/// (s, c) = (sinh x, cosh x), n >= 1
template <class T, class Order>
TRAJET_INLINE void sinh_cosh(const T* x, T* s, T* c, Order n) {
  s[n] = derivative_convolution(x, c, n, n) * (Factor<T>(1.0) / n);
  c[n] = derivative_convolution(x, s, n, n) * (Factor<T>(1.0) / n);
}

/// t = tan x, n >= 1, with w = 1 + t^2:  n t[n] = sum k x[k] w[n - k]
template <class T, class Order>
TRAJET_INLINE void tan(const T* x, T* t, T* w, Order n) {
  t[n] = derivative_convolution(x, w, n, n) * (Factor<T>(1.0) / n);
  w[n] = square<T>(t, n);
}

/// t = tanh x, n >= 1, with w = 1 - t^2:  n t[n] = sum k x[k] w[n - k]
template <class T, class Order>
TRAJET_INLINE void tanh(const T* x, T* t, T* w, Order n) {
  t[n] = derivative_convolution(x, w, n, n) * (Factor<T>(1.0) / n);
  w[n] = -square<T>(t, n);
}

/// y = asin x, n >= 1, with r = sqrt(1 - x^2):  sum_{k=1..n} k y[k] r[n - k] = n x[n]
template <class T, class Order>
TRAJET_INLINE void asin(const T* x, T* y, T* r, Order n) {
  y[n] = (x[n] -
          derivative_convolution(static_cast<const T*>(y), static_cast<const T*>(r), n - 1, n) * (Factor<T>(1.0) / n)) /
         r[0];
  r[n] =
      (-square<T>(x, n) - convolution(static_cast<const T*>(r), static_cast<const T*>(r), 1, n - 1, n)) / (2.0 * r[0]);
}

/// y = atan x, n >= 1, with w = 1 + x^2:  sum_{k=1..n} k y[k] w[n - k] = n x[n]
template <class T, class Order>
TRAJET_INLINE void atan(const T* x, T* y, T* w, Order n) {
  y[n] = (x[n] -
          derivative_convolution(static_cast<const T*>(y), static_cast<const T*>(w), n - 1, n) * (Factor<T>(1.0) / n)) /
         w[0];
  w[n] = square<T>(x, n);
}

/// a = atan2(y, x), n >= 1, with w = x^2 + y^2:  sum_{k=1..n} k a[k] w[n - k] = sum_k k (y[k] x[n - k] - x[k] y[n - k])
template <class T, class Order>
TRAJET_INLINE void atan2(const T* y, const T* x, T* a, T* w, Order n) {
  const T wedge = derivative_convolution(y, x, n, n) - derivative_convolution(x, y, n, n);
  a[n] = (wedge - derivative_convolution(static_cast<const T*>(a), static_cast<const T*>(w), n - 1, n)) *
         (Factor<T>(1.0) / n) / w[0];
  w[n] = square<T>(x, n) + square<T>(y, n);
}

/// s = |(x, y, z)|:  s[n] = ((x^2 + y^2 + z^2)[n] - sum_{k=1..n-1} s[k] s[n - k]) / (2 s[0]),  `half_inverse` = 1 / (2
/// s[0])
///
/// Where the vector vanishes like t^m, its length is t^m times the length of the vector divided by t^m, for t >= 0:
/// a body that starts from rest has a speed with a power series.
template <class T, class Order>
TRAJET_INLINE T norm3(const T* x, const T* y, const T* z, const T* s, T& half_inverse, Order n);

namespace detail {

template <class T>
[[gnu::noinline]] T norm3_of_vanishing(const T* x, const T* y, const T* z, const T* s, T& half_inverse, int n) {
  int m = 0;
  while (m <= n && equal(x[m], T(0.0)) && equal(y[m], T(0.0)) && equal(z[m], T(0.0))) ++m;
  if (m > n) return T(0.0);
  if (n == m) {
    const T value = trajet::norm3(x[m], y[m], z[m]);
    half_inverse = 0.5 / value;
    return value;
  }
  // S = s / t^m is the length of (x, y, z) / t^m, whose coefficients start at index m
  const int order = n - m;
  const T squares = square(x + m, order) + square(y + m, order) + square(z + m, order);
  return (squares - convolution(s + m, s + m, 1, order - 1, order)) * half_inverse;
}

}  // namespace detail

template <class T, class Order>
TRAJET_INLINE T norm3(const T* x, const T* y, const T* z, const T* s, T& half_inverse, Order n) {
  if (n == 0) {
    using trajet::norm3;
    const T value = norm3(x[0], y[0], z[0]);
    half_inverse = 0.5 / value;
    return value;
  }
  if constexpr (std::is_floating_point_v<T>) {
    if (s[0] == 0.0) [[unlikely]]
      return detail::norm3_of_vanishing(x, y, z, s, half_inverse, n);
  }
  const int half = (n - 1) / 2;
  T sum = convolution(s, s, 1, half, n);
  sum = sum + sum;
  if (n % 2 == 0) sum += s[n / 2] * s[n / 2];
  return ((square(x, n) + square(y, n) + square(z, n)) - sum) * half_inverse;
}

/// The index of the first coefficient of a - b that is not zero, at most n; n + 1 if there is none so far.
/// abs, min and max of series choose by its sign: it is that of the function just after the point of expansion.
template <class T>
inline int first_difference(const T* a, const T* b, int n) {
  int k = 0;
  while (k <= n && a[k] == b[k]) ++k;
  return k;
}

}  // namespace trajet::recurrence
