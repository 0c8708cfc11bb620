// Printed bounds hold what they print, and no text is taken for markup.
#include <gmock/gmock.h>

#include <limits>
#include <string>

#include "reports/words.hpp"
#include "scalars/interval.hpp"

namespace gamut {
namespace {

using Ends = std::pair<std::string, std::string>;

TEST(PrintedBounds, AreRoundedOutward) {
  EXPECT_EQ(outwardText(1.23456, 1.23451, 4), Ends("none", "none"));
  EXPECT_EQ(outwardText(1.23451, 1.23456, 4), Ends("1.234", "1.235"));
  EXPECT_EQ(outwardText(-1.23456, -1.23451, 4), Ends("-1.235", "-1.234"));
  EXPECT_EQ(outwardText(0.5, 2, 4), Ends("0.5", "2"));
}

TEST(PrintedBounds, HoldTheIntervalForEveryNumberOfDigits) {
  for (int digits = 1; digits <= 17; ++digits) {
    for (double x = -2.0; x < 2.0; x += 0.0371) {
      const auto [lower, upper] = outwardText(x, x, digits);
      EXPECT_LE(Interval::parse(lower).upper(), x) << lower;  // the upper end of the decimal's own enclosure
      EXPECT_GE(Interval::parse(upper).lower(), x) << upper;
    }
  }
}

TEST(PrintedBounds, KeepInfinitiesAndHaveNoNumberForNaN) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(outwardText(-infinity, 1, 4), Ends("-inf", "1"));
  EXPECT_EQ(outwardText(-infinity, infinity, 4), Ends("-inf", "inf"));
  EXPECT_EQ(intervalText(std::numeric_limits<double>::quiet_NaN(), 1, 4), "none");
}

TEST(AtMost, IsNeverLessThanTheNumber) {
  EXPECT_EQ(atMostText(1.00401, 4), "1.005");
  EXPECT_EQ(atMostText(1.5, 4), "1.5");
}

TEST(Digits, ShowANarrowIntervalFarFromZero) {
  EXPECT_EQ(digitsFor(1000, 0.001, 4), 10);
  EXPECT_EQ(digitsFor(1, 1, 4), 4);
  EXPECT_EQ(digitsFor(1, 0, 4), 4);
  EXPECT_EQ(digitsFor(1, 1e-300, 4), 17);
}

TEST(EscapedText, LosesItsMeaningAsMarkup) {
  EXPECT_EQ(escapeHtml("<b a='1' b=\"2\">&</b>"), "&lt;b a=&#39;1&#39; b=&quot;2&quot;&gt;&amp;&lt;/b&gt;");
  EXPECT_EQ(jsonText("</script>\"\\"), "\"\\u003c/script>\\\"\\\\\"");
}

TEST(EscapedText, SurvivesBytesThatAreNotUtf8) {
  EXPECT_EQ(escapeHtml("a\xff"), "a\xef\xbf\xbd");
  EXPECT_EQ(jsonText("a\xff"), "\"a\\ufffd\"");
}

}  // namespace
}  // namespace gamut
