#include "methods/order_conditions.hpp"

#include <gtest/gtest.h>

#include "trajet/ode/tableau_dop853.hpp"

namespace trajet {
namespace {

TEST(Trees, AreAsManyAsCayleySays) {
  std::array<int, 7> count{};
  for (const Tree& tree : trees_up_to(6)) ++count[static_cast<std::size_t>(tree.order())];
  EXPECT_EQ(count, (std::array<int, 7>{0, 1, 1, 2, 4, 9, 20}));
}

template <class Method>
class OrderConditions : public testing::Test {};

using Tableaus = testing::Types<EulerTableau, MidpointTableau, HeunTableau, Rk4Tableau, Rk4ThreeEighthsTableau,
                                Bs32Tableau, Dopri5Tableau, Dop853Tableau>;
TYPED_TEST_SUITE(OrderConditions, Tableaus);

TYPED_TEST(OrderConditions, MethodHasItsOrderAndNoMore) {
  using E = Conditions<TypeParam>;
  EXPECT_EQ(E::highest_order(E::weights(E::kTableau.b)), TypeParam::kOrder);
}

TYPED_TEST(OrderConditions, CompanionHasItsOrderAndNoMore) {
  using E = Conditions<TypeParam>;
  EXPECT_EQ(E::highest_order(E::weights(E::kTableau.companion)), TypeParam::kCompanionOrder);
}

TEST(Dop853, SecondCompanionIsOfOrderThree) {
  using E = Conditions<Dop853Tableau>;
  EXPECT_EQ(E::highest_order(E::weights(Dop853Tableau::kSecondCompanion)), Dop853Tableau::kSecondCompanionOrder);
}

TYPED_TEST(OrderConditions, StageTimesAreTheRowSums) {
  using E = Conditions<TypeParam>;
  for (std::size_t i = 0; i < E::kAllStages; ++i) {
    typename E::Number sum = 0;
    for (std::size_t j = 0; j < E::kAllStages; ++j) {
      sum += E::number(E::kTableau.a[i][j]);
      EXPECT_TRUE(j < i || E::number(E::kTableau.a[i][j]) == 0) << "not explicit";
    }
    EXPECT_TRUE(E::are_equal(sum, E::number(E::kTableau.c[i]))) << "stage " << i;
  }
}

TYPED_TEST(OrderConditions, LastStageIsTheRateAtTheEnd) {
  using E = Conditions<TypeParam>;
  EXPECT_EQ(E::weights(E::kTableau.a[E::kStages - 1]), E::weights(E::kTableau.b));
}

// sum_i b_i(s) phi_i(t) = s^order / gamma(t) for every s: the coefficient of s^order is 1/gamma, all others vanish.
TYPED_TEST(OrderConditions, DenseOutputHasItsOrderForEveryTime) {
  using E = Conditions<TypeParam>;
  for (const Tree& tree : trees_up_to(TypeParam::kDenseOrder)) {
    for (std::size_t power = 1; power <= static_cast<std::size_t>(E::kTableau.kDenseDegree); ++power) {
      typename E::Number expected = 0;
      if (static_cast<int>(power) == tree.order()) expected = typename E::Number(1) / tree.density();
      EXPECT_TRUE(E::are_equal(E::elementary_weight(E::dense_column(power), tree), expected))
          << "order " << tree.order() << ", s^" << power;
    }
  }
}

TYPED_TEST(OrderConditions, DenseOutputStartsWithTheRateAndEndsInTheState) {
  using E = Conditions<TypeParam>;
  const auto b = E::weights(E::kTableau.b);
  for (std::size_t i = 0; i < E::kAllStages; ++i) {
    typename E::Number sum = 0;
    for (std::size_t power = 1; power <= static_cast<std::size_t>(E::kTableau.kDenseDegree); ++power)
      sum += E::dense_column(power)[i];
    EXPECT_TRUE(E::are_equal(sum, b[i]));
    EXPECT_TRUE(E::are_equal(E::dense_column(1)[i], i == 0 ? 1 : 0));
  }
}

template <class Method>
class SmoothDenseOutput : public testing::Test {};
using SmoothTableaus = testing::Types<Rk4Tableau, Rk4ThreeEighthsTableau, Bs32Tableau, Dopri5Tableau, Dop853Tableau>;
TYPED_TEST_SUITE(SmoothDenseOutput, SmoothTableaus);

TYPED_TEST(SmoothDenseOutput, EndsWithTheRateAtTheEnd) {
  using E = Conditions<TypeParam>;
  for (std::size_t i = 0; i < E::kAllStages; ++i) {
    typename E::Number slope = 0;
    for (std::size_t power = 1; power <= static_cast<std::size_t>(E::kTableau.kDenseDegree); ++power)
      slope += static_cast<int>(power) * E::dense_column(power)[i];
    EXPECT_TRUE(E::are_equal(slope, i == E::kStages - 1 ? 1 : 0));
  }
}

}  // namespace
}  // namespace trajet
