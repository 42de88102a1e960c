#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "trajet/math/force_inline.hpp"
#include "trajet/portable.hpp"

namespace trajet::detail {

/// Calls f(0), f(1), …, f(N - 1) without a loop.
template <int N, class F>
TRAJET_INLINE void unrolled(F&& f) {
  [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) { (f(Eigen::Index{I}), ...); }
  (std::make_integer_sequence<int, N>());
}

/// `N` doubles that are computed with at once; the compiler maps them to the machine's registers. N is a power of two.
template <int N>
struct LanesOf {
  typedef double Type __attribute__((vector_size(N * sizeof(double))));
  typedef std::int64_t Bits __attribute__((vector_size(N * sizeof(double))));
};

/// The largest of `N` integers, by halves.
template <int N>
TRAJET_INLINE std::int64_t largest_lane(const typename LanesOf<N>::Bits& x) {
  if constexpr (N == 2) {
    return std::max<std::int64_t>(x[0], x[1]);
  } else {
    return [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
      const typename LanesOf<N / 2>::Bits low = __builtin_shufflevector(x, x, I...);
      const typename LanesOf<N / 2>::Bits high = __builtin_shufflevector(x, x, (N / 2 + I)...);
      return largest_lane<N / 2>(low > high ? low : high);
    }
    (std::make_integer_sequence<int, N / 2>());
  }
}

/// A small state of fixed dimension as one block of lanes, unused lanes zero: a sum over states is one operation each.
template <int Dim>
class PackedState {
  static constexpr int kLanes = std::max(2, static_cast<int>(std::bit_ceil(static_cast<unsigned>(Dim))));
  using Bits = typename LanesOf<kLanes>::Bits;

 public:
  using State = Eigen::Matrix<double, Dim, 1>;
  using Block = typename LanesOf<kLanes>::Type;

  static constexpr Eigen::Index blocks() { return 1; }
  TRAJET_INLINE const Block& operator[](Eigen::Index) const { return lanes_; }
  TRAJET_INLINE Block& operator[](Eigen::Index) { return lanes_; }

  TRAJET_INLINE void assign(const State& q) {
    [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) { lanes_ = Block{q[I]...}; }
    (std::make_integer_sequence<int, Dim>());
  }
  /// Component i becomes f(i); lanes without a component become as the last one.
  template <class F>
  void fill(Eigen::Index, F&& f) {
    for (int i = 0; i < kLanes; ++i) lanes_[i] = f(Eigen::Index{std::min(i, Dim - 1)});
  }
  TRAJET_INLINE static void write(const Block& block, double* components, Eigen::Index) {
    std::memcpy(components, &block, Dim * sizeof(double));
  }

  TRAJET_INLINE static void take_magnitude(Block& x) {
    x = reinterpret_cast<Block>(reinterpret_cast<Bits>(x) & std::numeric_limits<std::int64_t>::max());
  }
  /// The bits of the largest magnitude. Numbers without a sign are in the order of their bits, and NaN is above all of
  /// them.
  TRAJET_INLINE static std::int64_t largest_magnitude_bits(const Block& x) {
    return largest_lane<kLanes>(reinterpret_cast<Bits>(x) & std::numeric_limits<std::int64_t>::max());
  }

 private:
  Block lanes_;
};

/// A state of any dimension; each component is a block. Same interface as PackedState.
template <int Dim>
class PlainState {
 public:
  using State = Eigen::Matrix<double, Dim, 1>;
  using Block = double;

  Eigen::Index blocks() const { return components_.size(); }
  TRAJET_INLINE const double& operator[](Eigen::Index i) const { return components_[i]; }
  TRAJET_INLINE double& operator[](Eigen::Index i) { return components_[i]; }

  State& components() { return components_; }
  void assign(const State& q) { components_ = q; }
  template <class F>
  void fill(Eigen::Index size, F&& f) {
    components_.resize(size);
    for (Eigen::Index i = 0; i < size; ++i) components_[i] = f(i);
  }
  TRAJET_INLINE static void write(double component, double* components, Eigen::Index i) { components[i] = component; }

  TRAJET_INLINE static void take_magnitude(double& x) { x = std::abs(x); }
  TRAJET_INLINE static std::int64_t largest_magnitude_bits(double x) { return bit_cast<std::int64_t>(std::abs(x)); }

 private:
  State components_;
};

template <int Dim>
inline constexpr bool kIsPacked = Dim != Eigen::Dynamic&& Dim <= 16;

template <int Dim>
using StepState = std::conditional_t<kIsPacked<Dim>, PackedState<kIsPacked<Dim> ? Dim : 1>, PlainState<Dim>>;

}  // namespace trajet::detail
