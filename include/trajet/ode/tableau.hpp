#pragma once

#include <array>
#include <cstdint>

#include "trajet/portable.hpp"

namespace trajet {

/// An exact fraction. Tableaus are made of these, so that tests can check them without rounding.
struct Fraction {
  std::int64_t numerator = 0;
  std::int64_t denominator = 1;

  constexpr Fraction() = default;
  // Integers and initializer lists convert, so that a tableau reads as it is printed in a book.
  constexpr Fraction(std::int64_t n, std::int64_t d = 1) : numerator(n), denominator(d) {}

  /// The nearest double. Both parts stay below 2^53, so that the one division is the one rounding.
  constexpr double value() const { return static_cast<double>(numerator) / static_cast<double>(denominator); }
  /// Whether written alike: 1/2 is not 2/4.
  bool operator==(const Fraction&) const = default;
};

/// A coefficient that is no fraction, by the digits of its source.
struct Decimal {
  Extended digits = 0.0L;

  constexpr Decimal() = default;
  constexpr Decimal(Extended printed) : digits(printed) {}

  constexpr double value() const { return static_cast<double>(digits); }
  bool operator==(const Decimal&) const = default;
};

/// The coefficients of an explicit Runge-Kutta method with `Stages` stages and a dense output of degree `Degree`:
///
///     k_i    = g(t0 + c_i h, q0 + h sum_{j<i} a_ij k_j)
///     q1     = q0 + h sum_i b_i k_i
///     q(s h) = q0 + h sum_i (sum_{j=1..Degree} dense_ij s^j) k_i,  0 <= s <= 1
///     error  = h sum_i (b_i - companion_i) k_i
///
/// The last stage is always the rate at the end of the step: its row of `a` is `b`. It is the next step's first stage,
/// so that dense output and error estimate may use it at no cost. `DenseStages` more stages may follow, which only the
/// dense output needs. A method whose `kDenseBasis` names other functions than the powers of s, by their own powers,
/// gives `dense` in that basis. Source: [HairerNorsettWanner1993] II.1, II.4, II.6.
template <int Stages, int Degree, class Coefficient = Fraction, int DenseStages = 0>
struct Tableau {
  static constexpr int kStages = Stages;
  static constexpr int kDenseStages = DenseStages;
  static constexpr int kDenseDegree = Degree;

  std::array<Coefficient, Stages + DenseStages> c;
  std::array<std::array<Coefficient, Stages + DenseStages>, Stages + DenseStages> a;
  std::array<Coefficient, Stages> b;
  std::array<Coefficient, Stages> companion;
  std::array<std::array<Coefficient, Degree>, Stages + DenseStages> dense;
};

/// Whether a method's error is estimated with two companions, the second of lower order: where both differences are of
/// their leading powers, e1^2 / sqrt(e1^2 + (e2 / 10)^2) falls as fast as a method of order 8 needs
/// ([HairerNorsettWanner1993] II.10).
template <class Method>
inline constexpr bool kHasSecondCompanion = requires {
  Method::kSecondCompanion;
};

/// k: the error estimate of a step of length h behaves as h^k.
template <class Method>
constexpr int error_power() {
  constexpr int first = (Method::kOrder < Method::kCompanionOrder ? Method::kOrder : Method::kCompanionOrder) + 1;
  if constexpr (kHasSecondCompanion<Method>)
    return 2 * first - (Method::kSecondCompanionOrder + 1);
  else
    return first;
}

/// Euler's method. Its companion is the trapezoid with the rate at the end: the difference is the leading local error.
struct EulerTableau {
  static constexpr int kOrder = 1;
  static constexpr int kCompanionOrder = 2;
  static constexpr int kDenseOrder = 1;
  static constexpr bool kErrorControlled = false;
  static constexpr Tableau<2, 1> kTableau = {
      .c = {0, 1},
      .a = {{{}, {1}}},
      .b = {1, 0},
      .companion = {{{1, 2}, {1, 2}}},
      .dense = {{{1}, {0}}},
  };
};

/// The midpoint rule, Runge's method of order 2. Dense output: the parabola through q0, g0 and q1.
struct MidpointTableau {
  static constexpr int kOrder = 2;
  static constexpr int kCompanionOrder = 2;
  static constexpr int kDenseOrder = 2;
  static constexpr bool kErrorControlled = false;
  static constexpr Tableau<3, 2> kTableau = {
      .c = {{0, {1, 2}, 1}},
      .a = {{{}, {{{1, 2}}}, {0, 1}}},
      .b = {0, 1, 0},
      .companion = {{{1, 2}, 0, {1, 2}}},
      .dense = {{{1, -1}, {0, 1}, {0, 0}}},
  };
};

/// Heun's method of order 2: the mean of the rates at the start and at Euler's guess of the end. Dense output: the
/// parabola through q0, g0 and q1. The companion takes the rate at the end in place of that at the guess.
struct HeunTableau {
  static constexpr int kOrder = 2;
  static constexpr int kCompanionOrder = 2;
  static constexpr int kDenseOrder = 2;
  static constexpr bool kErrorControlled = false;
  static constexpr Tableau<3, 2> kTableau = {
      .c = {0, 1, 1},
      .a = {{{}, {1}, {{{1, 2}, {1, 2}}}}},
      .b = {{{1, 2}, {1, 2}, 0}},
      .companion = {{{1, 2}, 0, {1, 2}}},
      .dense = {{{{1, {-1, 2}}}, {{0, {1, 2}}}, {{0, 0}}}},
  };
};

/// The classical method of Kutta (1901). Dense output: the cubic through q0, g0, q1 and g1.
///
/// The companion takes the rate at the end in place of the fourth stage: it meets every condition of order 3, and of
/// order 4 all but sum b_i a_ij c_j^2 = 1/12.
struct Rk4Tableau {
  static constexpr int kOrder = 4;
  static constexpr int kCompanionOrder = 3;
  static constexpr int kDenseOrder = 3;
  static constexpr bool kErrorControlled = false;
  static constexpr Tableau<5, 3> kTableau = {
      .c = {{0, {1, 2}, {1, 2}, 1, 1}},
      .a = {{{}, {{{1, 2}}}, {{0, {1, 2}}}, {0, 0, 1}, {{{1, 6}, {1, 3}, {1, 3}, {1, 6}}}}},
      .b = {{{1, 6}, {1, 3}, {1, 3}, {1, 6}, 0}},
      .companion = {{{1, 6}, {1, 3}, {1, 3}, 0, {1, 6}}},
      .dense = {{{{1, {-3, 2}, {2, 3}}}, {{0, 1, {-2, 3}}}, {{0, 1, {-2, 3}}}, {{0, {1, 2}, {-1, 3}}}, {{0, -1, 1}}}},
  };
};

/// Kutta's second method of order 4, the 3/8 rule: smaller error terms than the classical one at the price of denser
/// weights, [HairerNorsettWanner1993] II.1 p. 138. Dense output: the cubic through q0, g0, q1 and g1.
///
/// The companion is the member of order 3 of the weights on these stages and the rate at the end that does without the
/// fourth stage.
struct Rk4ThreeEighthsTableau {
  static constexpr int kOrder = 4;
  static constexpr int kCompanionOrder = 3;
  static constexpr int kDenseOrder = 3;
  static constexpr bool kErrorControlled = false;
  static constexpr Tableau<5, 3> kTableau = {
      .c = {{0, {1, 3}, {2, 3}, 1, 1}},
      .a = {{{}, {{{1, 3}}}, {{{-1, 3}, 1}}, {1, -1, 1}, {{{1, 8}, {3, 8}, {3, 8}, {1, 8}}}}},
      .b = {{{1, 8}, {3, 8}, {3, 8}, {1, 8}, 0}},
      .companion = {{{1, 12}, {1, 2}, {1, 4}, 0, {1, 6}}},
      .dense = {{{{1, {-13, 8}, {3, 4}}},
                 {{0, {9, 8}, {-3, 4}}},
                 {{0, {9, 8}, {-3, 4}}},
                 {{0, {3, 8}, {-1, 4}}},
                 {{0, -1, 1}}}},
  };
};

/// Bogacki and Shampine's pair of orders 3 and 2 with four stages, [BogackiShampine1989]. Dense output: the cubic
/// through q0, g0, q1 and g1.
struct Bs32Tableau {
  static constexpr int kOrder = 3;
  static constexpr int kCompanionOrder = 2;
  static constexpr int kDenseOrder = 3;
  static constexpr bool kErrorControlled = true;
  static constexpr Tableau<4, 3> kTableau = {
      .c = {{0, {1, 2}, {3, 4}, 1}},
      .a = {{{}, {{{1, 2}}}, {{0, {3, 4}}}, {{{2, 9}, {1, 3}, {4, 9}}}}},
      .b = {{{2, 9}, {1, 3}, {4, 9}, 0}},
      .companion = {{{7, 24}, {1, 4}, {1, 3}, {1, 8}}},
      .dense = {{{{1, {-4, 3}, {5, 9}}}, {{0, 1, {-2, 3}}}, {{0, {4, 3}, {-8, 9}}}, {{0, -1, 1}}}},
  };
};

/// Dormand and Prince's pair of orders 5 and 4 with seven stages, [DormandPrince1980] p. 23, RK5(4)7M.
/// Dense output of order 4, once continuously differentiable: [Shampine1986], in the form of [HairerNorsettWanner1993]
/// II.6 (6.12) collected by powers.
struct Dopri5Tableau {
  static constexpr int kOrder = 5;
  static constexpr int kCompanionOrder = 4;
  static constexpr int kDenseOrder = 4;
  static constexpr bool kErrorControlled = true;
  static constexpr Tableau<7, 4> kTableau = {
      .c = {{0, {1, 5}, {3, 10}, {4, 5}, {8, 9}, 1, 1}},
      .a = {{{},
             {{{1, 5}}},
             {{{3, 40}, {9, 40}}},
             {{{44, 45}, {-56, 15}, {32, 9}}},
             {{{19372, 6561}, {-25360, 2187}, {64448, 6561}, {-212, 729}}},
             {{{9017, 3168}, {-355, 33}, {46732, 5247}, {49, 176}, {-5103, 18656}}},
             {{{35, 384}, 0, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}}}}},
      .b = {{{35, 384}, 0, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}, 0}},
      .companion = {{{5179, 57600}, 0, {7571, 16695}, {393, 640}, {-92097, 339200}, {187, 2100}, {1, 40}}},
      .dense = {{{{1, {-8048581381, 2820520608}, {8663915743, 2820520608}, {-12715105075, 11282082432}}},
                 {},
                 {{0, {131558114200, 32700410799}, {-68118460800, 10900136933}, {87487479700, 32700410799}}},
                 {{0, {-1754552775, 470086768}, {14199869525, 1410260304}, {-10690763975, 1880347072}}},
                 {{0, {127303824393, 49829197408}, {-318862633887, 49829197408}, {701980252875, 199316789632}}},
                 {{0, {-282668133, 205662961}, {2019193451, 616988883}, {-1453857185, 822651844}}},
                 {{0, {40617522, 29380423}, {-110615467, 29380423}, {69997945, 29380423}}}}},
  };
};

}  // namespace trajet
