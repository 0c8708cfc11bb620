// Columns stand below each other, whatever alphabet is in them.
#include "reports/text_table.hpp"

#include <gmock/gmock.h>

namespace gamut {
namespace {

TEST(TextTable, AlignsTheFirstColumnLeftAndTheOthersRight) {
  EXPECT_EQ(textTable({{"a", "1", "x"}, {"long", "1234", ""}}),
            "  a        1  x\n"
            "  long  1234\n");
}

TEST(TextTable, AlignsAsManyColumnsLeftAsItIsTold) {
  EXPECT_EQ(textTable({{"a", "1", "x"}, {"long", "1234", "yz"}}, 2),
            "  a     1      x\n"
            "  long  1234  yz\n");
}

TEST(TextTable, CountsLettersNotBytes) { EXPECT_EQ(textTable({{"α²", "1"}, {"ab", "2"}}), "  α²  1\n  ab  2\n"); }

TEST(TextTable, OfNothingIsEmpty) { EXPECT_EQ(textTable({}), ""); }

}  // namespace
}  // namespace gamut
