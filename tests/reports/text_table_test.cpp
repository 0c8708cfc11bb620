// Columns stand below each other, whatever alphabet is in them.
#include "reports/text_table.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

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

TEST(Wrapped, BreaksAtBlanksAndIndentsWhatFollows) {
  using Rows = std::vector<std::string>;
  EXPECT_EQ(wrapped("one two three", 2, 0), Rows{"  one two three"});
  EXPECT_EQ(wrapped("one two three", 2, 15), Rows{"  one two three"});
  EXPECT_EQ(wrapped("one two three", 2, 14), (Rows{"  one two", "    three"}));
  EXPECT_EQ(wrapped("a  b c", 0, 4), (Rows{"a  b", "  c"}));
  EXPECT_EQ(wrapped("äöü äöü", 0, 7), Rows{"äöü äöü"});  // letters, not bytes
}

TEST(Wrapped, LeavesLongWordsWhole) {
  using Rows = std::vector<std::string>;
  EXPECT_EQ(wrapped("incomprehensibilities are", 0, 5), (Rows{"incomprehensibilities", "  are"}));
  EXPECT_EQ(wrapped("incomprehensibilities", 8, 5), Rows{"        incomprehensibilities"});
  EXPECT_EQ(wrapped("", 2, 5), Rows{"  "});
}

}  // namespace
}  // namespace gamut
