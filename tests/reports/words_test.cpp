// Printed bounds hold what they print, and no text is taken for markup.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "reports/words.hpp"
#include "scalars/interval.hpp"

namespace gamut {
namespace {

using Ends = std::pair<std::string, std::string>;

Interval decimal(const std::string& text) {
  return Interval::parse(text.starts_with("about ") ? text.substr(6) : text);
}

/// By how much a bound may lie beyond the decimal that it is told to be about.
double allowed(const std::string& text, double width, double size) {
  if (!text.starts_with("about ")) return 0;
  if (text == "about 0") return std::max(1e-9 * size, 1e-24);
  return std::max(1e-9 * std::max(width, 1e-9 * size), 4e-15 * size);
}

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

TEST(Numbers, AreWrittenInFullUpToTenMillion) {
  EXPECT_EQ(numberText(19632, 3), "19600");
  EXPECT_EQ(numberText(-2e6, 1), "-2000000");
  EXPECT_EQ(numberText(1.96e7, 3), "1.96e+07");
  EXPECT_EQ(numberText(0.000196, 2), "0.0002");
  EXPECT_EQ(outwardText(19632, 19633, 3), Ends("19600", "19700"));
  EXPECT_EQ(atMostText(123456, 2), "130000");
}

TEST(Numbers, OfHardlyAnythingHaveNoDigits) {
  EXPECT_EQ(tellingText(3.8e-87, 2), "less than 1e-08");
  EXPECT_EQ(tellingText(0.0123, 2), "0.0123");
  EXPECT_EQ(atMostText(3.8e-87, 2, 2.0), "1e-08");
  EXPECT_EQ(outwardBounds(-3.8e-87, 1e-90), Ends("-1e-24", "1e-24"));
  EXPECT_EQ(outwardBounds(-3.8e-12, 0, 0.9), Ends("-1e-09", "0"));
  EXPECT_EQ(boundsText(-3.8e-87, 1e-90), Ends("about 0", "about 0"));
  EXPECT_EQ(boundsText(-3.8e-12, 0, 0.9), Ends("about 0", "0"));
}

TEST(PrintedBounds, HaveTheDigitsThatTheirWidthJustifies) {
  EXPECT_EQ(boundsText(-114.3812, 51.4621), Ends("-114.4", "51.5"));
  EXPECT_EQ(boundsText(19999.75, 20000.25), Ends("19999.7500", "20000.2500"));
  EXPECT_EQ(boundsText(0, 0), Ends("0", "0"));
  EXPECT_EQ(boundsText(-1e-19, 20.125), Ends("about 0", "20.13"));
  EXPECT_EQ(boundsText(-20.125, 1e-19), Ends("-20.13", "about 0"));
  EXPECT_EQ(boundsText(2e8, 2.5e8), Ends("2e+08", "2.5e+08"));
  EXPECT_EQ(boundsText(1, std::numeric_limits<double>::infinity()), Ends("1", "inf"));
  for (const double size : {1e-30, 1e-6, 1.0, 3e5, 1e12})
    for (double low = -2; low < 2; low += 0.37)
      for (const double width : {0.0, 1e-15, 1e-9, 0.1, 5.0}) {
        const double least = size * low, greatest = size * (low + width),
                     all = std::max({std::abs(least), std::abs(greatest), size});
        for (const auto& [lower, upper] : {outwardBounds(least, greatest, size), boundsText(least, greatest, size)}) {
          EXPECT_LE(decimal(lower).upper() - allowed(lower, greatest - least, all), least) << lower;
          EXPECT_GE(decimal(upper).lower() + allowed(upper, greatest - least, all), greatest) << upper;
        }
      }
}

/// An end that is a decimal but for roundings is told as about that, and not as one that is a digit farther out.
TEST(PrintedBounds, AreNotPushedOutByRoundings) {
  EXPECT_EQ(boundsText(0.8692, 1.5416), Ends("about 0.8692", "about 1.5416"));
  EXPECT_EQ(boundsText(0.8692 - 3e-16, 1.5416 + 1e-11), Ends("about 0.8692", "about 1.5416"));
  EXPECT_EQ(boundsText(0.8692 - 1e-8, 1.5416 + 1e-8), Ends("0.8691", "1.5417"));
  EXPECT_EQ(boundsText(86.92 - 1e-14, 154.16), Ends("about 86.92", "154.16"));
  EXPECT_EQ(boundsText(2e-5 - 1e-20, 5e-5 + 1e-20), Ends("about 2e-05", "about 5e-05"));
  EXPECT_EQ(boundsText(0.3, 0.3), Ends("about 0.3", "0.3000000000000"));
  EXPECT_EQ(outwardBounds(0.8692, 1.5416), Ends("0.8691", "1.5417"));
  EXPECT_EQ(peaksText(1.0000000123456, 1.0000000234567), Ends("1.00000001234", "1.00000002346"))
      << "no decimal is near";
}

/// Each of the two has four digits of its own, and what roundings put beyond a decimal is told as about that.
TEST(Peaks, HaveDigitsOfTheirOwn) {
  EXPECT_EQ(peaksText(-0.95861, 104.3712), Ends("-0.9587", "104.4"));
  EXPECT_EQ(peaksText(-10.4341, 1.19172), Ends("-10.44", "1.192"));
  EXPECT_EQ(peaksText(0.70340264, 0.70535391), Ends("0.703402", "0.705354"));
  EXPECT_EQ(peaksText(-0.2 - 1e-12, 0.2 + 1e-11), Ends("about -0.2", "about 0.2"));
  EXPECT_EQ(peaksText(-0.2 - 1e-9, 0.2), Ends("-0.2001", "about 0.2"));  // the double is above 0.2
  EXPECT_EQ(peaksText(-2.5, 0.5), Ends("-2.500", "0.5000"));
  EXPECT_EQ(peaksText(-1e-12, 0.05 + 1e-12), Ends("about 0", "about 0.05"));
  EXPECT_EQ(peaksText(1e-12, 0.0512345), Ends("0", "0.05124"));
  EXPECT_EQ(peaksText(0, 0), Ends("0", "0"));
  EXPECT_EQ(peaksText(-1e-7, 20.125), Ends("-0.00001", "20.13"));
  EXPECT_EQ(peaksText(2e8, 2.5e8), Ends("2e+08", "2.5e+08"));
  EXPECT_EQ(peaksText(1, std::numeric_limits<double>::infinity()), Ends("1", "inf"));
  EXPECT_EQ(peaksText(std::nan(""), 1), Ends("none", "none"));
  for (const double size : {1e-30, 1e-6, 1.0, 3e5, 1e12})
    for (double low = -2; low < 2; low += 0.37)
      for (const double width : {0.0, 1e-15, 1e-9, 0.1, 5.0}) {
        const double least = size * low, greatest = size * (low + width);
        const auto [lower, upper] = peaksText(least, greatest);
        const double all = std::max(std::abs(least), std::abs(greatest));
        EXPECT_LE(decimal(lower).upper() - allowed(lower, greatest - least, all), least) << lower;
        EXPECT_GE(decimal(upper).lower() + allowed(upper, greatest - least, all), greatest) << upper;
      }
}

TEST(TimesAsWide, HaveNoDigitsOfRounding) {
  EXPECT_EQ(timesText(1), "1");
  EXPECT_EQ(timesText(1 + 4e-16), "1");
  EXPECT_EQ(timesText(1 + 2e-14), "1");
  EXPECT_EQ(timesText(1 - 2e-14), "1");
  EXPECT_EQ(timesText(1 + 2e-9), "1.0001");
  EXPECT_EQ(timesText(1.00012), "1.0002");
  EXPECT_EQ(timesText(1.0121), "1.013");
  EXPECT_EQ(timesText(1234.1), "1235");
  EXPECT_EQ(timesText(std::numeric_limits<double>::infinity()), "inf");
}

TEST(WithError, HasTheDigitsThatTheErrorLeaves) {
  EXPECT_EQ(withErrorText(-55.61637, 0.0017), "-55.6164 ± 0.0017");
  EXPECT_EQ(withErrorText(0.000105669, 9e-8), "0.000105669 ± 9e-08");
  EXPECT_EQ(withErrorText(9.9, 0.1), "9.90 ± 0.10");
  EXPECT_EQ(withErrorText(0.0003123, 0.0017), "0.0003 ± 0.0017");
  EXPECT_EQ(withErrorText(1e-9, 1), "0.0 ± 1.0");
  EXPECT_EQ(withErrorText(0, 0.5), "0.00 ± 0.50");
  EXPECT_EQ(withErrorText(2.5, 0), "2.5 ± 0");
  EXPECT_EQ(withErrorText(0.313, 0.0042), "0.3130 ± 0.0042");
  EXPECT_EQ(withErrorText(0.7043363, 2.5e-6), "0.7043363 ± 0.0000025");
  EXPECT_EQ(withErrorText(3206.552, 41), "3207 ± 41");
  EXPECT_EQ(withErrorText(3206.552, 410), "3210 ± 410");
}

TEST(ReachedTime, IsNeverLaterThanTheNumber) {
  EXPECT_EQ(reachedText(0.3), "0.3 s");
  EXPECT_EQ(reachedText(2.2783999), "2.27839 s");
  EXPECT_EQ(reachedText(2.2784001), "2.2784 s");
  EXPECT_EQ(reachedText(0), "0 s");
}

TEST(AtMost, IsNeverLessThanTheNumber) {
  EXPECT_EQ(atMostText(1.00401, 4), "1.005");
  EXPECT_EQ(atMostText(1.5, 4), "1.5");
}

TEST(Range, IsWrittenAsAStudyStatesIt) {
  EXPECT_EQ(rangeText(0.795, 0.805, 6), "[0.795, 0.805]");
  EXPECT_EQ(rangeText(19600, 20400, 6), "[19600, 20400]");
  EXPECT_EQ(rangeText(-2e6, 2.1e6, 6), "[-2000000, 2100000]");
  EXPECT_EQ(rangeText(2e8, 2.1e8, 6), "[2e+08, 2.1e+08]");
}

TEST(Units, StandBehindNumbersAndNamesThatHaveOne) {
  EXPECT_EQ(inUnit("0.29", "mm"), "0.29 mm");
  EXPECT_EQ(headingOf("angle", "rad"), "angle (rad)");
  for (const char* none : {"", "1"}) {
    EXPECT_EQ(inUnit("0.29", none), "0.29");
    EXPECT_EQ(headingOf("angle", none), "angle");
  }
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
