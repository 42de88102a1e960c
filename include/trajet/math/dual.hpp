#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "trajet/math/number.hpp"
#include "trajet/math/number_traits.hpp"

namespace trajet {

/// A value with its derivatives along N directions: a number type on which a law gives its exact Jacobian.
///
/// `x.value()` is the value, `x.derivative(i)` the derivative along direction i; both are exact up to rounding
/// [GriewankWalther2008] ch. 3. Comparisons look at the value alone. A direction in which no argument of a function
/// moves does not move the function, even where its slope is infinite: the speed sqrt(v . v) of a body at rest has
/// derivative 0.
template <int N>
class Dual {
  static_assert(N >= 1);

 public:
  static constexpr int kDirections = N;

  /// Zero.
  constexpr Dual() = default;
  /// A constant.
  template <class Number>
  // NOLINTNEXTLINE(google-explicit-constructor)
  requires(std::is_arithmetic_v<Number>) constexpr Dual(Number value) : value_(static_cast<double>(value)) {}

  /// The variable that moves with direction `i`, at `value`.
  static constexpr Dual variable(double value, int i) {
    Dual x(value);
    x.derivative(i) = 1.0;
    return x;
  }

  double value() const { return value_; }
  double& derivative(int i) { return derivatives_[static_cast<std::size_t>(i)]; }
  double derivative(int i) const { return derivatives_[static_cast<std::size_t>(i)]; }

  /// f(x) from its value and its slope at x.
  static Dual chain(double value, double slope, const Dual& x) {
    return from(value, [&](int i) { return product(slope, x.derivative(i)); });
  }
  /// f(x, y) from its value and its partial slopes.
  static Dual chain(double value, double slope_x, const Dual& x, double slope_y, const Dual& y) {
    return from(value, [&](int i) { return product(slope_x, x.derivative(i)) + product(slope_y, y.derivative(i)); });
  }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend Dual operator-(const Dual& a) {
    return from(-a.value_, [&](int i) { return -a.derivative(i); });
  }
  friend Dual operator+(const Dual& a, const Dual& b) {
    return from(a.value_ + b.value_, [&](int i) { return a.derivative(i) + b.derivative(i); });
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return from(a.value_ - b.value_, [&](int i) { return a.derivative(i) - b.derivative(i); });
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return from(a.value_ * b.value_, [&](int i) { return a.value_ * b.derivative(i) + a.derivative(i) * b.value_; });
  }
  /// (a / b)' = (a' - (a / b) b') / b
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double quotient = a.value_ / b.value_;
    const double inverse = 1.0 / b.value_;
    return from(quotient, [&](int i) { return (a.derivative(i) - quotient * b.derivative(i)) * inverse; });
  }
  // with a constant: without the derivatives that vanish
  friend Dual operator+(const Dual& a, double b) {
    return from(a.value_ + b, [&](int i) { return a.derivative(i); });
  }
  friend Dual operator+(double a, const Dual& b) { return b + a; }
  friend Dual operator-(const Dual& a, double b) { return a + -b; }
  friend Dual operator-(double a, const Dual& b) { return -b + a; }
  friend Dual operator*(const Dual& a, double b) {
    return from(a.value_ * b, [&](int i) { return a.derivative(i) * b; });
  }
  friend Dual operator*(double a, const Dual& b) { return b * a; }
  friend Dual operator/(const Dual& a, double b) {
    return from(a.value_ / b, [&](int i) { return a.derivative(i) / b; });
  }
  friend Dual operator/(double a, const Dual& b) { return Dual(a) / b; }

  friend bool operator<(const Dual& a, const Dual& b) { return a.value_ < b.value_; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.value_ <= b.value_; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value_ > b.value_; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.value_ >= b.value_; }
  friend bool operator==(const Dual& a, const Dual& b) { return a.value_ == b.value_; }
  friend bool less(const Dual& a, const Dual& b) { return a < b; }
  friend bool less_equal(const Dual& a, const Dual& b) { return a <= b; }
  friend bool equal(const Dual& a, const Dual& b) { return a == b; }
  friend Dual where(bool condition, const Dual& a, const Dual& b) { return condition ? a : b; }
  friend Dual min(const Dual& a, const Dual& b) { return b < a ? b : a; }
  friend Dual max(const Dual& a, const Dual& b) { return a < b ? b : a; }

  /// x^y; as friends, so that either may be a plain number.
  friend Dual pow(const Dual& x, const Dual& y) {
    const double power = std::pow(x.value_, y.value_);
    const double slope_x = y.value_ == 0.0 ? 0.0 : y.value_ * std::pow(x.value_, y.value_ - 1.0);
    const double slope_y = power == 0.0 ? 0.0 : power * std::log(x.value_);
    return chain(power, slope_x, x, slope_y, y);
  }
  friend Dual atan2(const Dual& y, const Dual& x) {
    const double per_square = 1.0 / (x.value_ * x.value_ + y.value_ * y.value_);
    return chain(std::atan2(y.value_, x.value_), x.value_ * per_square, y, -y.value_ * per_square, x);
  }
  /// Length of (x, y, z); its derivative at zero, where there is none, is taken as zero.
  friend Dual norm3(const Dual& x, const Dual& y, const Dual& z) {
    const double length = norm3(x.value_, y.value_, z.value_);
    const double per_length = length == 0.0 ? 0.0 : 1.0 / length;
    return from(length, [&](int i) {
      return (x.value_ * x.derivative(i) + y.value_ * y.derivative(i) + z.value_ * z.derivative(i)) * per_length;
    });
  }

 private:
  template <class F>
  static Dual from(double value, const F& derivative) {
    Dual x;
    x.value_ = value;
    for (int i = 0; i < N; ++i) x.derivative(i) = derivative(i);
    return x;
  }
  /// slope * derivative, and 0 for a derivative 0 whatever the slope.
  static double product(double slope, double derivative) { return derivative == 0.0 ? 0.0 : slope * derivative; }

  double value_ = 0.0;
  std::array<double, static_cast<std::size_t>(N)> derivatives_{};
};

template <int N>
Dual<N> sqrt(const Dual<N>& x) {
  const double root = std::sqrt(x.value());
  return Dual<N>::chain(root, 0.5 / root, x);
}
template <int N>
Dual<N> cbrt(const Dual<N>& x) {
  const double root = std::cbrt(x.value());
  return Dual<N>::chain(root, 1.0 / (3.0 * root * root), x);
}
template <int N>
Dual<N> exp(const Dual<N>& x) {
  const double e = std::exp(x.value());
  return Dual<N>::chain(e, e, x);
}
template <int N>
Dual<N> log(const Dual<N>& x) {
  return Dual<N>::chain(std::log(x.value()), 1.0 / x.value(), x);
}
template <int N>
Dual<N> log10(const Dual<N>& x) {
  return Dual<N>::chain(std::log10(x.value()), 1.0 / (x.value() * std::log(10.0)), x);
}
template <int N>
Dual<N> sin(const Dual<N>& x) {
  return Dual<N>::chain(std::sin(x.value()), std::cos(x.value()), x);
}
template <int N>
Dual<N> cos(const Dual<N>& x) {
  return Dual<N>::chain(std::cos(x.value()), -std::sin(x.value()), x);
}
template <int N>
Dual<N> tan(const Dual<N>& x) {
  const double t = std::tan(x.value());
  return Dual<N>::chain(t, 1.0 + t * t, x);
}
template <int N>
Dual<N> asin(const Dual<N>& x) {
  return Dual<N>::chain(std::asin(x.value()), 1.0 / std::sqrt((1.0 - x.value()) * (1.0 + x.value())), x);
}
template <int N>
Dual<N> acos(const Dual<N>& x) {
  return Dual<N>::chain(std::acos(x.value()), -1.0 / std::sqrt((1.0 - x.value()) * (1.0 + x.value())), x);
}
template <int N>
Dual<N> atan(const Dual<N>& x) {
  return Dual<N>::chain(std::atan(x.value()), 1.0 / (1.0 + x.value() * x.value()), x);
}
template <int N>
Dual<N> sinh(const Dual<N>& x) {
  return Dual<N>::chain(std::sinh(x.value()), std::cosh(x.value()), x);
}
template <int N>
Dual<N> cosh(const Dual<N>& x) {
  return Dual<N>::chain(std::cosh(x.value()), std::sinh(x.value()), x);
}
template <int N>
Dual<N> tanh(const Dual<N>& x) {
  const double t = std::tanh(x.value());
  return Dual<N>::chain(t, (1.0 - t) * (1.0 + t), x);
}
/// The derivative of |x| at zero, where there is none, is taken as zero.
template <int N>
Dual<N> abs(const Dual<N>& x) {
  return Dual<N>::chain(std::abs(x.value()), sign(x.value()), x);
}
template <int N>
Dual<N> sign(const Dual<N>& x) {
  return Dual<N>(sign(x.value()));
}
template <int N>
Dual<N> floor(const Dual<N>& x) {
  return Dual<N>(std::floor(x.value()));
}

}  // namespace trajet

/// Eigen vectors and matrices of Duals.
template <int N>
struct Eigen::NumTraits<trajet::Dual<N>> : trajet::NumberTraits<trajet::Dual<N>, N + 1, N + 1, 2 * N + 1> {};
