#include "trajet/ode/law_expansion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "trajet/math/series.hpp"

namespace trajet {
namespace {

using Vector2 = Eigen::Matrix<double, 2, 1>;

/// All smooth functions that a law can call, on numbers that stay inside their domains.
struct SmoothFunctions {
  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector& q, Rate& dq) const {
    using std::sin, std::cos, std::exp, std::sqrt, std::tan, std::tanh, std::asin, std::acos, std::atan, std::sinh,
        std::cosh, std::log, std::log10, std::cbrt, std::pow, std::atan2;
    const auto x = 0.5 + 0.1 * sin(q[0]);
    dq[0] = cos(t) * exp(-q[0]) + sqrt(1.0 + q[1] * q[1]) / (2.0 + q[0] * q[0]) - tan(0.3 * x) + tanh(q[1]);
    dq[1] = asin(x) + acos(x) * atan(q[0]) - sinh(0.2 * q[1]) + cosh(x) * log(x) + log10(2.0 + x) + cbrt(x) +
            pow(x, 2.5) + pow(x, 3.0) + atan2(x, 1.0 + q[1] * q[1]) - 3.0 / (1.0 + x) + (2.0 - x) - x / 3.0;
  }
};

/// Those that choose a branch.
struct ChoosingFunctions {
  template <class Time, class Vector, class Rate>
  void operator()(const Time& t, const Vector& q, Rate& dq) const {
    using std::abs, std::min, std::max;
    dq[0] = abs(q[1]) * t - max(q[0], 0.1);
    dq[1] = min(q[0], q[1] + 10.0) - max(q[0] * q[1], t);
  }
};

/// Coefficients by the slow way: the law on whole series, one more coefficient known after each pass.
template <class Law, int Order>
Eigen::Matrix<double, 2, Order + 1> expand_by_series(double t, const Vector2& q0) {
  using S = Series<double, Order>;
  Eigen::Matrix<S, 2, 1> q{S(q0[0]), S(q0[1])}, dq;
  for (int pass = 0; pass < Order; ++pass) {
    Law{}(S::variable(t), q, dq);
    for (int i = 0; i < 2; ++i) q[i][pass + 1] = dq[i][pass] / (pass + 1);
  }
  Eigen::Matrix<double, 2, Order + 1> coefficients;
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k <= Order; ++k) coefficients(i, k) = q[i][k];
  return coefficients;
}

TEST(LawExpansion, AgreesWithSeriesArithmetic) {
  constexpr int kOrder = 10;
  const Vector2 q(0.3, -0.4);
  const auto expected = expand_by_series<ChoosingFunctions, kOrder>(0.2, q);
  LawExpansion<ChoosingFunctions, 2> expansion({}, 2);
  Eigen::Matrix<double, 2, kOrder + 1> coefficients;
  for (int repeat = 0; repeat < 2; ++repeat) {  // the second time on a tape that has grown
    expansion.expand(0.2, q, kOrder, coefficients.data());
    for (int k = 0; k <= kOrder; ++k)
      for (int i = 0; i < 2; ++i)
        // the two ways round differently; measured below 1e-14 of the size of the coefficients
        EXPECT_NEAR(coefficients(i, k), expected(i, k), 1e-13 * std::max(1.0, std::abs(expected(i, k))))
            << i << " " << k;
  }
}

TEST(LawExpansion, SolvesTheLawInExtendedPrecision) {
  using Number = long double;
  using Vector = Eigen::Matrix<Number, 2, 1>;
  constexpr int kOrder = 24;
  LawExpansion<SmoothFunctions, 2, Number> expansion({}, 2);
  Eigen::Matrix<Number, 2, kOrder + 1> c;
  for (int repeat = 0; repeat < 2; ++repeat)  // the second time on a tape that has grown
    expansion.expand(0.2, Vector(0.3L, -0.4L), kOrder, c.data());
  const Number tau = 0.02L;  // the terms left out are below 0.05^24 = 1e-31
  Vector q = c.col(kOrder), rate = Number(kOrder) * c.col(kOrder), law;
  for (int k = kOrder - 1; k >= 0; --k) q = q * tau + c.col(k);
  for (int k = kOrder - 1; k >= 1; --k) rate = rate * tau + Number(k) * c.col(k);
  SmoothFunctions()(0.2 + tau, q, law);
  // some 30 operations a component; one that rounds to double shows 1e-17 of the size 1 at least
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(static_cast<double>(rate[i] - law[i]), 0.0, 30 * std::numeric_limits<Number>::epsilon());
}

}  // namespace
}  // namespace trajet
