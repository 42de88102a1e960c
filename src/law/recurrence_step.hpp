#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "trajet/law/program.hpp"
#include "trajet/math/force_inline.hpp"
#include "trajet/math/recurrences.hpp"

namespace trajet::detail {

/// Rows of its own that an opcode needs to expand into a power series.
inline int scratch_count(Opcode opcode) {
  switch (opcode) {
    case Opcode::table:
      return 3;
    case Opcode::power:
    case Opcode::acos:
      return 2;
    case Opcode::sqrt:
    case Opcode::norm:
    case Opcode::log10:
    case Opcode::sin:
    case Opcode::cos:
    case Opcode::sinh:
    case Opcode::cosh:
    case Opcode::tan:
    case Opcode::tanh:
    case Opcode::asin:
    case Opcode::atan:
    case Opcode::atan2:
    case Opcode::min:
    case Opcode::max:
    case Opcode::less:
    case Opcode::less_equal:
    case Opcode::equal:
      return 1;
    default:
      return 0;
  }
}

template <class T>
bool vanishes(const T* x, int n) {
  for (int k = 0; k <= n; ++k) {
    if (x[k] != 0.0) return false;
  }
  return true;
}

/// A power or a root of a function that is 0 at the start: 0 as long as it vanishes, no series otherwise.
template <class T>
T power_of_zero(const T* x, int n) {
  return vanishes(x, n) ? 0.0 : std::numeric_limits<T>::quiet_NaN();
}

/// x^alpha
template <class T>
T power_step(const T* x, const T* p, T alpha, int n) {
  return x[0] == 0.0 && alpha > 0.0 ? power_of_zero(x, n) : recurrence::power(x, p, alpha, n);
}

template <class T>
void sin_cos_step(const T* x, T* s, T* c, int n) {
  if (n > 0) return recurrence::sin_cos(x, s, c, n);
  s[0] = std::sin(x[0]);
  c[0] = std::cos(x[0]);
}

template <class T>
void sinh_cosh_step(const T* x, T* s, T* c, int n) {
  if (n > 0) return recurrence::sinh_cosh(x, s, c, n);
  s[0] = std::sinh(x[0]);
  c[0] = std::cosh(x[0]);
}

template <class T>
void asin_step(const T* x, T* y, T* root, int n) {
  if (n > 0) return recurrence::asin(x, y, root, n);
  y[0] = std::asin(x[0]);
  root[0] = std::sqrt((1.0 - x[0]) * (1.0 + x[0]));
}

/// The n-th coefficient of what laws mostly consist of, with the sums unrolled where `n` is a std::integral_constant.
/// False, with nothing done, if `step` is of another kind or has its own rule for this coefficient: see smooth_step.
template <class Step, class Order>
TRAJET_INLINE bool common_step(const Step& step, Order n) {
  using T = std::remove_pointer_t<decltype(step.result)>;
  const T *a = step.a, *b = step.b;
  T* r = step.result;
  const T k = step.constant;
  switch (step.opcode) {
    case Opcode::add:
      r[n] = a[n] + b[n];
      return true;
    case Opcode::add_constant:
      r[n] = n == 0 ? a[0] + k : a[n];
      return true;
    case Opcode::subtract:
      r[n] = a[n] - b[n];
      return true;
    case Opcode::constant_minus:
      r[n] = n == 0 ? k - a[0] : -a[n];
      return true;
    case Opcode::multiply:
      r[n] = recurrence::multiply(a, b, n);
      return true;
    case Opcode::multiply_constant:
      r[n] = k * a[n];
      return true;
    case Opcode::divide:
      r[n] = recurrence::divide(a[n], b, r, n);
      return true;
    case Opcode::divide_constant:
      r[n] = a[n] / k;
      return true;
    case Opcode::constant_over:
      r[n] = recurrence::divide(n == 0 ? k : T(0.0), a, r, n);
      return true;
    case Opcode::negate:
      r[n] = -a[n];
      return true;
    case Opcode::square:
      r[n] = recurrence::square(a, n);
      return true;
    case Opcode::sqrt:  // a branch decides at order 0, and where it starts at zero
      if (n == 0 || r[0] == 0.0) return false;
      r[n] = recurrence::sqrt(a, r, step.own[0][0], n);
      return true;
    case Opcode::norm:
      if (n == 0 || r[0] == 0.0) return false;
      r[n] = recurrence::norm3(a, b, step.c, r, step.own[0][0], n);
      return true;
    default:
      return false;
  }
}

/// The n-th coefficient of the other instructions without branches.
template <class Step>
void smooth_step(const Step& step, int n) {
  using T = std::remove_pointer_t<decltype(step.result)>;
  const T* a = step.a;
  T *b = step.b, *r = step.result, *u = step.own[0], *v = step.own[1];
  const T k = step.constant;
  switch (step.opcode) {
    case Opcode::power:  // a^b = exp(b log a): u = log a, v = b u
      u[n] = n == 0 ? std::log(a[0]) : recurrence::log(a, u, n);
      v[n] = recurrence::multiply<T>(b, u, n);
      r[n] = n == 0 ? std::pow(a[0], b[0]) : recurrence::exp(v, r, n);
      break;
    case Opcode::power_constant:
      r[n] = n == 0 ? std::pow(a[0], k) : power_step(a, r, k, n);
      break;
    case Opcode::cbrt:
      r[n] = n == 0 ? std::cbrt(a[0]) : power_step(a, r, T(1.0) / 3, n);
      break;
    case Opcode::exp:
      r[n] = n == 0 ? std::exp(a[0]) : recurrence::exp(a, r, n);
      break;
    case Opcode::log:
      r[n] = n == 0 ? std::log(a[0]) : recurrence::log(a, r, n);
      break;
    case Opcode::log10:  // log a / log 10: u = log a
      u[n] = n == 0 ? std::log(a[0]) : recurrence::log(a, u, n);
      r[n] = n == 0 ? std::log10(a[0]) : u[n] / std::log(T(10.0));
      break;
    case Opcode::sin:
      sin_cos_step(a, r, u, n);
      break;
    case Opcode::cos:
      sin_cos_step(a, u, r, n);
      break;
    case Opcode::sin_cos:
      sin_cos_step(a, r, b, n);
      break;
    case Opcode::sinh:
      sinh_cosh_step(a, r, u, n);
      break;
    case Opcode::cosh:
      sinh_cosh_step(a, u, r, n);
      break;
    case Opcode::sinh_cosh:
      sinh_cosh_step(a, r, b, n);
      break;
    case Opcode::tanh:
      if (n > 0) return recurrence::tanh(a, r, u, n);
      r[0] = std::tanh(a[0]);
      u[0] = (1.0 - r[0]) * (1.0 + r[0]);
      break;
    case Opcode::atan:
      if (n > 0) return recurrence::atan(a, r, u, n);
      r[0] = std::atan(a[0]);
      u[0] = 1.0 + a[0] * a[0];
      break;
    default:  // those of common_step, and those with branches
      break;
  }
}

}  // namespace trajet::detail
