#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>

#include "trajet/ensemble/dispersion.hpp"
#include "trajet/ensemble/distribution.hpp"
#include "trajet/ensemble/quantiles.hpp"
#include "trajet/ensemble/random_stream.hpp"
#include "trajet/ensemble/share_interval.hpp"

namespace trajet {
namespace {

NumberSource source_of(const std::vector<double>& numbers) {
  return [&numbers](const std::function<void(double)>& use) {
    for (const double number : numbers) use(number);
  };
}

TEST(Quantiles, AreThoseOfTheSortedNumbers) {
  std::vector<double> numbers;
  for (std::uint64_t i = 0; i < 2001; ++i) numbers.push_back(std::tan(3.0 * (uniform_number(1, i, 0) - 0.5)) * 1e3);
  numbers.insert(numbers.end(), {0.0, -0.0, 1e300, -1e300, 5e-324, 0.0, 0.0});
  const std::vector<double> shares{0.0, 0.05, 0.25, 0.5, 0.77, 0.95, 1.0};
  const std::vector<double> found = quantiles(source_of(numbers), numbers.size(), shares);
  std::sort(numbers.begin(), numbers.end());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double place = shares[i] * static_cast<double>(numbers.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double high = numbers[std::min(below + 1, numbers.size() - 1)];
    EXPECT_EQ(found[i], numbers[below] + (high - numbers[below]) * (place - std::floor(place))) << shares[i];
  }
  EXPECT_EQ(quantiles(source_of({{3.0}}), 1, shares), std::vector<double>(shares.size(), 3.0));
  EXPECT_TRUE(std::isnan(quantiles(source_of({}), 0, shares)[0]));
}

TEST(RunningStatistics, KeepDigitsFarFromZero) {
  RunningStatistics statistics;
  for (int i = 0; i < 1000; ++i) statistics.add(1e9 + i % 2);
  EXPECT_EQ(statistics.count(), 1000U);
  EXPECT_DOUBLE_EQ(statistics.mean(), 1e9 + 0.5);
  EXPECT_NEAR(statistics.deviation(), 0.5 * std::sqrt(1000.0 / 999.0), 1e-9);
  EXPECT_EQ(statistics.min(), 1e9);
  EXPECT_EQ(statistics.max(), 1e9 + 1);
}

TEST(ShareIntervals, HoldTheTrueShareAsOftenAsTheySay) {
  // the probability that the interval holds p, summed over all outcomes: exact, no simulation
  for (const double p : {0.001, 0.02, 0.3, 0.5, 0.97}) {
    for (const std::uint64_t n : {10U, 57U, 300U}) {
      const boost::math::binomial outcomes(static_cast<double>(n), p);
      double covered = 0.0;
      for (std::uint64_t k = 0; k <= n; ++k) {
        const ShareInterval interval = exact_share_interval(k, n);
        if (interval.low <= p && p <= interval.high) covered += pdf(outcomes, static_cast<double>(k));
      }
      EXPECT_GE(covered, 0.95) << p << " of " << n;
    }
  }
  // and no wider than need be: half the width of a normal share is 1.96 sqrt(p q / n)
  const ShareInterval half = exact_share_interval(5000, 10000);
  EXPECT_NEAR(0.5 * (half.high - half.low), 1.96 * 0.005, 2e-4);
  EXPECT_EQ(exact_share_interval(0, 50).low, 0.0);
  EXPECT_NEAR(exact_share_interval(0, 50).high, 1.0 - std::pow(0.025, 1.0 / 50.0), 1e-12);
  EXPECT_EQ(exact_share_interval(50, 50).high, 1.0);
}

TEST(ShareIntervals, HoldForOneWhoLooksAllTheTime) {
  // 1,000 sequences of 300: the share in which the interval ever misses is at most 5 %, plus 3 deviations of 0.7 %
  constexpr int kRuns = 1000, kLength = 300;
  for (const double p : {0.05, 0.5}) {
    int missed = 0, missed_plainly = 0;
    for (int run = 0; run < kRuns; ++run) {
      std::uint64_t hits = 0;
      bool is_missed = false, is_missed_plainly = false;
      for (std::uint64_t n = 1; n <= kLength; ++n) {
        if (uniform_number(static_cast<std::uint64_t>(run), n, 0) < p) ++hits;
        if (n % 5 != 0) continue;
        const ShareInterval interval = anytime_share_interval(hits, n), plain = exact_share_interval(hits, n);
        is_missed |= p < interval.low || p > interval.high;
        is_missed_plainly |= p < plain.low || p > plain.high;
      }
      missed += is_missed ? 1 : 0;
      missed_plainly += is_missed_plainly ? 1 : 0;
    }
    EXPECT_LE(missed, 0.05 * kRuns + 3.0 * std::sqrt(0.05 * 0.95 * kRuns));
    EXPECT_GT(missed_plainly, 0.1 * kRuns) << "which the plain interval does not do";
  }
}

TEST(Dispersion, FindsEllipseAndCircles) {
  constexpr std::uint64_t kCount = 100'000;
  const Vector3 major = Vector3(1.0, 2.0, 0.0).normalized(), minor(0.0, 0.0, 1.0), center(100.0, -3.0, 1.0);
  const PointSource points = [&](const std::function<void(const Vector3&)>& use) {
    for (std::uint64_t i = 0; i < kCount; ++i)
      use(center + 2.0 * normal_quantile(uniform_number(5, i, 0)) * major +
          2.0 * normal_quantile(uniform_number(5, i, 1)) * minor * 0.5);
  };
  const Dispersion spread = dispersion(points);
  const double sampling = 5.0 / std::sqrt(2.0 * kCount);  // five deviations of a standard deviation
  EXPECT_EQ(spread.count, kCount);
  EXPECT_LT((spread.mean - center).norm(), 5.0 * 2.3 / std::sqrt(kCount));
  EXPECT_NEAR(spread.major_deviation, 2.0, 2.0 * sampling);
  EXPECT_NEAR(spread.minor_deviation, 1.0, sampling);
  EXPECT_NEAR(std::abs(spread.major.dot(major)), 1.0, 1e-3);
  EXPECT_NEAR(std::abs(spread.minor.dot(minor)), 1.0, 1e-3);

  // of a round scatter of deviation s the circles are s sqrt(-2 ln(1 - share))
  const PointSource round = [&](const std::function<void(const Vector3&)>& use) {
    for (std::uint64_t i = 0; i < kCount; ++i)
      use(center + 3.0 * normal_quantile(uniform_number(6, i, 0)) * major +
          3.0 * normal_quantile(uniform_number(6, i, 1)) * minor);
  };
  for (const Dispersion::Circle& circle : dispersion(round).about_mean) {
    const double expected = 3.0 * std::sqrt(-2.0 * std::log(1.0 - circle.share));
    EXPECT_NEAR(circle.radius, expected, 0.02 * expected);
    EXPECT_LT(circle.ci95[0], circle.radius);
    EXPECT_GT(circle.ci95[1], circle.radius);
  }
}

TEST(Dispersion, CirclesHaveIntervalsThatHold) {
  // 400 samples of 200 points: the interval holds the true radius in 95 %, less 3 deviations of 1.1 %
  int covered = 0;
  constexpr int kRuns = 400;
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    const PointSource points = [&](const std::function<void(const Vector3&)>& use) {
      for (std::uint64_t i = 0; i < 200; ++i)
        use({normal_quantile(uniform_number(run, i, 0)), normal_quantile(uniform_number(run, i, 1)), 0.0});
    };
    const Dispersion::Circle half = circles_about(Vector3::Zero(), 200, points)[0];
    const double truth = std::sqrt(2.0 * std::log(2.0));
    covered += half.ci95[0] <= truth && truth <= half.ci95[1] ? 1 : 0;
  }
  EXPECT_GT(covered, kRuns * (0.95 - 3.0 * 0.011));
}

}  // namespace
}  // namespace trajet
