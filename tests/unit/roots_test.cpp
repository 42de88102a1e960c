#include "trajet/math/roots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace trajet {
namespace {

constexpr double kUlp = std::numeric_limits<double>::epsilon();

struct Found {
  std::vector<Root> roots;
  SearchStatus status;
};

Found find(const std::vector<double>& coefficients, double begin, double end, double touch_tolerance = 0.0) {
  Found found;
  found.status = visit_roots(coefficients, begin, end, touch_tolerance, [&](const Root& root) {
    found.roots.push_back(root);
    return true;
  });
  return found;
}

// prod (t - roots[i]), times `scale`, rounded to double once.
std::vector<double> from_roots(const std::vector<long double>& roots, long double scale = 1.0L) {
  std::vector<long double> p{scale};
  for (const long double root : roots) {
    p.push_back(0.0L);
    for (std::size_t k = p.size() - 1; k > 0; --k) p[k] = p[k - 1] - root * p[k];
    p[0] *= -root;
  }
  return {p.begin(), p.end()};
}

TEST(Roots, OfAParabolaBothInOrder) {
  const Found found = find(from_roots({0.25L, 0.75L}), 0.0, 1.0);
  ASSERT_EQ(found.roots.size(), 2u);
  EXPECT_EQ(found.status, SearchStatus::complete);
  EXPECT_NEAR(found.roots[0].time, 0.25, kUlp);
  EXPECT_NEAR(found.roots[1].time, 0.75, kUlp);
  EXPECT_EQ(found.roots[0].sign_before, 1);
  EXPECT_EQ(found.roots[0].sign_after, -1);
  EXPECT_EQ(found.roots[1].sign_after, 1);
}

TEST(Roots, BackwardInTimeComeInTheOrderOfTravel) {
  const Found found = find(from_roots({0.25L, 0.75L}), 1.0, 0.0);
  ASSERT_EQ(found.roots.size(), 2u);
  EXPECT_NEAR(found.roots[0].time, 0.75, kUlp);
  EXPECT_NEAR(found.roots[1].time, 0.25, kUlp);
  EXPECT_EQ(found.roots[0].sign_before, 1);
  EXPECT_EQ(found.roots[0].sign_after, -1);
}

// The coefficients are rounded, so that a root moves by about sum |c_k| t^k eps / |p'|: that, times 4, is the
// tolerance.
TEST(Roots, OfRandomPolynomialsOfEveryDegree) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1.2, 1.2);
  for (int degree = 1; degree <= 40; ++degree) {
    for (int sample = 0; sample < 50; ++sample) {
      // A few roots within reach of each other, the others outside the interval where they do not spoil the condition.
      std::vector<long double> roots;
      const int inner = std::min(degree, 6);
      for (int i = 0; i < inner; ++i) roots.push_back(uniform(engine));
      for (int i = inner; i < degree; ++i) roots.push_back((i % 2 == 0 ? 1.0L : -1.0L) * (3.0L + 0.1L * i));
      std::sort(roots.begin(), roots.end());
      bool is_close = false;
      std::vector<long double> expected;
      for (std::size_t i = 0; i < roots.size(); ++i) {
        is_close = is_close || (i > 0 && roots[i] - roots[i - 1] < 1e-2L);
        if (std::abs(roots[i]) <= 1.0L) expected.push_back(roots[i]);
        is_close = is_close || std::abs(std::abs(roots[i]) - 1.0L) < 1e-6L;
      }
      if (is_close) continue;
      const std::vector<double> p = from_roots(roots);
      const Found found = find(p, -1.0, 1.0);
      ASSERT_EQ(found.roots.size(), expected.size()) << "degree " << degree;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const double t = static_cast<double>(expected[i]);
        const MeasuredJet at = evaluate_polynomial(p, t);
        const double condition = at.magnitude * kUlp / std::abs(at.jet.rate);
        EXPECT_EQ(found.roots[i].kind, RootKind::crossing);
        EXPECT_NEAR(found.roots[i].time, t, 4.0 * condition + kUlp) << "degree " << degree;
        EXPECT_LE(std::abs(found.roots[i].time - t), found.roots[i].error_bound + condition + kUlp);
      }
    }
  }
}

TEST(Roots, NearDoubleOnesAreToldApart) {
  for (const long double gap : {1e-2L, 1e-3L, 1e-4L, 1e-5L, 1e-6L}) {
    const Found found = find(from_roots({0.3L, 0.3L + gap, 0.9L}), 0.0, 1.0);
    ASSERT_EQ(found.roots.size(), 3u) << static_cast<double>(gap);
    // p' = gap (0.6) there; the terms add up to 1
    EXPECT_NEAR(found.roots[0].time, 0.3, 4.0 * kUlp / static_cast<double>(gap));
    EXPECT_NEAR(found.roots[1].time, static_cast<double>(0.3L + gap), 4.0 * kUlp / static_cast<double>(gap));
  }
}

TEST(Roots, PenetrationAndClearanceOfOneNanometre) {
  // z = 4.9 (t - 1/2)^2 -+ 1e-9: crosses twice within 2.9e-5 s, or not at all, however long the interval.
  for (const double end : {1.0, 10.0, 1000.0}) {
    const Found twice = find({4.9 * 0.25 - 1e-9, -4.9, 4.9}, 0.0, end);
    ASSERT_EQ(twice.roots.size(), 2u);
    // Rounding of 1e-16 in z at a speed of 1.4e-4.
    EXPECT_NEAR(twice.roots[1].time - twice.roots[0].time, 2.0 * std::sqrt(1e-9 / 4.9), 1e-11);
    EXPECT_TRUE(find({4.9 * 0.25 + 1e-9, -4.9, 4.9}, 0.0, end).roots.empty());
  }
}

TEST(Roots, TangencyIsOneTouch) {
  // (t - 1/3)^2 with rounded coefficients
  const Found found = find(from_roots({1.0L / 3.0L, 1.0L / 3.0L}), 0.0, 1.0);
  ASSERT_EQ(found.roots.size(), 1u);
  EXPECT_EQ(found.roots[0].kind, RootKind::touch);
  EXPECT_NEAR(found.roots[0].time, 1.0 / 3.0, 1e-8);  // sqrt(eps)
  EXPECT_LT(found.roots[0].error_bound, 1e-7);
  // Either side of it, at three times the tolerance that the rounding of terms of size 4/9 needs.
  EXPECT_EQ(find({1.0 / 9.0 - 2e-14, -2.0 / 3.0, 1.0}, 0.0, 1.0).roots.size(), 2u);
  EXPECT_EQ(find({1.0 / 9.0 + 2e-14, -2.0 / 3.0, 1.0}, 0.0, 1.0).roots.size(), 0u);
}

TEST(Roots, TouchToleranceIsTheCallers) {
  EXPECT_EQ(find({0.25 + 1e-7, -1.0, 1.0}, 0.0, 1.0, 1e-6).roots.at(0).kind, RootKind::touch);
  EXPECT_EQ(find({0.25 - 1e-7, -1.0, 1.0}, 0.0, 1.0, 1e-6).roots.at(0).kind, RootKind::touch);
  EXPECT_EQ(find({0.25 + 1e-5, -1.0, 1.0}, 0.0, 1.0, 1e-6).roots.size(), 0u);
  EXPECT_EQ(find({0.25 - 1e-5, -1.0, 1.0}, 0.0, 1.0, 1e-6).roots.size(), 2u);
}

TEST(Roots, MultipleOnesCountOnce) {
  const Found third = find(from_roots({0.3L, 0.3L, 0.3L}), 0.0, 1.0);
  ASSERT_EQ(third.roots.size(), 1u);
  EXPECT_EQ(third.roots[0].kind, RootKind::crossing);
  EXPECT_NEAR(third.roots[0].time, 0.3, third.roots[0].error_bound);
  EXPECT_LT(third.roots[0].error_bound, 1e-4);  // cube root of a few eps

  const Found fourth = find(from_roots({0.3L, 0.3L, 0.3L, 0.3L}), 0.0, 1.0);
  ASSERT_EQ(fourth.roots.size(), 1u);
  EXPECT_EQ(fourth.roots[0].kind, RootKind::touch);
  EXPECT_NEAR(fourth.roots[0].time, 0.3, fourth.roots[0].error_bound);

  // Where the terms vanish with the function, so does the tolerance: the touch is found on the smallest of pieces.
  const Found at_zero = find({0.0, 0.0, 0.0, 0.0, 1.0}, -0.7, 1.0);
  ASSERT_EQ(at_zero.roots.size(), 1u);
  EXPECT_EQ(at_zero.roots[0].kind, RootKind::touch);
  EXPECT_NEAR(at_zero.roots[0].time, 0.0, 1e-15);

  const Found fifth = find({0.0, 0.0, 0.0, 0.0, 0.0, 1.0}, -0.7, 1.0);
  ASSERT_EQ(fifth.roots.size(), 1u);
  EXPECT_EQ(fifth.roots[0].kind, RootKind::crossing);
  EXPECT_NEAR(fifth.roots[0].time, 0.0, 1e-15);
}

TEST(Roots, AtTheEndsBelongToTheInterval) {
  const Found found = find(from_roots({0.0L, 1.0L}), 0.0, 1.0);
  ASSERT_EQ(found.roots.size(), 2u);
  EXPECT_TRUE(found.roots[0].at_begin);
  EXPECT_EQ(found.roots[0].time, 0.0);
  EXPECT_EQ(found.roots[0].sign_before, 1);
  EXPECT_EQ(found.roots[0].sign_after, -1);
  EXPECT_TRUE(found.roots[1].at_end);
  EXPECT_EQ(found.roots[1].time, 1.0);
  EXPECT_EQ(found.roots[1].sign_after, 1);
}

TEST(Roots, JustBeyondTheEndsByRoundingOnlyBelongToIt) {
  for (const double shift : {-1e-17, 0.0, 1e-17}) {
    EXPECT_EQ(find({1.0 + shift, -1.0 - shift}, 0.0, 1.0).roots.size(), 1u);
    EXPECT_EQ(find({1.0, -1.0 + 10.0 * shift}, 0.0, 1.0).roots.size(), 1u);
  }
  EXPECT_EQ(find({1.0, -0.99999}, 0.0, 1.0).roots.size(), 0u);
}

TEST(Roots, ACrossingWithinTheToleranceOfTheBeginIsWhereTheSignChanges) {
  const Found found = find({-0.5, 1.0}, 0.45, 1.0, 0.1);
  ASSERT_EQ(found.roots.size(), 1u);
  EXPECT_TRUE(found.roots[0].at_begin);
  EXPECT_EQ(found.roots[0].time, 0.5);
}

TEST(Roots, TouchAtTheEnd) {
  const Found found = find({1.0, -2.0, 1.0}, 0.0, 1.0);
  ASSERT_EQ(found.roots.size(), 1u);
  EXPECT_EQ(found.roots[0].kind, RootKind::touch);
  EXPECT_TRUE(found.roots[0].at_end);
}

TEST(Roots, DegenerateLeadingCoefficients) {
  const Found found = find({-0.5, 1.0, 0.0, 0.0, 0.0}, 0.0, 1.0);
  ASSERT_EQ(found.roots.size(), 1u);
  EXPECT_EQ(found.roots[0].time, 0.5);
  const Found tiny = find({-0.5, 1.0, 1e-300, -1e-310, 1e-320}, 0.0, 1.0);
  ASSERT_EQ(tiny.roots.size(), 1u);
  EXPECT_EQ(tiny.roots[0].time, 0.5);
}

TEST(Roots, ConstantsHaveNoneOrAreZero) {
  EXPECT_EQ(find({1.0}, 0.0, 1.0).status, SearchStatus::complete);
  EXPECT_TRUE(find({1.0}, 0.0, 1.0).roots.empty());
  for (const std::vector<double>& zero : {std::vector<double>{0.0}, {0.0, 0.0, 0.0}, {1e-20, 1e-20}}) {
    const Found found = find(zero, 0.0, 1.0, 1e-15);
    EXPECT_EQ(found.status, SearchStatus::identically_zero);
    EXPECT_TRUE(found.roots.empty());
  }
}

TEST(Roots, VisitorStopsTheSearch) {
  int visited = 0;
  const SearchStatus status =
      visit_roots(std::vector<double>(from_roots({0.2L, 0.4L, 0.6L})), 0.0, 1.0, 0.0, [&](const Root&) {
        ++visited;
        return false;
      });
  EXPECT_EQ(visited, 1);
  EXPECT_EQ(status, SearchStatus::stopped);
}

TEST(Roots, WhatIsNotFiniteIsUnresolved) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& p : {std::vector<double>{kNan, 1.0}, {1.0, kInfinity, -1.0}, {1.0, -kInfinity}}) {
    const Found found = find(p, 0.0, 1.0);
    EXPECT_EQ(found.status, SearchStatus::unresolved);
    ASSERT_EQ(found.roots.size(), 1u);
    EXPECT_EQ(found.roots[0].kind, RootKind::unresolved);
  }
}

TEST(Roots, OfTooHighADegreeAreRefused) {
  EXPECT_THROW(find(std::vector<double>(kMaxPolynomialDegree + 2, 1.0), 0.0, 1.0), std::length_error);
  EXPECT_THROW(find({}, 0.0, 1.0), std::domain_error);
}

TEST(Roots, FirstRootLeavesTheBeginAndTouchesBehind) {
  const std::vector<double> p = from_roots({0.0L, 0.25L, 0.25L, 0.5L, 0.75L});
  const std::optional<Root> root = first_root(p, 0.0, 1.0);
  ASSERT_TRUE(root);
  EXPECT_NEAR(root->time, 0.5, 1e-14);
  EXPECT_FALSE(first_root(p, 0.8, 1.0));
}

// Coefficients of the Bernstein form bound the polynomial, whatever the interval.
/// c + a (t - m)^2 on [0, 1], whose enclosures tell the sign of its curvature only.
struct HardlyEnclosed {
  using Piece = int;
  double a, m, c;
  mutable int evaluations = 0;

  double begin() const { return 0.0; }
  double end() const { return 1.0; }
  int piece(double, double) const { return 0; }
  Range value_range(int) const { return {-1e3, 1e3}; }
  Range rate_range(int) const { return {-1e3, 1e3}; }
  Range curvature_range(int) const { return {2.0 * a, 2.0 * a}; }
  FunctionSample at(double t) const {
    ++evaluations;
    const double d = t - m;
    return {{c + a * d * d, 2.0 * a * d, 2.0 * a}, 1e-15, 1e-14};
  }
};

TEST(Roots, OfCurvedFunctionsAreFoundAndExcludedByTheirEnds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<> uniform(-1.0, 1.0);
  int cheap = 0, crossed = 0;
  for (int i = 0; i < 3000; ++i) {
    const HardlyEnclosed f{2.0 * uniform(random), 0.5 + 0.7 * uniform(random), 0.5 * uniform(random)};
    if (std::abs(f.a) < 1e-3 || std::abs(f.c) < 1e-6) continue;
    std::size_t expected = 0;
    for (const double side : {-1.0, 1.0}) {
      const double t = f.m + side * std::sqrt(std::max(0.0, -f.c / f.a));
      if (f.c * f.a < 0.0 && t > 0.0 && t < 1.0) ++expected;
    }
    std::size_t found = 0;
    visit_roots(f, [&](const Root& root) {
      EXPECT_EQ(root.kind, RootKind::crossing);
      ++found;
      return true;
    });
    ASSERT_EQ(found, expected) << f.a << " " << f.m << " " << f.c;
    crossed += expected > 0 ? 1 : 0;
    cheap += expected == 0 && f.evaluations == 2 ? 1 : 0;
  }
  // most of those without a root are known by two evaluations
  EXPECT_GT(crossed, 500);
  EXPECT_GT(cheap, 1000);
}

TEST(BernsteinForm, EnclosesValueAndDerivatives) {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  for (int degree = 0; degree <= 30; ++degree) {
    std::vector<double> p;
    for (int k = 0; k <= degree; ++k) p.push_back(normal(engine));
    const double begin = normal(engine);
    const double end = begin + normal(engine);
    const BernsteinForm form(p, begin, end);
    const double h = end - begin;
    for (int i = 0; i <= 16; ++i) {
      long double t = begin + static_cast<long double>(i) / 16.0L * h;
      if (i == 16) t = end;
      long double value = 0.0L, rate = 0.0L, half_curvature = 0.0L;
      for (std::size_t k = p.size(); k-- > 0;) {
        half_curvature = half_curvature * t + rate;
        rate = rate * t + value;
        value = value * t + p[k];
      }
      EXPECT_LE(form.value_range().lower, value);
      EXPECT_GE(form.value_range().upper, value);
      EXPECT_LE(form.first_difference_range().lower, rate * h);
      EXPECT_GE(form.first_difference_range().upper, rate * h);
      EXPECT_LE(form.second_difference_range().lower, 2.0L * half_curvature * h * h);
      EXPECT_GE(form.second_difference_range().upper, 2.0L * half_curvature * h * h);
    }
  }
}

}  // namespace
}  // namespace trajet
