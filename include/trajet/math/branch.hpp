#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

namespace trajet {

/// When a function that decides a law's branch changes sign.
struct BranchTime {
  double duration;    ///< from the point of expansion, signed like the search; where nothing was found, how far the
                      ///< series tells: at most the whole search
  int index;          ///< which function: >= 0 where a change was found, else negative
  double sign_after;  ///< behind the change
};

/// The first time from 0 to `duration` (of either sign) at which the function f(t) = sum_k series[k] t^k leaves the
/// sign that a law has counted on.
///
/// \param sign            -1, 0 or 1: the sign counted on. 0 stays true only of a function that vanishes.
/// \param starts_at_zero  f(0) is zero but for rounding: the search has just come from a root there.
/// \return index 0 and the time of the change, which is 0 where the sign just behind the start is another one already.
BranchTime first_sign_change(std::span<const double> series, double sign, bool starts_at_zero, double duration);

namespace detail {

/// The first `size` of `coefficients` as first_sign_change reads them: rounded into `room` where they are not doubles.
template <class T, std::size_t Size>
std::span<const double> in_doubles(const T* coefficients, int size, std::array<double, Size>& room) {
  if constexpr (std::is_same_v<T, double>) return {coefficients, static_cast<std::size_t>(size)};
  std::transform(coefficients, coefficients + size, room.begin(), [](T c) { return static_cast<double>(c); });
  return std::span(room).first(static_cast<std::size_t>(size));
}

}  // namespace detail

}  // namespace trajet
