#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "trajet/math/block4.hpp"
#include "trajet/math/force_inline.hpp"
#include "trajet/ode/stepper.hpp"

/// What a step of the series method reads off its coefficients c(i, k), column-major, of any number of components: four
/// components at once, whose sums stay in registers from the first term to the last.
namespace trajet::detail {

template <class Lanes, class Number>
TRAJET_INLINE Lanes loaded(const Number* x) {
  if constexpr (std::is_same_v<Lanes, Block4>) {
    return Block4::loaded(x);
  } else {
    return *x;
  }
}
template <class Lanes, class Number>
TRAJET_INLINE void store(const Lanes& lanes, Number* x) {
  if constexpr (std::is_same_v<Lanes, Block4>) {
    lanes.store(x);
  } else {
    *x = lanes;
  }
}

/// Calls f.operator()<Lanes>(first component) for blocks of four components, and for each of the rest.
template <class Number, class F>
TRAJET_INLINE void for_each_part(Eigen::Index dimension, F&& f) {
  Eigen::Index i = 0;
  if constexpr (std::is_same_v<Number, double>)
    for (; i + Block4::kLanes <= dimension; i += Block4::kLanes) f.template operator()<Block4>(i);
  for (; i < dimension; ++i) f.template operator()<Number>(i);
}

/// `y` where x is not a number.
TRAJET_INLINE double larger(double x, double y) { return x > y ? x : y; }
TRAJET_INLINE double largest(double x, double y) { return larger(x, y); }
TRAJET_INLINE double largest(const Block4& x, double y) {
  return larger(larger(x[0], larger(x[1], y)), larger(x[2], larger(x[3], y)));
}
template <class Number>
TRAJET_INLINE Number sum(const Number& x) {
  return x;
}
TRAJET_INLINE double sum(const Block4& x) { return (x[0] + x[1]) + (x[2] + x[3]); }

template <class Lanes>
TRAJET_INLINE Lanes absolute_tolerances(const StepOptions& options, Eigen::Index first) {
  if constexpr (std::is_same_v<Lanes, Block4>) {
    if (options.component_atol == nullptr) return Block4(absolute_tolerance(options, first));
    return Block4(absolute_tolerance(options, first), absolute_tolerance(options, first + 1),
                  absolute_tolerance(options, first + 2), absolute_tolerance(options, first + 3));
  } else {
    return absolute_tolerance(options, first);
  }
}

/// The sizes of some terms at a step of length 1: max_i |c(i, k)| / (atol_i + rtol |c(i, 0)|).
struct TermSizes {
  double last = 0.0, last_but_one = 0.0;
  double middle = 0.0;     ///< the larger one of k = order / 2 and the one below
  bool is_finite = false;  ///< whether all rates and last terms are
};

template <class Coefficients>
TRAJET_INLINE TermSizes term_sizes(const Coefficients& series, const StepOptions& options) {
  const Eigen::Index dimension = series.rows(), order = series.cols() - 1;
  const double* const c = series.data();
  TermSizes sizes;
  double finite = 0.0;  // becomes not-a-number
  for_each_part<double>(
      dimension, [&]<class Lanes>(Eigen::Index i) __attribute__((always_inline)) {
        using std::abs;
        const auto term = [&](Eigen::Index k) __attribute__((always_inline)) {
          return loaded<Lanes>(c + k * dimension + i);
        };
        const Lanes weight = Lanes(1.0) / (absolute_tolerances<Lanes>(options, i) + Lanes(options.rtol) * abs(term(0)));
        const auto size = [&](Eigen::Index k) __attribute__((always_inline)) { return abs(term(k)) * weight; };
        sizes.last = largest(size(order), sizes.last);
        sizes.last_but_one = largest(size(order - 1), sizes.last_but_one);
        sizes.middle = largest(size(order / 2), largest(size(order / 2 - 1), sizes.middle));
        finite += sum(Lanes(0.0) * term(1) + Lanes(0.0) * term(order));
      });
  sizes.is_finite = finite == 0.0;
  return sizes;
}

/// bound_i = last |c(i, order)| h^order + rounding sum_k |c(i, k)| h^k
template <class Coefficients, class State>
TRAJET_INLINE void bound_errors(const Coefficients& series, double h, double last, double rounding, State& bound) {
  const Eigen::Index dimension = series.rows(), order = series.cols() - 1;
  const double* const c = series.data();
  for (Eigen::Index k = 0; k < order; ++k) last *= h;
  for_each_part<double>(
      dimension, [&]<class Lanes>(Eigen::Index i) __attribute__((always_inline)) {
        using std::abs;
        const auto size = [&](Eigen::Index k) __attribute__((always_inline)) {
          return abs(loaded<Lanes>(c + k * dimension + i));
        };
        Lanes sum = size(order);
        for (Eigen::Index k = order - 1; k >= 0; --k) sum = sum * Lanes(h) + size(k);
        store(Lanes(last) * size(order) + Lanes(rounding) * sum, bound.data() + i);
      });
}

/// The sum of the series at `tau` into q, by Horner's rule. What rounding takes from the sum of c(., 0) and its change
/// is left in `remainder`, which is a part of the change the next time. Returns whether q is finite.
template <class Number, class Coefficients, class State>
TRAJET_INLINE bool sum_series(const Coefficients& series, double tau, State& q, State& remainder) {
  const Eigen::Index dimension = series.rows(), order = series.cols() - 1;
  const Number* const c = series.data();
  Number finite = 0.0;
  for_each_part<Number>(
      dimension, [&]<class Lanes>(Eigen::Index i) __attribute__((always_inline)) {
        const auto term = [&](Eigen::Index k) __attribute__((always_inline)) {
          return loaded<Lanes>(c + k * dimension + i);
        };
        const Lanes time = Lanes(tau);
        Lanes value = term(order);
        for (Eigen::Index k = order - 1; k >= 1; --k) value = value * time + term(k);
        const Lanes start = term(0), change = value * time + loaded<Lanes>(remainder.data() + i);
        const Lanes end = start + change;
        store(end, q.data() + i);
        store(change - (end - start), remainder.data() + i);
        finite += sum(Lanes(0.0) * end);
      });
  return finite == 0.0;
}

}  // namespace trajet::detail
