// Errors of shares by batches, whatever parts they are counted in.
#include "analyses/samples/batch_statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gamut {
namespace {

constexpr std::size_t count = 512;

/// Squares of a quantity that is uniform on [0, 1].
std::vector<double> squares(std::uint64_t seed) {
  Sampling sampling(Plan::sobol, 2, count, seed);
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = std::pow(sampling.unitPoint(i)[0], 2);
  return values;
}

std::vector<double> errorsOf(const std::vector<double>& values, std::size_t samples, std::size_t parts) {
  Envelope expected(1, 1);
  expected.lower.data[0] = 0;
  expected.upper.data[0] = 1;
  BatchStatistics batches(expected, samples, parts);
  batches.include(0, 0, values.data(), values.size());
  EXPECT_EQ(batches.parts(), parts);
  return batches.shareErrors(0);
}

TEST(BatchStatistics, HoldTheTruthWhateverThePartsAre) {
  for (const std::size_t parts : {8u, 19u, 64u}) {
    int held = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const std::vector<double> values = squares(seed), errors = errorsOf(values, count, parts);
      for (const double at : {0.01, 0.4, 0.9}) {
        const double share =
            static_cast<double>(std::ranges::count_if(values, [&](double v) { return v < at; })) / count;
        held += std::abs(share - std::sqrt(at)) <= errors[static_cast<std::size_t>(at * static_cast<double>(parts))];
      }
    }
    EXPECT_GE(held, 3 * 184) << parts;
  }
}

/// Batches of more than 65535 samples are counted in longer numbers.
TEST(BatchStatistics, AreTheSameInShortAndLongCounts) {
  constexpr std::size_t many = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(errorsOf(squares(3), count, 8), errorsOf(squares(3), many, 8));
  EXPECT_EQ(BatchStatistics::cellBytes(many, 8) - BatchStatistics::cellBytes(count, 8), 2.0 * 10 * batchCount);
  std::vector<double> values(batchCount * 80000, 0.25);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i / batchCount % 10 == 0) values[i] = 0.75;
  const double inside = batchCount * 72000, all = batchCount * 80000;  // where batches agree
  EXPECT_NEAR(errorsOf(values, values.size(), 8)[2], 2.1314495459 * 0.5 * std::sqrt(inside) / all, 1e-12);
  EXPECT_EQ(BatchStatistics::cellBytes(65535 * batchCount - 1, 8), BatchStatistics::cellBytes(count, 8));
  EXPECT_GT(BatchStatistics::cellBytes(65535 * batchCount, 8), BatchStatistics::cellBytes(count, 8));
}

TEST(BatchStatistics, HaveFewerPartsTheMoreCellsThereAre) {
  EXPECT_EQ(BatchStatistics::partsFor(1), 64u);
  EXPECT_EQ(BatchStatistics::partsFor(1u << 15), 64u);
  EXPECT_EQ(BatchStatistics::partsFor(1u << 17), 16u);
  EXPECT_EQ(BatchStatistics::partsFor(620310), 8u);
}

}  // namespace
}  // namespace gamut
