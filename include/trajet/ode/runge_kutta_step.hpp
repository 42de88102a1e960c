#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>

#include "trajet/math/force_inline.hpp"
#include "trajet/ode/tableau.hpp"

namespace trajet::detail {

/// Up to this dimension the loops over components are unrolled, so that a step lives in registers.
inline constexpr int kMaxUnrolledDimension = 16;

template <int Dim>
inline constexpr bool kIsUnrolled = Dim != Eigen::Dynamic&& Dim <= kMaxUnrolledDimension;

/// Calls f(i) for each component.
template <int Dim, class F>
TRAJET_INLINE void for_each_component(Eigen::Index dimension, F&& f) {
  if constexpr (kIsUnrolled<Dim>) {
    [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) { (f(Eigen::Index{I}), ...); }
    (std::make_integer_sequence<int, Dim>{});
  } else {
    for (Eigen::Index i = 0; i < dimension; ++i) f(i);
  }
}

/// Copies component by component. A packet copy of numbers that were just written one by one would wait for the cache.
template <int Dim, class State>
TRAJET_INLINE void copy_state(const State& from, State& to) {
  for_each_component<Dim>(
      from.size(), [&](Eigen::Index i) __attribute__((always_inline)) { to[i] = from[i]; });
}

/// The numbers of one step of the explicit Runge-Kutta method `Method` (a tableau such as Rk4Tableau).
///
/// The law is inlined into every stage, all loops over stages are unrolled, and zero coefficients leave no trace.
template <class Method, int Dim>
struct RungeKuttaStep {
  using State = Eigen::Matrix<double, Dim, 1>;
  static constexpr auto& kTableau = Method::kTableau;
  static constexpr std::size_t kStages = kTableau.kStages;
  static constexpr std::size_t kLast = kStages - 1;
  static_assert(kTableau.a[kLast] == kTableau.b && kTableau.c[kLast] == Fraction(1), "the last stage is the end rate");

  template <std::size_t Stage>
  struct StageWeights {
    static constexpr double value(std::size_t j) { return kTableau.a[Stage][j].value(); }
  };
  struct ErrorWeights {
    static constexpr double value(std::size_t j) { return kTableau.b[j].value() - kTableau.companion[j].value(); }
  };
  template <std::size_t Power>
  struct DenseWeights {
    static constexpr double value(std::size_t j) { return kTableau.dense[j][Power - 1].value(); }
  };

  double t0 = 0.0;
  double t1 = 0.0;
  State q0;
  State q1;
  std::array<State, kStages> k;
  State q_stage;

  double duration() const { return t1 - t0; }

  /// From t0, t1, q0 and the first stage: the other stages but the last, and q1.
  template <class Rate>
  TRAJET_INLINE void compute(Rate& rate) {
    [&]<std::size_t... S>(std::index_sequence<S...>) __attribute__((always_inline)) {
      (compute_stage<S + 1>(rate), ...);
    }
    (std::make_index_sequence<kStages - 2>{});
    const double h = duration();
    for_each_component<Dim>(
        q0.size(), [&](Eigen::Index i) __attribute__((always_inline)) {
          // The newest stage comes last and alone: all the rest is summed while it is computed.
          const double rest = q0[i] + weighted<StageWeights<kLast>, 0, kLast - 1>(0.0, h, i);
          q1[i] = weighted<StageWeights<kLast>, kLast - 1, kLast>(rest, h, i);
        });
  }

  /// sum + scale * sum_j weight_j k_j[i] over From <= j < To.
  template <class Weights, std::size_t From = 0, std::size_t To = kStages>
  TRAJET_INLINE double weighted(double sum, double scale, Eigen::Index i) const {
    [&]<std::size_t... J>(std::index_sequence<J...>) __attribute__((always_inline)) {
      (add<Weights::value(From + J) != 0.0>(sum, scale * Weights::value(From + J), k[From + J], i), ...);
    }
    (std::make_index_sequence<To - From>{});
    return sum;
  }

  /// Estimated error of component `i` of q1, with its sign.
  TRAJET_INLINE double error(Eigen::Index i) const { return weighted<ErrorWeights>(0.0, duration(), i); }

 private:
  template <bool kNonZero>
  TRAJET_INLINE static void add(double& sum, double weight, const State& stage, Eigen::Index i) {
    if constexpr (kNonZero) sum += weight * stage[i];
  }

  template <std::size_t S, class Rate>
  TRAJET_INLINE void compute_stage(Rate& rate) {
    const double h = duration();
    for_each_component<Dim>(
        q0.size(), [&](Eigen::Index i)
                       __attribute__((always_inline)) { q_stage[i] = weighted<StageWeights<S>, 0, S>(q0[i], h, i); });
    constexpr double c = kTableau.c[S].value();
    rate(t0 + c * h, q_stage, k[S]);
  }
};

}  // namespace trajet::detail
