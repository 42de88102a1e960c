#pragma once

#include <cmath>
#include <type_traits>

#include "trajet/math/force_inline.hpp"
#include "trajet/portable.hpp"

namespace trajet {

/// What a number type offers besides + - * / and the functions of <cmath>: comparisons whose answer is as rich as the
/// type needs (a bool, a mask of lanes, "undecided"), and `where`, which takes that answer.
///
/// Here for double. Series, Pack and Interval add their overloads beside the type. A law that calls these instead of
/// `if` and `?:` runs on all of them.

TRAJET_INLINE bool less(double a, double b) { return a < b; }
TRAJET_INLINE bool less_equal(double a, double b) { return a <= b; }
TRAJET_INLINE bool equal(double a, double b) { return a == b; }

/// `a` where the condition holds, else `b`.
TRAJET_INLINE double where(bool condition, double a, double b) { return condition ? a : b; }

/// -1, 0 or 1; not-a-number stays.
TRAJET_INLINE double sign(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : x; }

TRAJET_INLINE double min(double a, double b) { return b < a ? b : a; }
TRAJET_INLINE double max(double a, double b) { return a < b ? b : a; }

/// Length of (x, y, z), by the plain formula: no overflow protection, the same rounding on every machine.
TRAJET_INLINE double norm3(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

// The same of extended precision, for constants and coefficients of power series.
inline bool less(Extended a, Extended b) { return a < b; }
inline bool less_equal(Extended a, Extended b) { return a <= b; }
inline bool equal(Extended a, Extended b) { return a == b; }
inline Extended where(bool condition, Extended a, Extended b) { return condition ? a : b; }
inline Extended min(Extended a, Extended b) { return b < a ? b : a; }
inline Extended max(Extended a, Extended b) { return a < b ? b : a; }
inline double sign(Extended x) { return x > 0.0L ? 1.0 : x < 0.0L ? -1.0 : static_cast<double>(x); }
inline Extended norm3(Extended x, Extended y, Extended z) { return std::sqrt(x * x + y * y + z * z); }

/// The angle of the point (x, y), from -pi to pi, by a y of which the side of zero is known better than by its own
/// digits.
///
/// \param side  -1 or 1; 0: y itself tells
template <class T>
T angle_on_side(T y, T x, double side) {
  const T angle = std::atan2(y, x);
  return side != 0.0 && x < 0.0 ? std::copysign(angle, static_cast<T>(side)) : angle;
}

/// The plain number that constant factors of a number type have: none may be coarser than the type.
template <class T>
using Factor = std::conditional_t<std::is_same_v<T, Extended>, Extended, double>;

}  // namespace trajet
