#pragma once

#include <cmath>
#include <type_traits>

#include "trajet/portable.hpp"

namespace trajet {

/// A constant in double precision, and what rounding to it has taken off: the two together are the constant in
/// extended precision. All number types but `Extended` read the value alone.
struct ExtendedConstant {
  double value = 0.0;
  double remainder = 0.0;

  ExtendedConstant() = default;
  ExtendedConstant(double number) : value(number) {}  // NOLINT(google-explicit-constructor): exact
  /// `number` is the value; the remainder is what `exact` has more, where both are finite. A value of 0 has none, so
  /// that what is zero is so in every precision.
  ExtendedConstant(double number, Extended exact) : value(number) {
    const Extended rest = exact - static_cast<Extended>(number);
    if (number != 0.0 && std::isfinite(rest)) remainder = static_cast<double>(rest);
  }

  /// The constant as a number of type T.
  template <class T>
  T as() const {
    if constexpr (std::is_same_v<T, Extended>) {
      return static_cast<Extended>(value) + static_cast<Extended>(remainder);
    } else {
      return T(value);
    }
  }

  ExtendedConstant operator-() const {
    ExtendedConstant result(-value);
    result.remainder = 0.0 - remainder;  // none stays none, and no -0
    return result;
  }
  friend ExtendedConstant operator+(const ExtendedConstant& a, const ExtendedConstant& b) {
    const Extended sum = a.as<Extended>() + b.as<Extended>();
    return {static_cast<double>(sum), sum};
  }
  bool operator==(const ExtendedConstant&) const = default;
};

}  // namespace trajet
