#include "trajet/math/dual.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "trajet/law/lookup_table.hpp"
#include "trajet/law/program_builder.hpp"
#include "trajet/law/program_jacobian.hpp"
#include "trajet/math/series.hpp"
#include "trajet/ode/differentiable_law.hpp"

namespace trajet {
namespace {

using D = Dual<2>;

// Exact: powers of two throughout.
TEST(Dual, RulesOfDifferentiation) {
  const D x = D::variable(4.0, 0), y = D::variable(0.5, 1);
  const auto expect = [](const D& z, double value, double dx, double dy) {
    EXPECT_EQ(z.value(), value);
    EXPECT_EQ(z.derivative(0), dx);
    EXPECT_EQ(z.derivative(1), dy);
  };
  expect(x + 2.0 * y - 1, 4.0, 1.0, 2.0);
  expect(3 - x, -1.0, -1.0, 0.0);
  expect(x * y, 2.0, 0.5, 4.0);
  expect(x / y, 8.0, 2.0, -16.0);
  expect(1 / y, 2.0, 0.0, -4.0);
  expect(sqrt(x), 2.0, 0.25, 0.0);
  expect(pow(x, 3), 64.0, 48.0, 0.0);
  expect(pow(x, y), 2.0, 0.25, 2.0 * std::log(4.0));
  expect(where(less(x, y), x, y), 0.5, 0.0, 1.0);
  expect(max(x, 1.0), 4.0, 1.0, 0.0);
  expect(min(x, 1.0), 1.0, 0.0, 0.0);
  expect(abs(-x), 4.0, 1.0, 0.0);
  expect(floor(x + y) + sign(y), 5.0, 0.0, 0.0);
}

TEST(Dual, WhatDoesNotMoveStaysEvenAtSingularPoints) {
  const D v = D::variable(0.0, 0);
  EXPECT_EQ(sqrt(v * v).derivative(0), 0.0);
  EXPECT_EQ((norm3(v, D(0.0), D(0.0)) * v).derivative(0), 0.0);
  EXPECT_EQ(pow(v * v, 0.3).derivative(0), 0.0);
  EXPECT_EQ(pow(D::variable(-2.0, 0), 3.0).derivative(0), 12.0);
  EXPECT_EQ(pow(v, 0.0).derivative(0), 0.0);
  EXPECT_EQ(sqrt(v).derivative(0), std::numeric_limits<double>::infinity());
}

/// Eleven inputs and t: more directions than one pass has.
constexpr int kStates = 11;

Program compile(const std::vector<const char*>& rates) {
  Symbols symbols;
  symbols.set_input("t", 0);
  symbols.set_input("x", 1);
  symbols.set_input("y", 2);
  symbols.set_input("z", 3);
  for (int i = 3; i < kStates; ++i) symbols.set_input("s" + std::to_string(i), i + 1);
  ProgramBuilder builder(kStates + 1);
  for (const char* rate : rates) builder.add_output(builder.compile(rate, symbols));
  return builder.build();
}

// A series whose state moves along one direction has the derivative as its first coefficient: another arithmetic.
TEST(ProgramJacobian, AgreesWithSeriesInEveryDirectionForEveryOperation) {
  const Program program =
      compile({"x*y + z/t - 3*x/y - s9*t", "sqrt(x) + cbrt(y) + z^3 + (2 - x)/3",
               "exp(-x)*log(y) + log10(z + x) + 1/s10", "sin(x)*cos(x) + sin(y) + cos(z)",
               "tan(x/2) + tanh(y) + sinh(z)*cosh(z)/9", "sinh(x/2) + cosh(y/3) + atan(z) + x^0.3 + x^y + 2^z",
               "asin(x/3) + acos(y/4) + atan2(z, x)", "norm([x, y, z])*s3 + abs(s4 - 3)*s5 + sign(s6)*x",
               "min(x, y)*max(z, t) + floor(s7)*s8", "where(x < y and y <= 9, s3^2, s4)", "t^2*(x == y) + s5^-2"});
  const std::vector<double> q{1.1, 1.7, 0.8, 0.3, 0.9, 1.3, -0.4, 2.6, 0.7, 1.9, 0.6};
  constexpr double t = 0.9;
  std::vector<double> jacobian(kStates * kStates), time_rate(kStates);
  ProgramJacobian evaluate(program);
  evaluate(t, q.data(), jacobian.data(), time_rate.data());

  using S = Series<double, 1>;
  Evaluator<S> series(program);
  for (int direction = 0; direction <= kStates; ++direction) {
    std::vector<S> state(q.begin(), q.end()), rate(kStates);
    if (direction < kStates)
      state[static_cast<std::size_t>(direction)] = S::variable(q[static_cast<std::size_t>(direction)]);
    series(direction == kStates ? S::variable(t) : S(t), state.data(), rate.data());
    for (std::size_t i = 0; i < kStates; ++i) {
      const double derivative =
          direction == kStates ? time_rate[i] : jacobian[static_cast<std::size_t>(direction) * kStates + i];
      // a few roundings of terms of the size of 10
      EXPECT_NEAR(derivative, rate[i][1], 1e-14 * (1.0 + std::abs(rate[i][1])))
          << "rate " << i << ", direction " << direction;
    }
  }
}

TEST(Dual, GoesThroughTables) {
  const LookupTable table({0.0, 1.0, 2.0, 4.0}, {0.0, 1.0, 3.0, 4.0});
  for (const double x : {0.3, 1.0, 1.6, 3.9}) {
    const D y = table(D::variable(x, 1));
    EXPECT_EQ(y.value(), table(x));
    EXPECT_NEAR(y.derivative(1), table(Series<double, 1>::variable(x))[1], 1e-15);
    EXPECT_EQ(y.derivative(0), 0.0);
  }
  EXPECT_TRUE(std::isnan(table(D::variable(5.0, 0)).value()));
}

/// q_i' = i q_{i+1}^2 t, cyclic: each row has one entry.
struct Ring {
  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector& q, Rate& dq) const {
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const auto& next = q[(i + 1) % q.size()];
      dq[i] = static_cast<double>(i) * next * next * t;
    }
  }
};

template <int Dim>
void expect_ring_jacobian(int dimension) {
  using Law = DifferentiableLaw<Ring, Dim>;
  typename Law::State q(dimension), time_rate(dimension);
  typename Law::Jacobian jacobian(dimension, dimension);
  for (int i = 0; i < dimension; ++i) q[i] = 1.0 + i;
  Law(Ring()).jacobian(2.0, q, jacobian, time_rate);
  for (int i = 0; i < dimension; ++i) {
    const int next = (i + 1) % dimension;
    EXPECT_EQ(time_rate[i], i * q[next] * q[next]);
    for (int j = 0; j < dimension; ++j) EXPECT_EQ(jacobian(i, j), j == next ? 4.0 * i * q[next] : 0.0) << i << ' ' << j;
  }
}

TEST(DifferentiableLaw, JacobianOfAnyDimension) {
  expect_ring_jacobian<3>(3);
  expect_ring_jacobian<7>(7);
  expect_ring_jacobian<8>(8);
  expect_ring_jacobian<Eigen::Dynamic>(1);
  expect_ring_jacobian<Eigen::Dynamic>(16);
}

}  // namespace
}  // namespace trajet
