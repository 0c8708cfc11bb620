// Every verdict has its exit code.
#include "commands/exit_codes.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace gamut {
namespace {

Verdict verdictOf(const std::string& word) {
  Verdict verdict;
  verdict.word = word;
  return verdict;
}

TEST(ExitCode, IsZeroOnlyWhereEverySampleLiesInside) {
  EXPECT_EQ(exitCode(verdictOf("inside")), 0);
  EXPECT_EQ(exitCode(verdictOf("outside")), 1);
  EXPECT_EQ(exitCode(verdictOf("unresolved")), 1);
  EXPECT_EQ(exitCode(verdictOf("incomplete")), 3);
}

TEST(ExitCode, IsNoneForAnUnknownWord) { EXPECT_THROW(exitCode(verdictOf("fine")), std::invalid_argument); }

}  // namespace
}  // namespace gamut
