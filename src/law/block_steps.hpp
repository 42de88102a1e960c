#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "block_program.hpp"
#include "trajet/math/block4.hpp"
#include "trajet/math/force_inline.hpp"
#include "trajet/math/recurrences.hpp"

/// The executor of a BlockProgram: the n-th Taylor coefficient of each of its instructions. That of order 0 is the
/// value, so that this is what evaluates rates, too.
///
/// Registers: the result of one instruction stays in one, the *newest*, for the next, which mostly needs it; its way
/// through memory, which others take, would be longer than the operation. Which operand is the newest one is a part of
/// the code. The sums over lower coefficients read what has been in memory for long, and wait for nothing.
namespace trajet::detail {

/// Order 0 for those who want no other: what the others need of it is left out.
struct ValueOnly : std::integral_constant<int, 0> {};
template <class Order>
inline constexpr bool kHasMore = !std::is_same_v<Order, ValueOnly>;

/// A BlockInstruction with where its numbers are: rows of coefficients, one block each.
struct BlockStep {
  /// a, b: an operand from memory; x: the newest.
  enum class Code : std::uint8_t {
    scalar,
    unpack,
    collect,
    permute_a,
    permute_x,
    add_ab,
    add_xb,
    add_ax,
    multiply_ab,
    multiply_xb,
    square_a,
    square_x,
    multiply_constant_a,
    multiply_constant_x,
    divide_constant_a,
    divide_constant_x,
    divide_ab,
    divide_xb,
    divide_ax,
    norm_a,
    norm_x,
    dot_ab,
    dot_aa,
    dot_xx,
    integrate_a,  ///< the next coefficient of a state from its rate a
    integrate_x,
    copy_a,  ///< a beside the newest, which stays
  };
  Block4 constant{0.0};  ///< of a quotient by constants: their inverses, from order 1 on
  /// What is needed from order 1 on and known from order 0: the inverse of a divisor, of twice a length. Of a quotient
  /// by constants: them. Of a permutation: its lanes, as bits.
  Block4 own{0.0};
  Block4* result = nullptr;   ///< row; of `integrate` the one whose rate a is
  const Block4* a = nullptr;  ///< rows
  const Block4* b = nullptr;
  double* slot = nullptr;  ///< row of a slot: that of `unpack`, and the length
  int index = 0;           ///< of an instruction of the Program, of a lane, of `Sources`
  Code code = Code::scalar;
};

/// Where a `collect` has its lanes from: coefficient n lies at row[n * stride].
struct Sources {
  std::array<const double*, 4> row{};
  std::array<std::ptrdiff_t, 4> stride{};
};

/// The sum of the first three lanes.
TRAJET_INLINE double sum_of_vector(const Block4& a) { return a[0] + a[1] + a[2]; }

/// (a b)[n], the newest coefficients apart.
template <class Order>
TRAJET_INLINE Block4 product(const Block4* a, const Block4* b, const Block4& a_n, const Block4& b_n, Order n) {
  if (n == 0) return a_n * b_n;
  return (recurrence::convolution(a, b, 1, n - 1, n) + a[0] * b_n) + a_n * b[0];
}

/// (a^2)[n]
template <class Order>
TRAJET_INLINE Block4 square(const Block4* a, const Block4& a_n, Order n) {
  if (n == 0) return a_n * a_n;
  Block4 sum = recurrence::convolution(a, a, 1, (n - 1) / 2, n);
  sum = sum + sum;
  if (n % 2 == 0) sum += a[n / 2] * a[n / 2];
  return sum + (2.0 * a[0]) * a_n;
}

/// (a / b)[n], by the inverse of b[0] from order 1 on: a division at every order would lengthen the chain of dependent
/// operations. `c` are the quotient's coefficients below n.
template <class Order>
TRAJET_INLINE Block4 quotient(const Block4& a_n, const Block4* b, const Block4& b_n, const Block4* c, Block4& inverse,
                              Order n) {
  if (n == 0) {
    const Block4 value = a_n / b_n;
    if constexpr (kHasMore<Order>) inverse = Block4(1.0) / b_n;
    return value;
  }
  if (n == 1) return (a_n - b_n * c[0]) * inverse;
  const Block4 known = recurrence::convolution(b, c, 2, n - 1, n) + b[1] * c[n - 1];
  return ((a_n - known) - b_n * c[0]) * inverse;
}

/// |a|[n] of the first three lanes: s[n] = ((a · a)[n] - sum_{k=1..n-1} s[k] s[n - k]) / (2 s[0]).
template <class Order>
TRAJET_INLINE double length(const Block4* a, const Block4& a_n, const double* s, Block4& half_inverse, Order n) {
  if (n == 0) {
    const double value = norm3(a_n[0], a_n[1], a_n[2]);
    if constexpr (kHasMore<Order>) half_inverse = Block4(0.5 / value);
    return value;
  }
  double sum = recurrence::convolution(s, s, 1, (n - 1) / 2, n);
  sum = sum + sum;
  if (n % 2 == 0) sum += s[n / 2] * s[n / 2];
  return (sum_of_vector(square(a, a_n, n)) - sum) * half_inverse[0];
}

/// Coefficient `n` of all steps, before which `first` is the newest, and `n` + 1 of what is integrated: `factor` times
/// that of its rate. `scalar(index)` computes that of an instruction of the Program. Returns whether, at order 0, no
/// length vanished: else its series is none of this kind.
template <class Order, class Scalar>
TRAJET_INLINE bool run_block_steps(std::vector<BlockStep>& steps, const std::vector<Sources>& sources,
                                   const Block4* first, Order n, double factor, Scalar&& scalar) {
  using Code = BlockStep::Code;
  Block4 x = first[n];
  bool is_regular = true;
  for (BlockStep& step : steps) {
    const Block4 *const a = step.a, *const b = step.b;
    switch (step.code) {
      case Code::scalar:
        scalar(step.index);
        continue;
      case Code::unpack:
        step.slot[n] = a[n][step.index];
        continue;
      case Code::collect: {
        const auto& [row, stride] = sources[static_cast<std::size_t>(step.index)];
        x = Block4(row[0][n * stride[0]], row[1][n * stride[1]], row[2][n * stride[2]], row[3][n * stride[3]]);
        break;
      }
      case Code::permute_a:
        x = a[n].permuted(step.own);
        break;
      case Code::permute_x:
        x = x.permuted(step.own);
        break;
      case Code::add_ab:
        x = a[n] + step.constant * b[n];
        break;
      case Code::add_xb:
        x = x + step.constant * b[n];
        break;
      case Code::add_ax:
        x = a[n] + step.constant * x;
        break;
      case Code::multiply_ab:
        x = product(a, b, a[n], b[n], n);
        break;
      case Code::multiply_xb:
        x = product(a, b, x, b[n], n);
        break;
      case Code::square_a:
        x = square(a, a[n], n);
        break;
      case Code::square_x:
        x = square(a, x, n);
        break;
      case Code::multiply_constant_a:
        x = step.constant * a[n];
        break;
      case Code::multiply_constant_x:
        x = step.constant * x;
        break;
      case Code::divide_constant_a:
        x = n == 0 ? a[n] / step.own : a[n] * step.constant;
        break;
      case Code::divide_constant_x:
        x = n == 0 ? x / step.own : x * step.constant;
        break;
      case Code::divide_ab:
        x = quotient(a[n], b, b[n], step.result, step.own, n);
        break;
      case Code::divide_xb:
        x = quotient(x, b, b[n], step.result, step.own, n);
        break;
      case Code::divide_ax:
        x = quotient(a[n], b, x, step.result, step.own, n);
        break;
      case Code::norm_a:
        x = Block4(step.slot[n] = length(a, a[n], step.slot, step.own, n));
        if (n == 0 && x[0] == 0.0) is_regular = false;
        break;
      case Code::norm_x:
        x = Block4(step.slot[n] = length(a, x, step.slot, step.own, n));
        if (n == 0 && x[0] == 0.0) is_regular = false;
        break;
      case Code::dot_ab:
        x = Block4(step.slot[n] = sum_of_vector(product(a, b, a[n], b[n], n)));
        break;
      case Code::dot_aa:
        x = Block4(step.slot[n] = sum_of_vector(square(a, a[n], n)));
        break;
      case Code::dot_xx:
        x = Block4(step.slot[n] = sum_of_vector(square(a, x, n)));
        break;
      case Code::copy_a:
        step.result[n] = a[n];
        continue;
      case Code::integrate_a:
        step.result[n + 1] = factor * a[n];
        continue;
      case Code::integrate_x:
        step.result[n + 1] = factor * x;
        continue;
    }
    step.result[n] = x;
  }
  return is_regular;
}

}  // namespace trajet::detail
