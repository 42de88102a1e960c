#include "trajet/math/interval.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "trajet/math/vector.hpp"

namespace trajet {
namespace {

using Real = long double;

bool contains(const Interval& x, Real value) { return x.lower() <= value && value <= x.upper(); }

Interval random_interval(std::mt19937& engine, double low, double high) {
  std::uniform_real_distribution<double> uniform(low, high);
  const double a = uniform(engine);
  std::uniform_int_distribution<int> scale(0, 14);
  const double b = a + (high - a) * uniform(engine) / (std::abs(low) + std::abs(high)) * std::pow(10.0, -scale(engine));
  return Interval::hull(a, std::min(std::max(b, low), high));
}

struct Function {
  const char* name;
  std::function<Interval(const Interval&)> enclose;
  std::function<Real(Real)> exact;
  double low, high;
};

// The function of every member is a member of the function; at single numbers the interval is a few ulp wide.
TEST(Interval, FunctionsEncloseTheirValues) {
  const Function functions[] = {
      {"sqrt", [](const Interval& x) { return sqrt(x); }, [](Real x) { return std::sqrt(x); }, 0.0, 100.0},
      {"cbrt", [](const Interval& x) { return cbrt(x); }, [](Real x) { return std::cbrt(x); }, -10.0, 10.0},
      {"exp", [](const Interval& x) { return exp(x); }, [](Real x) { return std::exp(x); }, -20.0, 20.0},
      {"log", [](const Interval& x) { return log(x); }, [](Real x) { return std::log(x); }, 0.01, 100.0},
      {"sin", [](const Interval& x) { return sin(x); }, [](Real x) { return std::sin(x); }, -20.0, 20.0},
      {"cos", [](const Interval& x) { return cos(x); }, [](Real x) { return std::cos(x); }, -20.0, 20.0},
      {"tan", [](const Interval& x) { return tan(x); }, [](Real x) { return std::tan(x); }, -1.5, 1.5},
      {"asin", [](const Interval& x) { return asin(x); }, [](Real x) { return std::asin(x); }, -1.0, 1.0},
      {"acos", [](const Interval& x) { return acos(x); }, [](Real x) { return std::acos(x); }, -1.0, 1.0},
      {"atan", [](const Interval& x) { return atan(x); }, [](Real x) { return std::atan(x); }, -20.0, 20.0},
      {"sinh", [](const Interval& x) { return sinh(x); }, [](Real x) { return std::sinh(x); }, -5.0, 5.0},
      {"cosh", [](const Interval& x) { return cosh(x); }, [](Real x) { return std::cosh(x); }, -5.0, 5.0},
      {"tanh", [](const Interval& x) { return tanh(x); }, [](Real x) { return std::tanh(x); }, -5.0, 5.0},
      {"cube", [](const Interval& x) { return pow(x, 3); }, [](Real x) { return x * x * x; }, -5.0, 5.0},
      {"power", [](const Interval& x) { return pow(x, Interval(1.5)); }, [](Real x) { return std::pow(x, 1.5L); }, 0.1,
       9.0},
      {"abs", [](const Interval& x) { return abs(x); }, [](Real x) { return std::abs(x); }, -5.0, 5.0},
      {"floor", [](const Interval& x) { return floor(x); }, [](Real x) { return std::floor(x); }, -5.0, 5.0},
  };
  std::mt19937 engine(11);
  for (const Function& f : functions) {
    for (int sample = 0; sample < 3000; ++sample) {
      const Interval x = random_interval(engine, f.low, f.high);
      const Interval y = f.enclose(x);
      for (int i = 0; i <= 4; ++i) {
        const double member = i == 4 ? x.upper() : x.lower() + 0.25 * i * (x.upper() - x.lower());
        ASSERT_TRUE(contains(y, f.exact(member))) << f.name << " of " << member;
      }
      const Interval single = f.enclose(Interval(x.lower()));
      // exp and pow multiply relative errors by their argument: 20 there.
      ASSERT_LE(width(single), 200.0 * 0x1p-52 * (1.0 + norm(single))) << f.name << " of " << x.lower();
    }
  }
}

TEST(Interval, ArithmeticEnclosesItsResults) {
  std::mt19937 engine(5);
  for (int sample = 0; sample < 20000; ++sample) {
    const Interval a = random_interval(engine, -3.0, 3.0);
    const Interval b = random_interval(engine, -3.0, 3.0);
    for (const double x : {a.lower(), a.upper()}) {
      for (const double y : {b.lower(), b.upper()}) {
        ASSERT_TRUE(contains(a + b, static_cast<Real>(x) + y));
        ASSERT_TRUE(contains(a - b, static_cast<Real>(x) - y));
        ASSERT_TRUE(contains(a * b, static_cast<Real>(x) * y));
        ASSERT_TRUE(zero_in(b) || contains(a / b, static_cast<Real>(x) / y));
        ASSERT_TRUE(contains(atan2(a, b), std::atan2(static_cast<Real>(x), static_cast<Real>(y))));
        ASSERT_TRUE(contains(norm3(a, b, a), std::sqrt(2.0L * x * x + static_cast<Real>(y) * y)));
        ASSERT_TRUE(contains(min(a, b), std::min(x, y)));
        ASSERT_TRUE(contains(max(a, b), std::max(x, y)));
      }
    }
  }
}

TEST(Interval, RoundsOutwardAtTheEdgesOfTheDoubles) {
  const double largest = std::numeric_limits<double>::max();
  EXPECT_EQ((Interval(largest) * 2.0).lower(), largest);
  EXPECT_EQ((Interval(largest) * 2.0).upper(), std::numeric_limits<double>::infinity());
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_LE((Interval(tiny) * 0.4).lower(), 0.0);
  EXPECT_GE((Interval(tiny) * 0.4).upper(), tiny);
  EXPECT_LT((Interval(1.0) / 3.0).lower(), (Interval(1.0) / 3.0).upper());
  EXPECT_LE(width(Interval(1.0) / 3.0), 3.0 * 0x1p-54);
}

TEST(Interval, ComparisonsMayBeUndecided) {
  const Interval low(0.0, 1.0), high(2.0, 3.0), wide(0.0, 3.0);
  EXPECT_EQ(less(low, high), Decision::yes);
  EXPECT_EQ(less(high, low), Decision::no);
  EXPECT_EQ(less(low, wide), Decision::undecided);
  const Interval chosen = where(less(wide, high), low, high);
  EXPECT_EQ(chosen.lower(), 0.0);
  EXPECT_EQ(chosen.upper(), 3.0);
}

TEST(IntervalJet, DoesNotClaimARateAcrossAJumpNorACurvatureAcrossACorner) {
  const IntervalJet t = IntervalJet::variable(Interval(-0.1, 0.2));
  const IntervalJet corner = abs(t);
  EXPECT_TRUE(contains(corner[1], 1.0L) && contains(corner[1], -1.0L));
  EXPECT_EQ(corner[2].upper(), std::numeric_limits<double>::infinity());
  for (const IntervalJet& jump : {floor(t), sign(t), where(less(t, IntervalJet(0.0)), IntervalJet(1.0), t)}) {
    EXPECT_EQ(jump[1].upper(), std::numeric_limits<double>::infinity());
    EXPECT_EQ(jump[1].lower(), -std::numeric_limits<double>::infinity());
  }
}

TEST(IntervalJet, NotANumberIsNotLostInAChoice) {
  const IntervalJet nan{Interval(std::numeric_limits<double>::quiet_NaN())};
  const IntervalJet one(1.0);
  for (const IntervalJet& x :
       {max(nan, one), max(one, nan), min(nan, one), abs(nan), where(less(nan, one), nan, one)}) {
    EXPECT_TRUE(empty(x[0]));
  }
}

TEST(IntervalJet, WorksInEigenVectors) {
  const IntervalJet t = IntervalJet::variable(Interval(1.0, 2.0));
  const Vector3T<IntervalJet> x(t, t * t, IntervalJet(3.0));
  const IntervalJet squared = x.dot(x);
  EXPECT_TRUE(contains(squared[0], 1.5L * 1.5L + 1.5L * 1.5L * 1.5L * 1.5L + 9.0L));
  EXPECT_TRUE(contains(squared[1], 2.0L * 1.5L + 4.0L * 1.5L * 1.5L * 1.5L));
}

}  // namespace
}  // namespace trajet
