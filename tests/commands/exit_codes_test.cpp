// Every verdict has its exit code.
#include "commands/exit_codes.hpp"

#include <gmock/gmock.h>

namespace gamut {
namespace {

int exitOf(Agreement word) {
  Verdict verdict;
  verdict.word = word;
  return exitCode(verdict);
}

TEST(ExitCode, IsZeroOnlyWhereEverySampleLiesInside) {
  EXPECT_EQ(exitOf(Agreement::inside), 0);
  EXPECT_EQ(exitOf(Agreement::outside), 1);
  EXPECT_EQ(exitOf(Agreement::unresolved), 1);
  EXPECT_EQ(exitOf(Agreement::incomplete), 3);
}

}  // namespace
}  // namespace gamut
