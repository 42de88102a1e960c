#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <set>

#include "trajet/ensemble/distribution.hpp"
#include "trajet/ensemble/random_stream.hpp"
#include "trajet/ensemble/sweep_plan.hpp"

namespace trajet {
namespace {

VariedQuantity named(const std::string& name) {
  return {name, [](Scene&) { return VariedQuantity::Setter([](double) {}); }};
}

SweepPlan uniform_plan(std::size_t quantities, std::uint64_t count, SampleDesign design) {
  SweepPlan plan{.samples_per_node = count, .seed = 7, .design = design};
  for (std::size_t i = 0; i < quantities; ++i)
    plan.samples.push_back({named("q" + std::to_string(i)), Distribution::uniform(0.0, 1.0)});
  return plan;
}

std::vector<std::vector<double>> all_values(const SweepPlan& plan) {
  PlanValues values(plan);
  std::vector<std::vector<double>> rows;
  for (std::uint64_t i = 0; i < plan.count(); ++i) {
    rows.emplace_back(plan.quantity_count());
    values(i, rows.back());
  }
  return rows;
}

TEST(RandomStream, IsUniformAndIndependentOfItsNeighbours) {
  // chi² of 100 bins has a mean of 99 and a deviation of 14; 5 deviations are met once in a million
  constexpr int kCount = 200'000, kBins = 100;
  for (const std::uint32_t stream : {0U, 1U}) {
    std::vector<double> bins(kBins);
    double product = 0.0;
    for (std::uint64_t i = 0; i < kCount; ++i) {
      const double u = uniform_number(3, i, stream), next = uniform_number(3, i, stream + 1);
      bins[static_cast<std::size_t>(u * kBins)] += 1.0;
      product += (u - 0.5) * (next - 0.5);
    }
    double chi_squared = 0.0;
    for (const double bin : bins) chi_squared += (bin - kCount / kBins) * (bin - kCount / kBins) / (kCount / kBins);
    EXPECT_LT(chi_squared, 99.0 + 5.0 * 14.0);
    EXPECT_LT(std::abs(product) / kCount, 5.0 / 12.0 / std::sqrt(kCount));
  }
  EXPECT_NE(uniform_number(3, 0, 0), uniform_number(4, 0, 0));
  EXPECT_NE(uniform_number(3, 0, 0), uniform_number(3, 0, 0, RandomPurpose::scramble));
}

TEST(RandomStream, PermutesWhateverTheCount) {
  for (const std::uint64_t count : {1U, 2U, 3U, 16U, 17U, 1000U, 4096U}) {
    std::set<std::uint64_t> seen;
    std::uint64_t in_place = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t place = permuted_index(i, count, 11, 0);
      EXPECT_LT(place, count);
      seen.insert(place);
      if (place == i) ++in_place;
    }
    EXPECT_EQ(seen.size(), count);
    EXPECT_LT(in_place, 10U) << "of a random order one stays in place, on average";
  }
}

TEST(Distributions, HaveTheQuantilesOfBoost) {
  for (const double u : {1e-12, 1e-3, 0.2, 0.5, 0.9, 1.0 - 1e-9}) {
    const boost::math::normal normal(3.0, 2.0);
    EXPECT_NEAR(Distribution::normal(3.0, 2.0).quantile(u), quantile(normal, u), 1e-13 * 15.0);
    EXPECT_DOUBLE_EQ(Distribution::uniform(-1.0, 3.0).quantile(u), -1.0 + 4.0 * u);
    // mean 500, deviation 30: of the quantity, not of its logarithm
    const double s2 = std::log1p(0.06 * 0.06);
    const boost::math::lognormal lognormal(std::log(500.0) - 0.5 * s2, std::sqrt(s2));
    EXPECT_NEAR(mean(lognormal), 500.0, 1e-9);
    EXPECT_NEAR(standard_deviation(lognormal), 30.0, 1e-9);
    EXPECT_NEAR(Distribution::lognormal(500.0, 30.0).quantile(u), quantile(lognormal, u), 1e-10);
    // what lies between is the share u of what the limits leave; far out too, where 1 - share has no digits
    for (const auto& [low, high] : {std::pair(2.0, 4.0), std::pair(13.0, 30.0), std::pair(-30.0, -13.0)}) {
      const double value = Distribution::truncated(3.0, 2.0, low, high).quantile(u);
      const bool is_upper = low > 3.0;
      const auto share = [&](double x) { return is_upper ? cdf(complement(normal, x)) : cdf(normal, x); };
      const double expected = is_upper ? 1.0 - u : u;
      const double from = is_upper ? high : low, to = is_upper ? low : high;
      EXPECT_NEAR((share(value) - share(from)) / (share(to) - share(from)), expected, 1e-9) << u << " in " << low;
      EXPECT_GE(value, low);
      EXPECT_LE(value, high);
    }
  }
}

TEST(SweepPlan, CountsTheGridLikeADial) {
  const SweepPlan plan{.axes = {{named("a"), 0.0, 1.0, 3}, {named("b"), 10.0, 20.0, 2}}};
  EXPECT_EQ(plan.count(), 6U);
  const std::vector<std::vector<double>> expected{{0.0, 10.0}, {0.0, 20.0}, {0.5, 10.0},
                                                  {0.5, 20.0}, {1.0, 10.0}, {1.0, 20.0}};
  EXPECT_EQ(all_values(plan), expected);
}

TEST(SweepPlan, ReachesTheEndsOfAnAxisExactly) {
  const GridAxis axis{named("a"), -0.1, 0.3, 7};
  EXPECT_EQ(axis.value(0), -0.1);
  EXPECT_EQ(axis.value(6), 0.3);
  EXPECT_EQ((GridAxis{named("a"), 2.0, 3.0, 1}).value(0), 2.0);
}

TEST(SweepPlan, GivesAMotionTheSameValuesInWhateverOrder) {
  for (const SampleDesign design : {SampleDesign::random, SampleDesign::latin_hypercube, SampleDesign::sobol}) {
    SweepPlan plan = uniform_plan(3, 50, design);
    plan.axes = {{named("a"), 0.0, 1.0, 4}};
    const std::vector<std::vector<double>> forward = all_values(plan);
    PlanValues values(plan);
    std::vector<double> row(4);
    for (std::uint64_t i = plan.count(); i-- > 0;) {
      values(i, row);
      EXPECT_EQ(row, forward[i]) << i;
    }
  }
}

TEST(SweepPlan, FillsEachPartOfALatinHypercubeOnce) {
  constexpr std::size_t kCount = 37;
  const std::vector<std::vector<double>> rows = all_values(uniform_plan(3, kCount, SampleDesign::latin_hypercube));
  for (std::size_t q = 0; q < 3; ++q) {
    std::set<std::size_t> parts;
    for (const std::vector<double>& row : rows) parts.insert(static_cast<std::size_t>(row[q] * kCount));
    EXPECT_EQ(parts.size(), kCount);
  }
  EXPECT_NE(rows[0][0] < rows[1][0], rows[1][0] < rows[2][0] && rows[0][1] < rows[1][1]);
}

TEST(SweepPlan, FillsDyadicPartsOfSobolsSequenceEvenly) {
  // 256 points: each of 256 parts of each coordinate once, and each of 16 x 16 squares of the first two once
  const std::vector<std::vector<double>> rows = all_values(uniform_plan(4, 256, SampleDesign::sobol));
  for (std::size_t q = 0; q < 4; ++q) {
    std::set<std::size_t> parts;
    for (const std::vector<double>& row : rows) parts.insert(static_cast<std::size_t>(row[q] * 256.0));
    EXPECT_EQ(parts.size(), 256U) << q;
  }
  std::set<std::size_t> squares;
  for (const std::vector<double>& row : rows)
    squares.insert(static_cast<std::size_t>(row[0] * 16.0) * 16 + static_cast<std::size_t>(row[1] * 16.0));
  EXPECT_EQ(squares.size(), 256U);
}

TEST(SweepPlan, CorrelatesNormalQuantities) {
  constexpr std::uint64_t kCount = 40'000;
  SweepPlan plan{.samples_per_node = kCount, .seed = 2};
  for (const char* name : {"a", "b", "c"}) plan.samples.push_back({named(name), Distribution::normal(1.0, 2.0)});
  plan.correlations = {{0, 1, 0.8}, {1, 2, -0.5}, {0, 2, -0.3}};
  Matrix3 squares = Matrix3::Zero();
  for (const std::vector<double>& row : all_values(plan)) {
    const Vector3 score = (Vector3(row[0], row[1], row[2]) - Vector3::Constant(1.0)) / 2.0;
    squares += score * score.transpose() / kCount;
  }
  // the deviation of a correlation r of n is (1 - r²)/sqrt(n), of a variance sqrt(2/n)
  Matrix3 expected;
  expected << 1.0, 0.8, -0.3, 0.8, 1.0, -0.5, -0.3, -0.5, 1.0;
  EXPECT_LT((squares - expected).cwiseAbs().maxCoeff(), 5.0 * std::sqrt(2.0 / kCount));

  plan.correlations = {{0, 1, 0.9}, {1, 2, 0.9}, {0, 2, -0.9}};
  EXPECT_THROW(PlanValues{plan}, std::invalid_argument);
}

}  // namespace
}  // namespace trajet
