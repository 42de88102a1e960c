// What Intervals promise, against exact rationals and fifty digits: every result lies within, and the bounds are a
// few roundings wide.

#include "trajet/math/interval.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "bounds/exact.hpp"

namespace trajet {
namespace {

using test::Coverage;
using test::Random;
using test::Rational;
using test::Real;

/// |error| / bound of an enclosure of a single number: its distance from the middle over half the width.
template <class Number>
double coverage(const Interval& x, const Number& exact) {
  const Number middle = (Number(x.lower()) + Number(x.upper())) / 2;
  const Number half = (Number(x.upper()) - Number(x.lower())) / 2;
  if (exact == middle) return 0.0;
  return half == 0 ? std::numeric_limits<double>::infinity() : static_cast<double>(Number(abs(exact - middle) / half));
}

TEST(IntervalBounds, ArithmeticEnclosesExactResults) {
  Random random(21);
  Coverage sums, products, quotients, roots;
  for (int sample = 0; sample < 20000; ++sample) {
    const double a = random.scaled(1e-3, 1e3);
    const double b = random.scaled(1e-3, 1e3);
    const Interval x(a), y(b);
    sums.add(coverage<Rational>(x + y, Rational(a) + Rational(b)), 1.0);
    sums.add(coverage<Rational>(x - y, Rational(a) - Rational(b)), 1.0);
    products.add(coverage<Rational>(x * y, Rational(a) * Rational(b)), 1.0);
    quotients.add(coverage<Rational>(x / y, Rational(a) / Rational(b)), 1.0);
    const Interval root = sqrt(Interval(std::abs(a)));
    roots.add(coverage<Real>(root, sqrt(Real(std::abs(a)))), 1.0);
  }
  // rounding errs by half an ulp, and the bounds are the neighbours: an ulp away
  for (const Coverage* c : {&sums, &products, &quotients, &roots}) {
    EXPECT_LE(c->largest(), 1.0);
    EXPECT_GE(c->largest(), 0.45);
  }
}

TEST(IntervalBounds, ArithmeticOfWideOnesEnclosesTheirCorners) {
  Random random(22);
  for (int sample = 0; sample < 5000; ++sample) {
    const Interval a = Interval::hull(random.scaled(1e-3, 1.0), random.scaled(1e-3, 1.0));
    const Interval b = Interval::hull(random.scaled(1e-3, 1.0), random.scaled(1e-3, 1.0));
    for (const double x : {a.lower(), a.upper()})
      for (const double y : {b.lower(), b.upper()}) {
        const auto expect_in = [](const Interval& enclosure, const Rational& exact) {
          EXPECT_LE(Rational(enclosure.lower()), exact);
          EXPECT_GE(Rational(enclosure.upper()), exact);
        };
        expect_in(a + b, Rational(x) + Rational(y));
        expect_in(a - b, Rational(x) - Rational(y));
        expect_in(a * b, Rational(x) * Rational(y));
        expect_in(square(a), Rational(x) * Rational(x));
        if (!zero_in(b)) expect_in(a / b, Rational(x) / Rational(y));
      }
  }
}

struct Function {
  const char* name;
  std::function<Interval(const Interval&)> enclose;
  std::function<Real(const Real&)> exact;
  double low, high;
};

/// Each function is allowed four ulps [the OutwardRounding of interval.hpp]; glibc's err by little more than a half.
/// The share of the bound that is used is then an eighth or more; less than a twentieth would say that the bound is
/// idle.
TEST(IntervalBounds, FunctionsEncloseTheirValuesAtSingleNumbers) {
  const Function functions[] = {
      {"exp", [](const Interval& x) { return exp(x); }, [](const Real& x) { return Real(exp(x)); }, -20.0, 20.0},
      {"log", [](const Interval& x) { return log(x); }, [](const Real& x) { return Real(log(x)); }, 0.01, 100.0},
      {"sin", [](const Interval& x) { return sin(x); }, [](const Real& x) { return Real(sin(x)); }, -20.0, 20.0},
      {"cos", [](const Interval& x) { return cos(x); }, [](const Real& x) { return Real(cos(x)); }, -20.0, 20.0},
      {"tan", [](const Interval& x) { return tan(x); }, [](const Real& x) { return Real(tan(x)); }, -1.5, 1.5},
      {"asin", [](const Interval& x) { return asin(x); }, [](const Real& x) { return Real(asin(x)); }, -1.0, 1.0},
      {"acos", [](const Interval& x) { return acos(x); }, [](const Real& x) { return Real(acos(x)); }, -1.0, 1.0},
      {"atan", [](const Interval& x) { return atan(x); }, [](const Real& x) { return Real(atan(x)); }, -20.0, 20.0},
      {"sinh", [](const Interval& x) { return sinh(x); }, [](const Real& x) { return Real(sinh(x)); }, -5.0, 5.0},
      {"cosh", [](const Interval& x) { return cosh(x); }, [](const Real& x) { return Real(cosh(x)); }, -5.0, 5.0},
      {"tanh", [](const Interval& x) { return tanh(x); }, [](const Real& x) { return Real(tanh(x)); }, -5.0, 5.0},
      {"cbrt", [](const Interval& x) { return cbrt(x); }, [](const Real& x) { return Real(cbrt(x)); }, 0.1, 10.0},
      {"atan2", [](const Interval& x) { return atan2(x, Interval(0.7)); },
       [](const Real& x) { return Real(atan2(x, Real(0.7))); }, -5.0, 5.0},
  };
  Random random(23);
  for (const Function& f : functions) {
    Coverage used;
    for (int sample = 0; sample < 1000; ++sample) {
      const double x = random.uniform(f.low, f.high);
      used.add(coverage<Real>(f.enclose(Interval(x)), f.exact(Real(x))), 1.0, std::to_string(x));
    }
    std::printf("%-6s %.3f at %s\n", f.name, used.largest(), used.what().c_str());
    EXPECT_LE(used.largest(), 1.0) << f.name;
    EXPECT_GE(used.largest(), 0.05) << f.name;
  }
}

// f(t) = |sin t| + sqrt(1 + t^2) exp(-t) - max(t, 1/2), by hand: what IntervalJets are compared with shares no
// recurrence with them. At a corner the left and the right side are both enclosed.
std::vector<Real> by_hand(const Real& t, bool is_right) {
  const Real s = sin(t) < 0 || (sin(t) == 0 && !is_right) ? Real(-1) : Real(1);
  const Real root = sqrt(1 + t * t);
  const Real decay = exp(-t);
  const bool is_t = t > Real(0.5) || (t == Real(0.5) && is_right);
  // g = sqrt(1 + t^2): g' = t/g, g'' = 1/g^3
  const Real value = s * sin(t) + root * decay - (is_t ? t : Real(0.5));
  const Real rate = s * cos(t) + (t / root - root) * decay - (is_t ? 1 : 0);
  const Real curvature = -s * sin(t) + (1 / (root * root * root) - 2 * t / root + root) * decay;
  return {value, rate, curvature / 2};
}

TEST(IntervalBounds, JetsEncloseDerivativesWorkedOutByHand) {
  const auto f = [](const IntervalJet& t) {
    return IntervalJet(abs(sin(t)) + sqrt(t * t + IntervalJet(1.0)) * exp(-t) - max(t, IntervalJet(0.5)));
  };
  for (int piece = -60; piece < 60; ++piece) {
    const double a = 0.05 * piece + (piece % 2 == 0 ? 0.0125 : 0.0);
    const double b = a + (piece % 3 == 0 ? 0.05 : 1e-6);
    const IntervalJet enclosure = f(IntervalJet::variable(Interval(a, b)));
    for (int i = 0; i <= 10; ++i) {
      const double t = std::min(b, a + 0.1 * i * (b - a));
      for (const bool is_right : {false, true}) {
        const std::vector<Real> exact = by_hand(Real(t), is_right);
        for (int k = 0; k <= 2; ++k) {
          EXPECT_LE(Real(enclosure[k].lower()), exact[static_cast<std::size_t>(k)]) << "t " << t << " order " << k;
          EXPECT_GE(Real(enclosure[k].upper()), exact[static_cast<std::size_t>(k)]) << "t " << t << " order " << k;
        }
      }
    }
    const bool has_corner = zero_in(sin(Interval(a, b))) || (a <= 0.5 && 0.5 <= b);
    if (!has_corner && b - a < 1e-5) {
      EXPECT_LT(width(enclosure[2]), 1e-4) << a;
    }
  }
}

}  // namespace
}  // namespace trajet
