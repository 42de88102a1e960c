#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "trajet/ode/tableau.hpp"

namespace trajet {

/// A rooted tree: each stands for one order condition, [HairerNorsettWanner1993] II.2.
struct Tree {
  std::vector<Tree> branches;

  int order() const {
    int sum = 1;
    for (const Tree& branch : branches) sum += branch.order();
    return sum;
  }
  /// gamma(t): the order times the densities of the branches.
  std::int64_t density() const {
    std::int64_t product = order();
    for (const Tree& branch : branches) product *= branch.density();
    return product;
  }
};

/// Appends to `forest` every multiset of trees out of `trees[first..]` with `nodes` nodes in all.
inline void append_forests(const std::vector<Tree>& trees, std::size_t first, int nodes, std::vector<Tree> chosen,
                           std::vector<std::vector<Tree>>& forests) {
  if (nodes == 0) forests.push_back(chosen);
  for (std::size_t i = first; i < trees.size(); ++i) {
    if (trees[i].order() > nodes) continue;
    chosen.push_back(trees[i]);
    append_forests(trees, i, nodes - trees[i].order(), chosen, forests);
    chosen.pop_back();
  }
}

inline std::vector<Tree> trees_up_to(int order) {
  std::vector<Tree> trees;
  for (int n = 1; n <= order; ++n) {
    std::vector<std::vector<Tree>> forests;
    append_forests(trees, 0, n - 1, {}, forests);
    for (auto& forest : forests) trees.push_back({forest});
  }
  return trees;
}

/// The order conditions of a tableau: with fractions everything is exact; printed digits are added in long double, and
/// conditions hold but for their rounding.
template <class Method>
struct Conditions {
  static constexpr auto& kTableau = Method::kTableau;
  static constexpr std::size_t kStages = static_cast<std::size_t>(kTableau.kStages);
  static constexpr std::size_t kAllStages = kStages + static_cast<std::size_t>(kTableau.kDenseStages);
  using Coefficient = std::remove_cvref_t<decltype(kTableau.b[0])>;
  static constexpr bool kIsExact = std::is_same_v<Coefficient, Fraction>;
  using Number = std::conditional_t<kIsExact, boost::multiprecision::cpp_rational, long double>;
  using Weights = std::array<Number, kAllStages>;

  static Number number(const Coefficient& coefficient) {
    if constexpr (kIsExact)
      return Number(coefficient.numerator, coefficient.denominator);
    else
      return coefficient.digits;
  }

  /// Sums of weights up to a few hundred, of 64 bits: deviations up to 8e-16 are measured.
  static bool are_equal(const Number& x, const Number& y) {
    if constexpr (kIsExact)
      return x == y;
    else
      return std::abs(x - y) < 3e-15L;
  }

  /// Weights of the first stages; the others' are zero.
  template <std::size_t Size>
  static Weights weights(const std::array<Coefficient, Size>& coefficients) {
    Weights result{};
    for (std::size_t i = 0; i < Size; ++i) result[i] = number(coefficients[i]);
    return result;
  }

  /// The weights of s^power in the dense output.
  static Weights dense_column(std::size_t power) {
    Weights result{};
    for (std::size_t i = 0; i < kAllStages; ++i) {
      if constexpr (requires { Method::kDenseBasis; }) {
        for (std::size_t f = 0; f < Method::kDenseBasis.size(); ++f)
          result[i] += Method::kDenseBasis[f][power - 1] * number(kTableau.dense[i][f]);
      } else {
        result[i] = number(kTableau.dense[i][power - 1]);
      }
    }
    return result;
  }

  /// The factor of each stage in the elementary weight of a tree: the product over the branches of sum_j a_ij factor_j.
  static Weights factors(const Tree& tree) {
    Weights result;
    result.fill(1);
    for (const Tree& branch : tree.branches) {
      const Weights inner = factors(branch);
      for (std::size_t i = 0; i < kAllStages; ++i) {
        Number sum = 0;
        for (std::size_t j = 0; j < i; ++j) sum += number(kTableau.a[i][j]) * inner[j];
        result[i] *= sum;
      }
    }
    return result;
  }

  static Number elementary_weight(const Weights& b, const Tree& tree) {
    const Weights phi = factors(tree);
    Number sum = 0;
    for (std::size_t i = 0; i < kAllStages; ++i) sum += b[i] * phi[i];
    return sum;
  }

  /// Whether all conditions of exactly that order hold.
  static bool meets_order(const Weights& b, int order) {
    for (const Tree& tree : trees_up_to(order))
      if (tree.order() == order && !are_equal(elementary_weight(b, tree), Number(1) / tree.density())) return false;
    return true;
  }
  static int highest_order(const Weights& b) {
    int order = 0;
    while (order < 9 && meets_order(b, order + 1)) ++order;
    return order;
  }
};

}  // namespace trajet
