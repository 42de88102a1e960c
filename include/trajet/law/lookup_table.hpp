#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <limits>
#include <type_traits>
#include <vector>

#include "trajet/math/number.hpp"

namespace trajet {

/// A function given by points: `table("drag", x)` of the expressions, which know it by its name.
///
/// A cubic between neighbouring points whose slopes keep it monotone where the points are (Fritsch and Butland 1984,
/// the method `pchip`): the value and the slope are continuous, and it never overshoots. Two points make a straight
/// line. Outside the points it is not-a-number: a run that leaves its data fails rather than makes up values.
class LookupTable {
 public:
  /// y = c0 + c1 u + c2 u^2 + c3 u^3 with u = x - begin, for x between this cell's begin and the next one's.
  struct Cell {
    double begin;
    double c0, c1, c2, c3;
  };

  /// At least two points, x rising, all finite: else std::invalid_argument.
  LookupTable(const std::vector<double>& x, const std::vector<double>& y);

  double first() const { return cells_.front().begin; }
  double last() const { return last_; }
  bool contains(double x) const { return x >= first() && x <= last(); }

  int cell_count() const { return static_cast<int>(cells_.size()); }
  const Cell& cell(int index) const { return cells_[static_cast<std::size_t>(index)]; }
  /// The x at which the cell ends.
  double cell_end(int index) const { return index + 1 < cell_count() ? cell(index + 1).begin : last_; }

  /// The cell that x lies in; at a point, the cell behind it, at the last point the last cell. Outside, the nearest.
  int find_cell(double x) const {
    const auto behind = std::upper_bound(cells_.begin() + 1, cells_.end(), x,
                                         [](double value, const Cell& cell) { return value < cell.begin; });
    return static_cast<int>(behind - cells_.begin()) - 1;
  }

  /// The value for any number type. Where x is not known to lie in one cell, what `where` makes of all it may lie in.
  template <class T>
  T operator()(const T& x) const;

 private:
  template <class T>
  static T evaluate_cell(const Cell& cell, const T& x) {
    const T u = x - T(cell.begin);
    return ((T(cell.c3) * u + T(cell.c2)) * u + T(cell.c1)) * u + T(cell.c0);
  }

  /// `a` where the condition holds, else `b`, of neighbouring cells: values and slopes agree where they meet.
  template <class Condition, class T>
  static T join(const Condition& condition, const T& a, const T& b) {
    if constexpr (requires {
                    { where_smooth(condition, a, b) } -> std::same_as<T>;
                  }) {
      return where_smooth(condition, a, b);
    } else {
      return where(condition, a, b);
    }
  }

  std::vector<Cell> cells_;
  double last_;
};

namespace detail {

/// The smallest and the largest value that a number may have: of a Series or a Dual its value counts, of a Pack all
/// lanes.
struct Bounds {
  double lower;
  double upper;
};

template <class T>
Bounds bounds(const T& x) {
  if constexpr (std::is_floating_point_v<T>) {
    return {static_cast<double>(x), static_cast<double>(x)};
  } else if constexpr (requires { x.lower(), x.upper(); }) {
    return {x.lower(), x.upper()};
  } else if constexpr (requires { typename T::Coefficient; }) {
    return bounds(x[0]);
  } else if constexpr (requires { x.value(); }) {
    return {x.value(), x.value()};
  } else {
    std::array<double, T::size> lanes;
    x.store_unaligned(lanes.data());
    const auto [lower, upper] = std::minmax_element(lanes.begin(), lanes.end());
    return {*lower, *upper};
  }
}

}  // namespace detail

template <class T>
T LookupTable::operator()(const T& x) const {
  if constexpr (requires { T::transcendental(x); }) {
    return T::transcendental(x);  // PolynomialDegree
  } else {
    const detail::Bounds range = detail::bounds(x);
    const int lowest = find_cell(range.lower), highest = find_cell(range.upper);
    T y = evaluate_cell(cell(lowest), x);
    for (int i = lowest + 1; i <= highest; ++i) y = join(less(x, T(cell(i).begin)), y, evaluate_cell(cell(i), x));
    if (contains(range.lower) && contains(range.upper)) return y;
    const T outside(std::numeric_limits<double>::quiet_NaN());
    return where(less(x, T(first())), outside, where(less_equal(x, T(last())), y, outside));
  }
}

}  // namespace trajet
