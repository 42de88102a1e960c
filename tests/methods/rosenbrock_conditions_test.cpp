#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

#include "methods/order_conditions.hpp"
#include "trajet/ode/rosenbrock_tableau.hpp"

namespace trajet {
namespace {

/// A tableau in the form of [HairerWanner1996] IV.7 (7.4): Gamma = (1/gamma - C)^-1, alpha = A Gamma, b = Gamma^T m.
template <class Method>
struct Classical {
  static constexpr auto& kTableau = Method::kTableau;
  static constexpr int kStages = kTableau.kStages;
  using Matrix = Eigen::Matrix<double, kStages, kStages>;
  using Weights = Eigen::Matrix<double, kStages, 1>;

  Matrix gamma, alpha;

  Classical() {
    Matrix a, c;
    for (int i = 0; i < kStages; ++i)
      for (int j = 0; j < kStages; ++j) {
        const auto row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(j);
        a(i, j) = kTableau.a[row][column];
        c(i, j) = kTableau.c[row][column];
      }
    gamma = (Matrix::Identity() / kTableau.gamma - c).inverse();
    alpha = a * gamma;
  }

  template <class Array>
  Weights weights(const Array& of_u) const {
    return gamma.transpose() * Eigen::Map<const Weights>(of_u.data());
  }

  /// [HairerWanner1996] IV.7 (7.15'): beta = alpha + gamma below a vertex with one branch, alpha below others.
  Weights factors(const Tree& tree) const {
    Weights result = Weights::Ones();
    for (const Tree& branch : tree.branches) {
      const Weights inner = factors(branch);
      result.array() *= (tree.branches.size() == 1 ? Weights((alpha + gamma) * inner) : Weights(alpha * inner)).array();
    }
    return result;
  }

  /// How far the conditions of exactly that order are from holding.
  double defect(const Weights& b, int order) const {
    double largest = 0.0;
    for (const Tree& tree : trees_up_to(order))
      if (tree.order() == order)
        largest = std::max(largest, std::abs(b.dot(factors(tree)) - 1.0 / static_cast<double>(tree.density())));
    return largest;
  }
};

template <class Method>
class RosenbrockConditions : public testing::Test {};
using Tableaus = testing::Types<Rosenbrock23Tableau, Rodas5pTableau>;
TYPED_TEST_SUITE(RosenbrockConditions, Tableaus);

// The coefficients have 16 digits and the products below reach 1e3: measured defects are below 1e-14 and 2e-13.
constexpr double kRounding = 1e-12;
// What does not hold is off by far more than rounding: measured 2e-4 and more.
constexpr double kBroken = 1e-5;

TYPED_TEST(RosenbrockConditions, MethodHasItsOrderAndNoMore) {
  const Classical<TypeParam> classical;
  const auto b = classical.weights(TypeParam::kTableau.m);
  for (int order = 1; order <= TypeParam::kOrder; ++order) EXPECT_LT(classical.defect(b, order), kRounding) << order;
  EXPECT_GT(classical.defect(b, TypeParam::kOrder + 1), kBroken);
}

// Its difference to the method, the estimate, is of the lower of the two orders, plus one.
TYPED_TEST(RosenbrockConditions, EstimateIsOfItsOrder) {
  const Classical<TypeParam> classical;
  const auto companion = (classical.weights(TypeParam::kTableau.m) - classical.weights(TypeParam::kTableau.e)).eval();
  for (int order = 1; order < TypeParam::kErrorPower; ++order)
    EXPECT_LT(classical.defect(companion, order), kRounding) << order;
  const bool companion_is_better = TypeParam::kErrorPower > TypeParam::kOrder;
  if (companion_is_better) {
    EXPECT_LT(classical.defect(companion, TypeParam::kErrorPower), kRounding);
  } else {
    EXPECT_GT(classical.defect(companion, TypeParam::kErrorPower), kBroken);
  }
}

// For laws of time too: alpha_i = sum_j alpha_ij, gamma_i = sum_j gamma_ij.
TYPED_TEST(RosenbrockConditions, TimesAreTheRowSums) {
  const Classical<TypeParam> classical;
  for (int i = 0; i < classical.kStages; ++i) {
    EXPECT_NEAR(classical.alpha.row(i).sum(), TypeParam::kTableau.alpha[static_cast<std::size_t>(i)], kRounding);
    EXPECT_NEAR(classical.gamma.row(i).sum(), TypeParam::kTableau.gamma_sum[static_cast<std::size_t>(i)], kRounding);
  }
}

// sum_i b_i(s) phi_i(t) = s^order / gamma(t) for every s.
TYPED_TEST(RosenbrockConditions, DenseOutputHasItsOrderForEveryTime) {
  const Classical<TypeParam> classical;
  for (int power = 1; power <= TypeParam::kTableau.kDegree; ++power) {
    std::array<double, TypeParam::kTableau.kStages> column{};
    for (std::size_t i = 0; i < column.size(); ++i)
      column[i] = TypeParam::kTableau.dense[i][static_cast<std::size_t>(power - 1)];
    const auto b = classical.weights(column);
    for (const Tree& tree : trees_up_to(TypeParam::kDenseOrder)) {
      const double expected = power == tree.order() ? 1.0 / static_cast<double>(tree.density()) : 0.0;
      EXPECT_NEAR(b.dot(classical.factors(tree)), expected, kRounding) << "s^" << power << ", order " << tree.order();
    }
  }
}

TYPED_TEST(RosenbrockConditions, DenseOutputEndsInTheState) {
  for (std::size_t i = 0; i < TypeParam::kTableau.m.size(); ++i) {
    double sum = 0.0;
    for (const double coefficient : TypeParam::kTableau.dense[i]) sum += coefficient;
    EXPECT_NEAR(sum, TypeParam::kTableau.m[i], 1e-13);  // three roundings of numbers up to 80
  }
}

// R(z) = 1 + z b^T (1 - z B)^-1 1 with B = alpha + gamma, [HairerWanner1996] IV.7 (7.14).
TYPED_TEST(RosenbrockConditions, LStable) {
  const Classical<TypeParam> classical;
  const auto b = classical.weights(TypeParam::kTableau.m);
  const auto growth = [&](std::complex<double> z) {
    using Matrix = Eigen::Matrix<std::complex<double>, Classical<TypeParam>::kStages, Classical<TypeParam>::kStages>;
    using Vector = Eigen::Matrix<std::complex<double>, Classical<TypeParam>::kStages, 1>;
    const Matrix matrix =
        Matrix::Identity() - z * (classical.alpha + classical.gamma).template cast<std::complex<double>>();
    const Vector k = matrix.partialPivLu().solve(Vector::Ones());
    return std::abs(1.0 + z * b.template cast<std::complex<double>>().cwiseProduct(k).sum());
  };
  // a function without poles in the left half-plane is largest on its border
  for (double y = 1e-3; y < 1e6; y *= 1.5) EXPECT_LE(growth({0.0, y}), 1.0 + 1e-10) << y;
  EXPECT_LT(growth({-1e8, 0.0}), 1e-6);
}

}  // namespace
}  // namespace trajet
