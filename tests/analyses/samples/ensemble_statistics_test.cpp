// Statistics gathered in one pass against those of the same numbers sorted and summed as they lie.
#include "analyses/samples/ensemble_statistics.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "analyses/samples/order_statistics.hpp"
#include "analyses/samples/sampling.hpp"

namespace gamut {
namespace {

using ::testing::DoubleNear;

const std::vector<double> probabilities = {0, 0.01, 0.05, 0.5, 0.5, 0.95, 0.99, 1};

/// Quantile by definition 7, from the sorted values.
double exactQuantile(const std::vector<double>& sorted, double probability) {
  const double position = probability * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

EnsembleStatistics gathered(const std::vector<double>& values, double lower, double upper,
                            std::size_t blockSize = 1000) {
  Envelope expected(1, 1);
  expected.lower.data[0] = lower;
  expected.upper.data[0] = upper;
  EnsembleStatistics statistics(expected, 0);
  for (std::size_t first = 0; first < values.size(); first += blockSize) {
    SampleBlock block(first, std::min(blockSize, values.size() - first), true, 0, 1, 1);
    for (std::size_t i = 0; i < block.size(); ++i) block(i, 0, 0) = values[first + i];
    statistics.include(block, 1);
  }
  return statistics;
}

/// That every quantile is as near as is said. Returns the resolution.
double expectWithinResolution(std::vector<double> values, double lower, double upper) {
  const Statistics found = gathered(values, lower, upper).statistics(1, Dependence::none, probabilities);
  std::ranges::sort(values);
  for (std::size_t q = 0; q < probabilities.size(); ++q)
    EXPECT_LE(std::abs(found.quantiles[q](0, 0) - exactQuantile(values, probabilities[q])), found.resolution(0, 0))
        << probabilities[q];
  EXPECT_EQ(found.quantiles.front()(0, 0), values.front());
  EXPECT_EQ(found.quantiles.back()(0, 0), values.back());
  return found.resolution(0, 0);
}

std::vector<double> normal(std::size_t count, double mean, double deviation) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> distribution(mean, deviation);
  std::vector<double> values(count);
  for (double& value : values) value = distribution(random);
  return values;
}

TEST(EnsembleStatistics, QuantilesAreWithinABinOfThoseOfTheSortedSamples) {
  for (std::size_t count : {1u, 2u, 3u, 64u, 1000u, 40000u}) {
    const double resolution = expectWithinResolution(normal(count, 3, 0.1), 2, 4);
    EXPECT_LE(resolution, 2.0 / 4096 + 1e-10) << count;
    if (count > 2) {
      EXPECT_GT(resolution, 1.9 / 4096) << count;
    }
  }
}

TEST(EnsembleStatistics, QuantilesInTheOpenEndsAreAsFineAsThoseAre) {
  const std::vector<double> values = normal(10000, 3, 0.1);
  const double least = *std::ranges::min_element(values);
  EXPECT_THAT(expectWithinResolution(values, 2.9, 3.3), DoubleNear(2.9 - least, 1e-8));  // a sixth lies below
  EXPECT_THAT(expectWithinResolution(values, 10, 12), DoubleNear(10 - least, 1e-8));
}

TEST(EnsembleStatistics, QuantilesOfGapsConstantsAndTinyWidthsAreWithinTheResolution) {
  std::vector<double> twoHeaps;
  for (int i = 0; i < 1000; ++i) twoHeaps.push_back(i % 2 == 0 ? 1 + 1e-5 * i : 5 - 1e-5 * i);
  expectWithinResolution(twoHeaps, 0, 6);
  EXPECT_LE(expectWithinResolution(std::vector<double>(100, 0.1), 0.1, 0.1), 1e-16);
  EXPECT_LE(expectWithinResolution(std::vector<double>(100, 0.1), 0, 0), 0.1 + 1e-9);
  std::vector<double> ulps;
  for (int i = 0; i < 1000; ++i) ulps.push_back(1e6 + (i % 7) * 0x1p-33);
  EXPECT_LE(expectWithinResolution(ulps, 1e6, 1e6 + 6 * 0x1p-33), 1e-9);
  expectWithinResolution({-1e308, 0, 1e308}, -1e308, 1e308);
  expectWithinResolution({5e-324, 0, 1e-323}, 0, 1e-323);
}

TEST(EnsembleStatistics, MomentsAreThoseOfTwoPassesFarFromZeroToo) {
  for (double mean : {0.0, 1e6}) {
    const std::vector<double> values = normal(100000, mean, 1e-3);
    long double sum = 0, squares = 0;
    for (const double value : values) sum += value;
    const long double exact = sum / 100000;
    for (const double value : values) squares += (value - exact) * (value - exact);
    const Statistics found = gathered(values, mean - 1, mean + 1).statistics(1, Dependence::none, probabilities);
    EXPECT_NEAR(found.mean(0, 0), static_cast<double>(exact), 1e-16 + mean * 2e-16);
    EXPECT_NEAR(found.deviation(0, 0), std::sqrt(static_cast<double>(squares) / 99999), 1e-3 * 1e-12 + mean * 1e-18);
  }
}

TEST(EnsembleStatistics, DoNotDependOnTheSizeOfTheBlocks) {
  const std::vector<double> values = normal(5000, 3, 0.1);
  const Statistics one = gathered(values, 2, 4, 5000).statistics(1, Dependence::none),
                   many = gathered(values, 2, 4, 128).statistics(1, Dependence::none);
  EXPECT_EQ(one.mean.data, many.mean.data);
  EXPECT_EQ(one.deviation.data, many.deviation.data);
  for (std::size_t q = 0; q < 5; ++q) EXPECT_EQ(one.quantiles[q].data, many.quantiles[q].data);
}

TEST(EnsembleStatistics, ValuesThatAreMissingDoNotCount) {
  std::vector<double> values = normal(1000, 3, 0.1), present;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % 3 == 0) values[i] = std::numeric_limits<double>::quiet_NaN();
    if (i % 3 == 1) present.push_back(values[i]);
    if (i % 3 == 2) values[i] = std::numeric_limits<double>::infinity();
  }
  const Statistics found = gathered(values, 2, 4).statistics(1, Dependence::none),
                   alone = gathered(present, 2, 4).statistics(1, Dependence::none);
  EXPECT_THAT(found.mean(0, 0), DoubleNear(alone.mean(0, 0), 1e-15));
  EXPECT_EQ(found.quantiles[2].data, alone.quantiles[2].data);
}

TEST(EnsembleStatistics, ASingleSampleHasNoDeviation) {
  const Statistics found = gathered({2.5}, 2, 4).statistics(1, Dependence::none);
  EXPECT_EQ(found.mean(0, 0), 2.5);
  EXPECT_TRUE(std::isnan(found.deviation(0, 0)));
}

TEST(EnsembleStatistics, HaveFewerBinsTheMoreHistogramsThereAre) {
  EXPECT_EQ(EnsembleStatistics::binsFor(2107), 4096u);
  EXPECT_EQ(EnsembleStatistics::binsFor(1u << 15), 1024u);
  EXPECT_EQ(EnsembleStatistics::binsFor(1u << 22), 64u);
}

TEST(EnsembleStatistics, KeepTheSharesOfSomeTimesAlone) {
  Envelope expected(3, 2);
  for (std::size_t i = 0; i < 6; ++i) expected.lower.data[i] = 0, expected.upper.data[i] = 1.0 + static_cast<double>(i);
  EnsembleStatistics statistics(expected, 2);
  SampleBlock block(0, 100, true, 0, 3, 2);
  for (std::size_t i = 0; i < 100; ++i)
    for (std::size_t t = 0; t < 3; ++t)
      for (std::size_t o = 0; o < 2; ++o) block(i, t, o) = 0.01 * static_cast<double>((i + 1) * (1 + 2 * t + o));
  statistics.include(block, 1);
  const EnsembleStatistics all = statistics;
  statistics.keepShares({0, 2});
  for (const std::size_t time : {0u, 2u})
    for (const std::size_t output : {0u, 1u}) {
      EXPECT_EQ(statistics.shares(time, output).value, all.shares(time, output).value);
      EXPECT_EQ(statistics.shares(time, output).below, all.shares(time, output).below);
      EXPECT_GT(statistics.shares(time, output).value.size(), 1000u);
    }
  EXPECT_TRUE(statistics.shares(1, 0).value.empty());
}

TEST(EnsembleStatistics, RefuseProbabilitiesThatDoNotRise) {
  const EnsembleStatistics statistics = gathered({2.5}, 2, 4);
  EXPECT_THROW(statistics.statistics(1, Dependence::none, {0.5, 0.1}), std::invalid_argument);
  EXPECT_THROW(statistics.statistics(1, Dependence::none, {0.5, 1.1}), std::invalid_argument);
}

/// How many of 400 repetitions hold the truth in their interval.
struct Hits {
  int mean = 0, deviation = 0, quantile = 0;
};

Hits hits(Plan plan, Dependence dependence) {
  const double meanOfAll = 1.0 / 3, deviationOfAll = std::sqrt(4.0 / 45), probability = 0.9;  // of u²
  Hits found;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Sampling sampling(plan, 2, 512, seed);
    std::vector<double> values(512);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::pow(sampling.unitPoint(i)[0], 2);
    const Statistics s = gathered(values, 0, 1, 256).statistics(1, dependence, {probability});
    found.mean += std::abs(s.mean(0, 0) - meanOfAll) <= s.meanError(0, 0);
    found.deviation += std::abs(s.deviation(0, 0) - deviationOfAll) <= s.deviationError(0, 0);
    const double quantile = probability * probability;
    found.quantile += s.lower[0](0, 0) <= quantile && quantile <= s.upper[0](0, 0);
  }
  return found;
}

/// 95 % of 400 are 380, with a standard deviation of 4.4.
TEST(EnsembleStatistics, IntervalsHoldTheTruthInNinetyFiveOfAHundredCases) {
  const Hits random = hits(Plan::random, Dependence::none), sobol = hits(Plan::sobol, Dependence::batches),
             latin = hits(Plan::latinHypercube, Dependence::batches);
  for (const Hits& found : {random, sobol, latin}) {
    EXPECT_THAT(found.mean, ::testing::AllOf(::testing::Ge(360), ::testing::Le(398)));
    EXPECT_THAT(found.deviation, ::testing::AllOf(::testing::Ge(356), ::testing::Le(398)));
    EXPECT_GE(found.quantile, 364);  // conservative: by whole ranks, and by the wider of two parts
  }
  EXPECT_LE(random.quantile, 396);
}

/// Strata end where shares are counted, and batches agree there.
TEST(EnsembleStatistics, QuantilesOfTheQuantityItselfAreHeldToo) {
  for (const Plan plan : {Plan::latinHypercube, Plan::sobol, Plan::halton}) {
    int held = 0, deviations = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      Sampling sampling(plan, 1, 1024, seed);
      std::vector<double> values(1024);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = sampling.unitPoint(i)[0];
      const Statistics s = gathered(values, 0, 1, 256).statistics(1, Dependence::batches, {0.01, 0.33, 0.5});
      for (std::size_t q = 0; q < 3; ++q)
        held += s.lower[q](0, 0) <= s.probabilities[q] && s.probabilities[q] <= s.upper[q](0, 0);
      deviations += std::abs(s.deviation(0, 0) - std::sqrt(1.0 / 12)) <= s.deviationError(0, 0);
    }
    EXPECT_GE(held, 3 * 184) << nameOf(plan);
    EXPECT_GE(deviations, 178) << nameOf(plan);
  }
}

TEST(EnsembleStatistics, IntervalsOfSequencesAreNarrowerAndThoseOfAGridAreNot) {
  const auto errorOf = [](Plan plan, Dependence dependence) {
    Sampling sampling(plan, 2, 1024, 1);
    std::vector<double> values(1024);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = sampling.unitPoint(i)[0];
    return gathered(values, 0, 1).statistics(1, dependence).meanError(0, 0);
  };
  EXPECT_LT(errorOf(Plan::sobol, Dependence::batches), 0.2 * errorOf(Plan::random, Dependence::none));
  EXPECT_TRUE(std::isnan(errorOf(Plan::grid, Dependence::all)));
}

TEST(EnsembleStatistics, FewSamplesSayNothingOfTheirErrors) {
  const Statistics found = gathered(normal(31, 3, 0.1), 2, 4).statistics(1, Dependence::none, {0.5, 0.99});
  EXPECT_TRUE(std::isnan(found.meanError(0, 0)));
  EXPECT_LT(found.lower[0](0, 0), found.upper[0](0, 0));
  EXPECT_TRUE(std::isnan(found.upper[1](0, 0)));  // 31 samples are too few for one to be above it so surely
}

TEST(EnsembleStatistics, KnowWhatTheFirstSamplesSaid) {
  const std::vector<double> values = normal(1000, 3, 0.1);
  const EnsembleStatistics statistics = gathered(values, 2, 4, 256);
  ASSERT_EQ(statistics.convergence().size(), 4u);
  for (const Convergence& first : statistics.convergence()) {
    const auto [least, greatest] =
        std::minmax_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(first.samples));
    EXPECT_EQ(first.width(0, 0), *greatest - *least);
    EXPECT_NEAR(first.meanError(0, 0), 2.13 * 0.1 / std::sqrt(static_cast<double>(first.samples)), 0.02);
  }
  EXPECT_EQ(statistics.convergence().back().samples, 512u);
}

TEST(OrderStatistics, AreThoseOfTheTables) {
  const auto median = ranksAround(0.5, 10, 0.95);  // David and Nagaraja: 97.9 %
  ASSERT_TRUE(median);
  EXPECT_EQ(median->lower, 2u);
  EXPECT_EQ(median->upper, 9u);
  EXPECT_FALSE(ranksAround(0.5, 5, 0.95));
  EXPECT_TRUE(ranksAround(0.5, 6, 0.95));
  EXPECT_GE(coveredShare(93, 0.95), 0.95);  // Wilks: 93 samples for 95 % of all with 95 %
  EXPECT_LT(coveredShare(92, 0.95), 0.95);
  EXPECT_GE(coveredShare(473, 0.95), 0.99);
  EXPECT_LT(coveredShare(472, 0.95), 0.99);
  EXPECT_LT(coveredShare(1, 0.95), 1e-9);
}

}  // namespace
}  // namespace gamut
