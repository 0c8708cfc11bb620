// What is kept of the samples never takes more than its storage, and is what went by.
#include "studies/running/sample_keeper.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace gamut {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Sample `number` has the values number + 0.25 q and the motion number + 0.5 cell.
SampleBlock blockOf(std::size_t first, std::size_t count, bool hasWeight, std::size_t quantities, std::size_t cells) {
  SampleBlock block(first, count, hasWeight, quantities, cells, 1);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t q = 0; q < quantities; ++q)
      block.values(i)[q] = static_cast<double>(first + i) + 0.25 * static_cast<double>(q);
    for (std::size_t cell = 0; cell < cells; ++cell)
      block(i, cell, 0) = static_cast<double>(first + i) + 0.5 * static_cast<double>(cell);
  }
  return block;
}

void keepOf(SampleKeeper& keeper, SampleBlock block) { keeper.keep(block); }

/// As samples go by: the first block, corners and centre, then the others.
KeptSamples keptOf(std::size_t samples, std::size_t beside, std::size_t quantities, std::size_t cells, double storage) {
  SampleKeeper keeper(samples + beside, quantities, cells, storage);
  const std::size_t first = std::min<std::size_t>(samples, 7);
  keepOf(keeper, blockOf(0, first, true, quantities, cells));
  keepOf(keeper, blockOf(samples, beside, false, quantities, cells));
  if (first < samples) keepOf(keeper, blockOf(first, samples - first, true, quantities, cells));
  return keeper.take();
}

std::size_t bytesOf(const KeptSamples& kept) {
  return 8 * (kept.number.size() + kept.values.size() + kept.motionNumber.size() + kept.motions.size());
}

TEST(SampleKeeper, KeepsAllWhereThereIsRoom) {
  const KeptSamples kept = keptOf(10, 3, 2, 4, 1e6);
  EXPECT_THAT(kept.number, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
  EXPECT_EQ(kept.motionNumber, kept.number);
  EXPECT_EQ(kept.valuesEvery, 1);
  EXPECT_EQ(kept.motionsEvery, 1);
  for (std::size_t i = 0; i < 13; ++i) {
    EXPECT_EQ(kept.values[2 * i + 1], static_cast<double>(i) + 0.25);
    EXPECT_EQ(kept.motions[4 * i + 3], static_cast<double>(i) + 1.5);
  }
}

TEST(SampleKeeper, KeepsEverySoManythAndTheCentreAndMotionsOnlyOfSamplesWhoseValuesItKeeps) {
  const KeptSamples kept = keptOf(100, 6, 1, 50, 3000);  // 1500 bytes of values, 16 each; motions 408 each
  EXPECT_EQ(kept.valuesEvery, 2);
  EXPECT_EQ(kept.number.back(), 105);
  EXPECT_EQ(kept.motionsEvery % kept.valuesEvery, 0);
  EXPECT_GT(kept.motionsEvery, 2);
  EXPECT_EQ(kept.motionNumber.front(), 0);
  EXPECT_EQ(kept.motionNumber.back(), 105);
  EXPECT_TRUE(std::ranges::includes(kept.number, kept.motionNumber));
  for (const std::int64_t number : kept.motionNumber) EXPECT_TRUE(number % kept.motionsEvery == 0 || number == 105);
}

TEST(SampleKeeper, NeverTakesMoreThanItsStorage) {
  for (const std::size_t samples : {1u, 2u, 7u, 8u, 64u, 1000u})
    for (const std::size_t quantities : {0u, 1u, 12u})
      for (const std::size_t cells : {1u, 30u, 2107u})
        for (double storage = 0; storage < 1e6; storage = 3 * storage + 16) {
          const KeptSamples kept = keptOf(samples, 4, quantities, cells, storage);
          ASSERT_LE(static_cast<double>(bytesOf(kept)), storage);
          ASSERT_EQ(kept.values.size(), quantities * kept.number.size());
          ASSERT_EQ(kept.motions.size(), cells * kept.motionNumber.size());
          ASSERT_TRUE(std::ranges::is_sorted(kept.number));
          ASSERT_TRUE(kept.motionNumber.empty() || kept.motionNumber.back() == static_cast<std::int64_t>(samples) + 3);
        }
}

TEST(SampleKeeper, UsesWhatItIsGiven) {
  for (const double storage : {1e4, 1e5, 1e6}) {
    const KeptSamples kept = keptOf(1000, 4, 1, 30, storage);
    const double room = kept.motionsEvery == 1 ? 0 : 0.4 * storage;  // distances are whole numbers
    EXPECT_GT(static_cast<double>(bytesOf(kept)), room) << storage;
    EXPECT_TRUE(kept.motionsEvery > 1 || kept.motionNumber.size() == 1004);
  }
}

TEST(SampleKeeper, KeepsNothingWithoutStorage) {
  const KeptSamples kept = keptOf(10, 3, 2, 4, 0);
  EXPECT_THAT(kept.number, IsEmpty());
  EXPECT_THAT(kept.motionNumber, IsEmpty());
  EXPECT_EQ(kept.valuesEvery, 0);
  EXPECT_EQ(kept.motionsEvery, 0);
}

TEST(SampleKeeper, KeepsOfAnInterruptedRunWhatWentBy) {
  SampleKeeper keeper(103, 1, 1, 1e6);
  keepOf(keeper, blockOf(0, 5, true, 1, 1));
  EXPECT_THAT(keeper.take().number, ElementsAre(0, 1, 2, 3, 4));
}

}  // namespace
}  // namespace gamut
