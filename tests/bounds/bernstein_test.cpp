// The rounding bounds of the Bernstein form, docs/design/bernstein_rounding.md, against exact rationals.

#include "trajet/math/bernstein.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bounds/exact.hpp"

namespace trajet {
namespace {

using test::Coverage;
using test::Random;
using test::Rational;

Rational binomial(int n, int k) {
  Rational c = 1;
  for (int i = 0; i < k; ++i) c = c * (n - i) / (i + 1);
  return c;
}

struct Piece {
  std::vector<double> coefficients;
  double begin;
  double end;

  int degree() const { return static_cast<int>(coefficients.size()) - 1; }
};

/// b_i = sum_k C(i, k) / C(n, k) h^k p^(k)(begin) / k!
std::vector<Rational> exact_coefficients(const Piece& piece) {
  const int n = piece.degree();
  std::vector<Rational> a(piece.coefficients.begin(), piece.coefficients.end());
  const Rational begin(piece.begin);
  const Rational h = Rational(piece.end) - begin;
  for (std::size_t i = 0; i + 1 < a.size(); ++i)
    for (std::size_t k = a.size() - 1; k-- > i;) a[k] += begin * a[k + 1];
  Rational power = 1;
  for (int k = 0; k <= n; ++k) {
    a[static_cast<std::size_t>(k)] *= power / binomial(n, k);
    power *= h;
  }
  std::vector<Rational> b;
  for (int i = 0; i <= n; ++i) {
    b.push_back(a[0]);
    for (std::size_t k = 0; k + 1 < a.size(); ++k) a[k] += a[k + 1];
  }
  return b;
}

/// The largest |error| / bound of the coefficients.
double coverage(const Piece& piece) {
  const BernsteinForm form(piece.coefficients, piece.begin, piece.end);
  const std::vector<Rational> exact = exact_coefficients(piece);
  Rational worst = 0;
  for (int i = 0; i <= form.degree(); ++i)
    worst = std::max<Rational>(worst, abs(Rational(form.coefficient(i)) - exact[static_cast<std::size_t>(i)]));
  return worst == 0 ? 0.0 : static_cast<double>(worst / Rational(form.error()));
}

Piece random_piece(Random& random, int degree) {
  Piece piece{random.coefficients(degree), 0.0, 0.0};
  const int kind = random.integer(0, 3);
  if (kind == 1) piece.begin = random.uniform(-1.0, 1.0);
  if (kind == 2) piece.begin = random.scaled(1e-3, 1e3);
  if (kind == 3) {
    // all terms cancel near the piece: (t - r)^n
    const double r = random.uniform(0.5, 1.5);
    double c = 1.0;
    for (int k = degree; k >= 0; --k) {
      piece.coefficients[static_cast<std::size_t>(k)] = c * std::pow(-r, degree - k);
      c = c * k / (degree - k + 1);
    }
    piece.begin = r * (1.0 + random.uniform(-0.1, 0.1));
  }
  piece.end = piece.begin + random.scaled(1e-10, 1.0);
  return piece;
}

TEST(BernsteinRounding, WeightsAreRoundedAtMostTwice) {
  for (int n = 0; n <= kMaxPolynomialDegree; ++n)
    for (int k = 0; k <= n; ++k) {
      const double weight = detail::kInverseBinomials[static_cast<std::size_t>(n)][static_cast<std::size_t>(k)];
      EXPECT_LE(abs(Rational(weight) * binomial(n, k) - 1), Rational(2.0 * kUnitRoundoff)) << n << " " << k;
    }
}

TEST(BernsteinRounding, BoundsEveryCoefficientOfRandomPieces) {
  Random random(1);
  for (int degree = 0; degree <= 12; ++degree)
    for (int sample = 0; sample < 200; ++sample)
      ASSERT_LE(coverage(random_piece(random, degree)), 1.0) << degree << " " << sample;
  for (const int degree : {16, 20, 26, 32})
    for (int sample = 0; sample < 6; ++sample)
      ASSERT_LE(coverage(random_piece(random, degree)), 1.0) << degree << " " << sample;
  for (const int degree : {57, kMaxPolynomialDegree}) ASSERT_LE(coverage(random_piece(random, degree)), 1.0) << degree;
}

/// Moves one number of a piece a little, by any of its digits.
Piece neighbour(const Piece& piece, Random& random) {
  Piece moved = piece;
  const double factor = 1.0 + random.sign() * std::ldexp(random.uniform(0.5, 1.0), -random.integer(1, 50));
  const int which = random.integer(0, piece.degree() + 2);
  if (which <= piece.degree()) {
    moved.coefficients[static_cast<std::size_t>(which)] *= factor;
  } else if (which == piece.degree() + 1) {
    moved.begin *= factor;
  } else {
    moved.end = moved.begin + (moved.end - moved.begin) * factor;
  }
  return moved;
}

/// The bad case that climbing finds: steps that raise the coverage are kept.
double climb(Random& random, int degree, int steps) {
  Piece best = random_piece(random, degree);
  double highest = coverage(best);
  for (int step = 0; step < steps; ++step) {
    const Piece next = neighbour(best, random);
    const double reached = coverage(next);
    if (reached < highest) continue;
    highest = reached;
    best = next;
  }
  return highest;
}

// The bound counts 4n + 3 roundings that all have the same sign and their largest size. Few do at a time: one step of
// the search after another comes to a third of that.
TEST(BernsteinRounding, IsAThirdReachedByBadCases) {
  Random random(2);
  Coverage all;
  for (int degree = 1; degree <= 4; ++degree)
    for (int start = 0; start < 8; ++start)
      all.add(climb(random, degree, 500), 1.0, "degree " + std::to_string(degree));
  std::printf("largest |error| / bound %.3f, %s\n", all.largest(), all.what().c_str());
  EXPECT_LE(all.largest(), 1.0);
  EXPECT_GE(all.largest(), 0.3);
}

/// What the ranges promise of exact coefficients: to enclose their values and differences, by not too much.
TEST(BernsteinRounding, RangesEncloseExactCoefficientsAndDifferences) {
  Random random(3);
  for (int degree = 0; degree <= 10; ++degree)
    for (int sample = 0; sample < 100; ++sample) {
      const Piece piece = random_piece(random, degree);
      const BernsteinForm form(piece.coefficients, piece.begin, piece.end);
      const auto expect_encloses = [&](const Range& range, const std::vector<Rational>& values, double error) {
        if (values.empty()) return;
        const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
        EXPECT_LE(Rational(range.lower), *least) << degree << " " << sample;
        EXPECT_GE(Rational(range.upper), *greatest) << degree << " " << sample;
        EXPECT_LE(Rational(range.upper) - Rational(range.lower), *greatest - *least + Rational(4.0 * error));
      };
      std::vector<Rational> values = exact_coefficients(piece);
      expect_encloses(form.value_range(), values, form.error());
      double factor = 1.0;
      for (const auto& range : {form.first_difference_range(), form.second_difference_range()}) {
        factor *= 2.0 * (degree + 1);
        for (std::size_t i = 0; i + 1 < values.size(); ++i)
          values[i] = (values[i + 1] - values[i]) * static_cast<int>(values.size() - 1);
        values.pop_back();
        expect_encloses(range, values, 2.0 * factor * form.error());
        if (values.empty()) break;
      }
    }
}

/// A range of coefficients that are rounded already, as those of a derivative are, encloses what the exact ones make.
TEST(BernsteinRounding, RangesPayForRoundedInput) {
  Random random(4);
  for (int sample = 0; sample < 500; ++sample) {
    const Piece piece = random_piece(random, 4);
    Piece twice = piece;
    for (std::size_t k = 0; k + 2 < piece.coefficients.size(); ++k) {
      const double once = static_cast<double>(k + 2) * piece.coefficients[k + 2];
      twice.coefficients[k] = static_cast<double>(k + 1) * once;
    }
    twice.coefficients.resize(3);
    const BernsteinForm form(twice.coefficients, piece.begin, piece.end);
    for (const Rational& t : {Rational(piece.begin), Rational(piece.end)}) {
      Rational curvature = 0;
      for (int k = piece.degree(); k >= 2; --k)
        curvature = curvature * t + Rational(piece.coefficients[static_cast<std::size_t>(k)]) * k * (k - 1);
      EXPECT_LE(Rational(form.value_range(2).lower), curvature);
      EXPECT_GE(Rational(form.value_range(2).upper), curvature);
    }
    EXPECT_GT(form.value_range(2).upper, form.value_range().upper);
  }
}

}  // namespace
}  // namespace trajet
