// Counts in two bytes or four: what is counted must not depend on it.
#include "analyses/samples/counts.hpp"

#include <gtest/gtest.h>

namespace gamut {
namespace {

TEST(Counts, HoldWhatTheyMayBecome) {
  for (const std::size_t most : {65535U, 65536U}) {
    Counts counts(3, most);
    for (std::size_t i = 0; i < most; ++i) counts.increment(1);
    counts.increment(2);
    EXPECT_EQ(counts[0], 0U);
    EXPECT_EQ(counts[1], most);
    EXPECT_EQ(counts[2], 1U);
  }
  EXPECT_EQ(Counts::bytesOf(65535), 2U);
  EXPECT_EQ(Counts::bytesOf(65536), 4U);
}

TEST(Counts, AreTakenOverInPieces) {
  for (const std::size_t most : {10U, 100000U}) {
    Counts from(5, most), to;
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t k = 0; k < i; ++k) from.increment(i);
    to.append(from, 3, 2);
    to.append(from, 1, 1);
    EXPECT_EQ(to[0], 3U);
    EXPECT_EQ(to[1], 4U);
    EXPECT_EQ(to[2], 1U);
    to.increment(2);
    EXPECT_EQ(to[2], 2U);
  }
}

}  // namespace
}  // namespace gamut
