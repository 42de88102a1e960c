// Linear complementarity: the conditions that make the solution the only one, on matrices of any rank.

#include "trajet/math/complementarity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace trajet::test {
namespace {

using Matrix = Eigen::MatrixX<Extended>;
using Vector = Eigen::VectorX<Extended>;

constexpr Extended kTolerance = 1e-14;

Matrix random_matrix(std::mt19937& random, Eigen::Index rows, Eigen::Index columns) {
  std::normal_distribution<double> normal;
  Matrix matrix(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < columns; ++j) matrix(i, j) = Extended(normal(random));
  return matrix;
}

/// n contacts of what moves in so many directions, which all approach, each with a restitution of its own.
struct Problem {
  Matrix A;
  Vector q;
};

Problem random_problem(std::mt19937& random, Eigen::Index directions, Eigen::Index n, bool is_mixed) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  Matrix N = random_matrix(random, directions, n);
  const Vector v = random_matrix(random, directions, 1);
  Vector u = N.transpose() * v;
  for (Eigen::Index i = 0; i < n; ++i)
    if (u[i] > Extended(0)) {
      u[i] = -u[i];
      N.col(i) = -N.col(i);
    }
  const double common = part(random);
  for (Eigen::Index i = 0; i < n; ++i) u[i] *= Extended(1.0 + (is_mixed ? part(random) : common));
  return {N.transpose() * N, u};
}

TEST(Complementarity, OfContactsThatApproachThereIsASolutionWhateverTheirRestitutions) {
  std::mt19937 random(1);
  for (int sample = 0; sample < 20'000; ++sample) {
    const auto directions = static_cast<Eigen::Index>(1 + random() % 6),
               n = static_cast<Eigen::Index>(1 + random() % 12);
    const Problem problem = random_problem(random, directions, n, sample % 2 == 0);
    const auto x = solve_complementarity(problem.A, problem.q, kTolerance);
    ASSERT_TRUE(x) << sample;
    const Vector w = problem.q + problem.A * *x;
    const Extended size = Extended(1) + x->maxCoeff() * problem.A.cwiseAbs().maxCoeff();
    ASSERT_GE(x->minCoeff(), Extended(0)) << sample;
    ASSERT_GE(w.minCoeff(), Extended(-1e-13) * size) << sample;
    ASSERT_LE((w.cwiseProduct(*x)).cwiseAbs().maxCoeff(), Extended(1e-13) * size * size) << sample;
  }
}

TEST(Complementarity, TheSolutionDoesNotDependOnTheOrder) {
  std::mt19937 random(2);
  for (int sample = 0; sample < 5'000; ++sample) {
    const auto directions = static_cast<Eigen::Index>(1 + random() % 6),
               n = static_cast<Eigen::Index>(1 + random() % 12);
    const Problem problem = random_problem(random, directions, n, true);
    std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    Problem other = problem;
    for (Eigen::Index i = 0; i < n; ++i) {
      other.q[i] = problem.q[order[static_cast<std::size_t>(i)]];
      for (Eigen::Index j = 0; j < n; ++j)
        other.A(i, j) = problem.A(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(j)]);
    }
    const auto x = solve_complementarity(problem.A, problem.q, kTolerance),
               y = solve_complementarity(other.A, other.q, kTolerance);
    ASSERT_TRUE(x && y) << sample;
    const Vector w = problem.q + problem.A * *x, of_other = other.q + other.A * *y;
    const Extended size = Extended(1) + x->maxCoeff() * problem.A.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < n; ++i)
      ASSERT_NEAR(static_cast<double>(w[order[static_cast<std::size_t>(i)]] - of_other[i]), 0.0,
                  static_cast<double>(Extended(1e-13) * size))
          << sample;
  }
}

/// Two equal columns that ask for different speeds: the one that asks for more takes the place of the other.
TEST(Complementarity, OfEqualColumnsTheOneThatAsksForMoreIsMet) {
  Matrix A(3, 3);
  A << 1, 1, 1, 1, 1, 1, 1, 1, 1;
  const Vector q = Vector{{Extended(-1), Extended(-3), Extended(-2)}};
  const auto x = solve_complementarity(A, q, kTolerance);
  ASSERT_TRUE(x);
  EXPECT_EQ(x->sum(), Extended(3));
  EXPECT_EQ((*x)[1], Extended(3));
}

/// One column is the sum of others, and asks for less than they give or for more.
TEST(Complementarity, AColumnThatOthersGiveTakesThePlaceOfOne) {
  Matrix N(2, 3);
  N << 1, 0, 1, 0, 1, 1;
  const Matrix A = N.transpose() * N;
  // v = (-1, -1): alone, the third is met by v+ = (1, 1) if it asks for no more than both do
  for (const double asked : {3.0, 4.0, 5.0}) {
    const Vector q = Vector{{Extended(-2), Extended(-2), Extended(-asked)}};
    const auto x = solve_complementarity(A, q, kTolerance);
    ASSERT_TRUE(x) << asked;
    const Vector w = q + A * *x;
    EXPECT_NEAR(static_cast<double>(w.minCoeff()), 0.0, 1e-15) << asked;
    EXPECT_NEAR(static_cast<double>(w.dot(*x)), 0.0, 1e-15) << asked;
  }
}

TEST(Complementarity, WhatNoSpeedMeetsHasNoSolution) {
  Matrix A(2, 2);
  A << 1, -1, -1, 1;
  EXPECT_FALSE(solve_complementarity(A, Vector{{Extended(-1), Extended(-1)}}, kTolerance));
  EXPECT_TRUE(solve_complementarity(A, Vector{{Extended(-1), Extended(1)}}, kTolerance));
  EXPECT_TRUE(solve_complementarity(A, Vector{{Extended(-1), Extended(2)}}, kTolerance));
}

}  // namespace
}  // namespace trajet::test
