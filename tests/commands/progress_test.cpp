#include "commands/progress.hpp"

#include <gtest/gtest.h>

namespace gamut {
namespace {

TEST(ProgressLine, TellsTheTimeLeftOnceItCanBeKnown) {
  EXPECT_EQ(progressLine("samples", 0, 5), "samples      [                              ]   0 %");
  EXPECT_EQ(progressLine("samples", 0.5, 30), "samples      [###############               ]  50 %, 30 s left");
  EXPECT_EQ(progressLine("enclosure", 0.25, 60), "enclosure    [#######                       ]  25 %, 3 min 0 s left");
}

}  // namespace
}  // namespace gamut
