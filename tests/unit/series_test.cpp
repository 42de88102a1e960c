#include "trajet/math/series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "trajet/math/pack.hpp"
#include "trajet/math/vector.hpp"

namespace trajet {
namespace {

constexpr int kOrder = 12;
using S = Series<double, kOrder>;

/// Coefficients that should be equal, but for rounding: a few tens of operations on terms of size `scale`.
void expect_equal(const S& a, const S& b, double scale, const std::string& what) {
  const double tolerance = 200.0 * std::numeric_limits<double>::epsilon() * scale;
  for (int k = 0; k <= kOrder; ++k) EXPECT_NEAR(a[k], b[k], tolerance) << what << ", coefficient " << k;
}

TEST(Series, FunctionsOfTimeHaveTheirKnownCoefficients) {
  const S t = S::variable(0.0);
  S exponential, logarithm, sine, cosine, arctangent, geometric, root;
  double factorial = 1.0, binomial = 1.0;
  for (int k = 0; k <= kOrder; ++k) {
    if (k > 0) factorial *= k;
    if (k > 0) binomial *= (0.5 - (k - 1)) / k;
    exponential[k] = 1.0 / factorial;
    logarithm[k] = k == 0 ? 0.0 : (k % 2 == 1 ? 1.0 : -1.0) / k;
    sine[k] = k % 2 == 0 ? 0.0 : (k % 4 == 1 ? 1.0 : -1.0) / factorial;
    cosine[k] = k % 2 == 1 ? 0.0 : (k % 4 == 0 ? 1.0 : -1.0) / factorial;
    arctangent[k] = k % 2 == 0 ? 0.0 : (k % 4 == 1 ? 1.0 : -1.0) / k;
    geometric[k] = 1.0;
    root[k] = binomial;
  }
  expect_equal(exp(t), exponential, 1.0, "exp t");
  expect_equal(log(1.0 + t), logarithm, 1.0, "log(1 + t)");
  expect_equal(sin(t), sine, 1.0, "sin t");
  expect_equal(cos(t), cosine, 1.0, "cos t");
  expect_equal(atan(t), arctangent, 1.0, "atan t");
  expect_equal(1.0 / (1.0 - t), geometric, 1.0, "1 / (1 - t)");
  expect_equal(sqrt(1.0 + t), root, 1.0, "sqrt(1 + t)");
  expect_equal(pow(1.0 + t, 0.5), root, 1.0, "(1 + t)^0.5");
}

/// A series with random coefficients and the value given.
S random_series(std::mt19937_64& generator, double value) {
  std::uniform_real_distribution<double> coefficient(-0.5, 0.5);
  S x(value);
  for (int k = 1; k <= kOrder; ++k) x[k] = coefficient(generator);
  return x;
}

TEST(Series, InverseFunctionsUndoEachOther) {
  std::mt19937_64 generator(1);
  for (int trial = 0; trial < 100; ++trial) {
    const S x = random_series(generator, 0.4);
    // The intermediate series grow at most like the powers of the inverse distance to the next singularity:
    // measured 40.
    const double scale = 100.0;
    expect_equal(log(exp(x)), x, scale, "log exp");
    expect_equal(sin(asin(x)), x, 1e4 * scale, "sin asin");
    expect_equal(cos(acos(x)), x, 1e4 * scale, "cos acos");
    expect_equal(tan(atan(x)), x, scale, "tan atan");
    expect_equal(square(sqrt(x)), x, 1e4 * scale, "sqrt squared");
    expect_equal(cbrt(x) * cbrt(x) * cbrt(x), x, 1e4 * scale, "cbrt cubed");
    expect_equal(x / (1.0 + exp(x)) * (1.0 + exp(x)), x, scale, "quotient");
    expect_equal(atan2(sin(x), cos(x)), x, scale, "atan2");
  }
}

TEST(Series, AdditionTheoremsHold) {
  std::mt19937_64 generator(2);
  for (int trial = 0; trial < 100; ++trial) {
    const S x = random_series(generator, 0.7);
    expect_equal(square(sin(x)) + square(cos(x)), S(1.0), 100.0, "sin^2 + cos^2");
    expect_equal(square(cosh(x)) - square(sinh(x)), S(1.0), 100.0, "cosh^2 - sinh^2");
    expect_equal(tan(x) * cos(x), sin(x), 1e3, "tan");
    expect_equal(tanh(x) * cosh(x), sinh(x), 1e3, "tanh");
    expect_equal(log10(x) * std::log(10.0), log(x), 1e6, "log10");
    expect_equal(pow(x, 3.0), x * x * x, 10.0, "cube");
    expect_equal(pow(x, S(2.5)), x * x * sqrt(x), 1e6, "x^2.5");
    expect_equal(square(x), x * x, 10.0, "square");
  }
}

TEST(Series, ValueAtATimeIsTheFunctions) {
  // remainder of exp(-t) cos(2t) behind t^12 at t = 0.1: (sqrt(5) 0.1)^13 / 13! = 5.7e-19
  const S t = S::variable(0.0);
  EXPECT_NEAR((exp(-t) * cos(2.0 * t))(0.1), std::exp(-0.1) * std::cos(0.2), 4e-16);
}

/// A body that starts from rest has a speed with a power series: |(3 t, 4 t + t^2, 0)| = t |(3, 4 + t, 0)|.
TEST(Series, LengthOfAVectorThatVanishes) {
  const S t = S::variable(0.0);
  const S zero;
  const S length = norm3(3.0 * t, 4.0 * t + t * t, zero);
  const S expected = t * sqrt(25.0 + 8.0 * t + t * t);
  expect_equal(length, expected, 1.0, "length");
  EXPECT_EQ(length[0], 0.0);
  EXPECT_EQ(length[1], 5.0);
  expect_equal(norm3(zero, zero, zero), zero, 1.0, "length of nothing");
}

TEST(Series, CornersTakeTheBranchBehindTheStart) {
  const S t = S::variable(0.0);
  expect_equal(abs(-t), t, 1.0, "|-t|");
  expect_equal(max(t * t, t), t, 1.0, "max");
  expect_equal(min(t * t, t), t * t, 1.0, "min");
  expect_equal(max(-t, t), t, 1.0, "max at a tie");
  EXPECT_EQ(sign(S(-2.0) + t)[0], -1.0);
  EXPECT_EQ(sign(S(-2.0) + t)[1], 0.0);
}

TEST(Series, EigenVectorsOfThem) {
  const S t = S::variable(0.0);
  const Vector3T<S> a(t, S(1.0), S(2.0)), b(S(3.0), t, t);
  expect_equal(a.dot(b), 6.0 * t, 1.0, "dot");
  expect_equal(a.cross(b)[0], t - 2.0 * t, 1.0, "cross");
}

template <class T>
Vector3T<T> drag_and_lift(const Vector3T<T>& v) {
  using std::exp, std::sqrt;
  const T speed = sqrt(v.dot(v));
  return v * (-0.3 * speed) + Vector3T<T>(-v.y(), v.x(), T(0.0)) * (1.0 / (1.0 + exp(speed)));
}

/// Each lane of a Pack is the scalar computation, but for the last bits of exp.
TEST(Pack, LanesAreScalars) {
  alignas(64) double x[kPackSize], y[kPackSize], z[kPackSize];
  for (int i = 0; i < kPackSize; ++i) x[i] = 1.0 + i, y[i] = 0.5 * i, z[i] = -2.0 + i;
  const Vector3T<Pack> packed =
      drag_and_lift<Pack>({Pack::load_aligned(x), Pack::load_aligned(y), Pack::load_aligned(z)});
  for (int i = 0; i < kPackSize; ++i) {
    const Vector3 single = drag_and_lift<double>({x[i], y[i], z[i]});
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(packed[k].get(static_cast<std::size_t>(i)), single[k], 8e-16 * (1.0 + single.norm())) << i << k;
  }
}

TEST(Pack, CoefficientsOfSeries) {
  using SP = Series<Pack, 6>;
  using S6 = Series<double, 6>;
  const SP packed = exp(SP::variable(Pack(0.3))) * sqrt(SP::variable(Pack(0.3)));
  const S6 single = exp(S6::variable(0.3)) * sqrt(S6::variable(0.3));
  for (int k = 0; k <= 6; ++k) EXPECT_NEAR(packed[k].get(0), single[k], 1e-12) << k;
}

TEST(Pack, WhereChoosesByLane) {
  alignas(64) double x[kPackSize];
  for (int i = 0; i < kPackSize; ++i) x[i] = i % 2 == 0 ? -1.0 : 2.0;
  const Pack p = Pack::load_aligned(x);
  const Pack chosen = where(less(p, Pack(0.0)), Pack(10.0), p);
  for (int i = 0; i < kPackSize; ++i) EXPECT_EQ(chosen.get(static_cast<std::size_t>(i)), i % 2 == 0 ? 10.0 : 2.0);
}

}  // namespace
}  // namespace trajet
