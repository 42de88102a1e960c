#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

#include "trajet/ode/tableau.hpp"

namespace trajet {
namespace {

// Everything here is exact: the tableaus are fractions and so is the arithmetic.
using Rational = boost::multiprecision::cpp_rational;

Rational rational(const Fraction& fraction) { return Rational(fraction.numerator, fraction.denominator); }

/// A rooted tree: each stands for one order condition, [HairerNorsettWanner1993] II.2.
struct Tree {
  std::vector<Tree> branches;

  int order() const {
    int sum = 1;
    for (const Tree& branch : branches) sum += branch.order();
    return sum;
  }
  /// gamma(t): the order times the densities of the branches.
  Rational density() const {
    Rational product = order();
    for (const Tree& branch : branches) product *= branch.density();
    return product;
  }
};

/// Appends to `forest` every multiset of trees out of `trees[first..]` with `nodes` nodes in all.
void append_forests(const std::vector<Tree>& trees, std::size_t first, int nodes, std::vector<Tree> chosen,
                    std::vector<std::vector<Tree>>& forests) {
  if (nodes == 0) forests.push_back(chosen);
  for (std::size_t i = first; i < trees.size(); ++i) {
    if (trees[i].order() > nodes) continue;
    chosen.push_back(trees[i]);
    append_forests(trees, i, nodes - trees[i].order(), chosen, forests);
    chosen.pop_back();
  }
}

std::vector<Tree> trees_up_to(int order) {
  std::vector<Tree> trees;
  for (int n = 1; n <= order; ++n) {
    std::vector<std::vector<Tree>> forests;
    append_forests(trees, 0, n - 1, {}, forests);
    for (auto& forest : forests) trees.push_back({forest});
  }
  return trees;
}

template <class Method>
struct Exact {
  static constexpr auto& kTableau = Method::kTableau;
  static constexpr std::size_t kStages = static_cast<std::size_t>(kTableau.kStages);
  using Weights = std::array<Rational, kStages>;

  static Weights weights(const std::array<Fraction, kStages>& fractions) {
    Weights result;
    for (std::size_t i = 0; i < kStages; ++i) result[i] = rational(fractions[i]);
    return result;
  }
  static Weights dense_column(std::size_t power) {
    Weights result;
    for (std::size_t i = 0; i < kStages; ++i) result[i] = rational(kTableau.dense[i][power - 1]);
    return result;
  }

  /// The factor of each stage in the elementary weight of a tree: the product over the branches of sum_j a_ij factor_j.
  static Weights factors(const Tree& tree) {
    Weights result;
    result.fill(1);
    for (const Tree& branch : tree.branches) {
      const Weights inner = factors(branch);
      for (std::size_t i = 0; i < kStages; ++i) {
        Rational sum = 0;
        for (std::size_t j = 0; j < i; ++j) sum += rational(kTableau.a[i][j]) * inner[j];
        result[i] *= sum;
      }
    }
    return result;
  }

  static Rational elementary_weight(const Weights& b, const Tree& tree) {
    const Weights phi = factors(tree);
    Rational sum = 0;
    for (std::size_t i = 0; i < kStages; ++i) sum += b[i] * phi[i];
    return sum;
  }

  /// Whether all conditions of exactly that order hold.
  static bool meets_order(const Weights& b, int order) {
    for (const Tree& tree : trees_up_to(order))
      if (tree.order() == order && elementary_weight(b, tree) != 1 / tree.density()) return false;
    return true;
  }
  static int highest_order(const Weights& b) {
    int order = 0;
    while (order < 8 && meets_order(b, order + 1)) ++order;
    return order;
  }
};

TEST(Trees, AreAsManyAsCayleySays) {
  std::array<int, 7> count{};
  for (const Tree& tree : trees_up_to(6)) ++count[static_cast<std::size_t>(tree.order())];
  EXPECT_EQ(count, (std::array<int, 7>{0, 1, 1, 2, 4, 9, 20}));
}

template <class Method>
class OrderConditions : public testing::Test {};

using Tableaus = testing::Types<EulerTableau, MidpointTableau, Rk4Tableau, Dopri5Tableau>;
TYPED_TEST_SUITE(OrderConditions, Tableaus);

TYPED_TEST(OrderConditions, MethodHasItsOrderAndNoMore) {
  using E = Exact<TypeParam>;
  EXPECT_EQ(E::highest_order(E::weights(E::kTableau.b)), TypeParam::kOrder);
}

TYPED_TEST(OrderConditions, CompanionHasItsOrderAndNoMore) {
  using E = Exact<TypeParam>;
  EXPECT_EQ(E::highest_order(E::weights(E::kTableau.companion)), TypeParam::kCompanionOrder);
}

TYPED_TEST(OrderConditions, StageTimesAreTheRowSums) {
  using E = Exact<TypeParam>;
  for (std::size_t i = 0; i < E::kStages; ++i) {
    Rational sum = 0;
    for (std::size_t j = 0; j < E::kStages; ++j) {
      sum += rational(E::kTableau.a[i][j]);
      EXPECT_TRUE(j < i || rational(E::kTableau.a[i][j]) == 0) << "not explicit";
    }
    EXPECT_EQ(sum, rational(E::kTableau.c[i]));
  }
}

TYPED_TEST(OrderConditions, LastStageIsTheRateAtTheEnd) {
  using E = Exact<TypeParam>;
  EXPECT_EQ(E::weights(E::kTableau.a[E::kStages - 1]), E::weights(E::kTableau.b));
}

// sum_i b_i(s) phi_i(t) = s^order / gamma(t) for every s: the coefficient of s^order is 1/gamma, all others vanish.
TYPED_TEST(OrderConditions, DenseOutputHasItsOrderForEveryTime) {
  using E = Exact<TypeParam>;
  for (const Tree& tree : trees_up_to(TypeParam::kDenseOrder)) {
    for (std::size_t power = 1; power <= static_cast<std::size_t>(E::kTableau.kDenseDegree); ++power) {
      const Rational expected = static_cast<int>(power) == tree.order() ? Rational(1 / tree.density()) : Rational(0);
      EXPECT_EQ(E::elementary_weight(E::dense_column(power), tree), expected) << "order " << tree.order();
    }
  }
}

TYPED_TEST(OrderConditions, DenseOutputStartsWithTheRateAndEndsInTheState) {
  using E = Exact<TypeParam>;
  for (std::size_t i = 0; i < E::kStages; ++i) {
    Rational sum = 0;
    for (std::size_t power = 1; power <= static_cast<std::size_t>(E::kTableau.kDenseDegree); ++power)
      sum += E::dense_column(power)[i];
    EXPECT_EQ(sum, rational(E::kTableau.b[i]));
    EXPECT_EQ(E::dense_column(1)[i], i == 0 ? 1 : 0);
  }
}

template <class Method>
class SmoothDenseOutput : public testing::Test {};
using SmoothTableaus = testing::Types<Rk4Tableau, Dopri5Tableau>;
TYPED_TEST_SUITE(SmoothDenseOutput, SmoothTableaus);

TYPED_TEST(SmoothDenseOutput, EndsWithTheRateAtTheEnd) {
  using E = Exact<TypeParam>;
  for (std::size_t i = 0; i < E::kStages; ++i) {
    Rational slope = 0;
    for (std::size_t power = 1; power <= static_cast<std::size_t>(E::kTableau.kDenseDegree); ++power)
      slope += static_cast<int>(power) * E::dense_column(power)[i];
    EXPECT_EQ(slope, i == E::kStages - 1 ? 1 : 0);
  }
}

}  // namespace
}  // namespace trajet
