// Intervals as text: what is read is the tightest interval around the exact value of the text, judged by rational
// arithmetic (Boost's), and what is written holds the interval.
#include <mpfr.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <clocale>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "tests/scalars/reference.hpp"

namespace gamut::interval_text_test {
namespace {

using namespace gamut::testing;
using boost::multiprecision::number, boost::multiprecision::et_off;
using Rational = number<boost::multiprecision::cpp_rational_backend, et_off>;
using Integer = number<boost::multiprecision::cpp_int_backend<>, et_off>;

/// The exact value of a finite double: m 2^e.
Rational exactly(double x) {
  int exponent = 0;
  const auto m = static_cast<long long>(std::ldexp(std::frexp(x, &exponent), 53));
  exponent -= 53;
  const Integer scale = Integer(1) << std::abs(exponent);
  return exponent < 0 ? Rational(Integer(m), scale) : Rational(Integer(m) * scale);
}

/// bound is the greatest double <= value, or the least >= value, infinities included.
bool isTightBelow(double bound, const Rational& value) {
  if (bound == -infinity) return value < exactly(-largest);
  return exactly(bound) <= value && (bound == largest || exactly(nextUp(bound)) > value);
}
bool isTightAbove(double bound, const Rational& value) { return isTightBelow(-bound, -value); }

MATCHER_P2(IsTightestFrom, lower, upper, "is the tightest interval from " + lower.str() + " to " + upper.str()) {
  return isTightBelow(arg.lower(), lower) && isTightAbove(arg.upper(), upper);
}

Rational powerOf(int base, int exponent) {
  const Integer power = pow(Integer(base), static_cast<unsigned>(std::abs(exponent)));
  return exponent < 0 ? Rational(Integer(1), power) : Rational(power);
}

/// A random number as text, and its value.
struct Written {
  std::string text;
  Rational value;
};

std::string randomDigits(RandomDoubles& random, int count) {
  std::string digits(1, static_cast<char>('0' + random.integer(1, 9)));
  for (int i = 1; i < count; ++i) digits += static_cast<char>('0' + random.integer(0, 9));
  return digits;
}

Written decimal(RandomDoubles& random, int greatestExponent) {
  const std::string digits = randomDigits(random, random.integer(1, 25));
  const int point = random.integer(0, static_cast<int>(digits.size()));
  const int exponent = random.integer(-greatestExponent, greatestExponent);
  const bool negative = random.integer(0, 1) == 0;
  const auto at = static_cast<std::size_t>(point);
  std::string text = (negative ? "-" : "") + digits.substr(0, at) + "." + digits.substr(at);
  if (exponent != 0 || random.integer(0, 1) == 0) text += "e" + std::to_string(exponent);
  const Rational size = Rational(Integer(digits)) * powerOf(10, exponent + point - static_cast<int>(digits.size()));
  return {text, negative ? Rational(-size) : size};
}

Written fraction(RandomDoubles& random) {
  const std::string p = randomDigits(random, random.integer(1, 20)), q = randomDigits(random, random.integer(1, 20));
  return {p + "/" + q, Rational(Integer(p), Integer(q))};
}

// ---- Reading --------------------------------------------------------------------------------------------------------

TEST(IntervalText, ADecimalIsReadAsTheTightestIntervalAroundIt) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Written x = decimal(random, i % 2 == 0 ? 20 : 340);
    ASSERT_THAT(Interval(x.text), IsTightestFrom(x.value, x.value)) << x.text;
  }
}

TEST(IntervalText, AFractionIsReadAsTheTightestIntervalAroundIt) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Written x = fraction(random);
    ASSERT_THAT(Interval(x.text), IsTightestFrom(x.value, x.value)) << x.text;
    ASSERT_THAT(Interval("-" + x.text), IsTightestFrom(Rational(-x.value), Rational(-x.value))) << x.text;
  }
}

TEST(IntervalText, AHexadecimalNumberIsReadAsTheTightestIntervalAroundIt) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    std::string digits;
    for (int n = random.integer(1, 20); n > 0; --n) digits += "0123456789abcdefABCDEF"[random.integer(0, 21)];
    const int exponent = random.integer(-1100, 1050);
    const std::string text = "0x" + digits.substr(0, 1) + "." + digits.substr(1) + "p" + std::to_string(exponent);
    std::string small = digits;
    std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
    const Rational value =
        Rational(Integer("0x" + small)) * powerOf(2, exponent - 4 * (static_cast<int>(digits.size()) - 1));
    ASSERT_THAT(Interval(text), IsTightestFrom(value, value)) << text;
  }
}

TEST(IntervalText, EndpointsAreReadOutward) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    Written a = decimal(random, 25), b = random.integer(0, 1) == 0 ? decimal(random, 25) : fraction(random);
    if (b.value < a.value) std::swap(a, b);
    ASSERT_THAT(Interval("[" + a.text + ", " + b.text + "]"), IsTightestFrom(a.value, b.value)) << a.text << b.text;
    ASSERT_THAT(Interval("[" + a.text + ",]"), IsTightestFrom(a.value, exactly(largest) + 1)) << a.text;
    ASSERT_THAT(Interval("[" + b.text + "]"), IsTightestFrom(b.value, b.value)) << b.text;
  }
}

TEST(IntervalText, MidpointAndRadiusAreReadExactly) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Written m = decimal(random, 12);
    Written r = decimal(random, 12);
    if (r.value < 0) r = {r.text.substr(1), -r.value};
    const char* const sign = i % 3 == 0 ? " ± " : i % 3 == 1 ? "+-" : " +/- ";
    ASSERT_THAT(Interval(m.text + sign + r.text), IsTightestFrom(m.value - r.value, m.value + r.value)) << m.text;
  }
}

TEST(IntervalText, TheUncertainFormIsPlusOrMinusUnitsOfTheLastPlace) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const std::string digits = randomDigits(random, random.integer(1, 22));
    const auto at = static_cast<std::size_t>(random.integer(0, static_cast<int>(digits.size())));
    const int places = static_cast<int>(digits.size() - at), exponent = random.integer(-300, 300);
    const bool negative = random.integer(0, 1) == 0, half = random.integer(0, 1) == 0;
    const std::string radius = half ? "" : randomDigits(random, random.integer(1, 24));
    const int side = random.integer(0, 2);
    const std::string text = (negative ? "-" : "") + digits.substr(0, at) + "." + digits.substr(at) + "?" + radius +
                             (side == 1   ? "u"
                              : side == 2 ? "d"
                                          : "") +
                             "e" + std::to_string(exponent);
    const Rational unit = powerOf(10, exponent - places);
    const Rational m = (negative ? -1 : 1) * Rational(Integer(digits)) * unit;
    const Rational r = half ? Rational(unit / 2) : Rational(Integer(radius) * unit);
    ASSERT_THAT(Interval(text), IsTightestFrom(side == 1 ? m : Rational(m - r), side == 2 ? m : Rational(m + r)))
        << text;
  }
}

TEST(IntervalText, EveryFormIsRead) {
  const Interval tenth("0.1");
  EXPECT_EQ(tenth.upper(), 0.1);  // the double 0.1 lies above one tenth
  EXPECT_EQ(tenth.lower(), nextDown(0.1));
  EXPECT_THAT(Interval("-1.5e3"), IsInterval(-1500, -1500));
  EXPECT_THAT(Interval("+.5"), IsInterval(0.5, 0.5));
  EXPECT_THAT(Interval("3/2"), IsInterval(1.5, 1.5));
  EXPECT_THAT(Interval("-0X1.8P3"), IsInterval(-12, -12));
  EXPECT_THAT(Interval("[0.1, 0.2]"), IsInterval(nextDown(0.1), 0.2));
  EXPECT_THAT(Interval("[2.]"), IsInterval(2, 2));
  EXPECT_THAT(Interval("[-1/2, 0x1p1]"), IsInterval(-0.5, 2));
  EXPECT_THAT(Interval(" [ -inf , 3 ] "), IsInterval(-infinity, 3));
  EXPECT_THAT(Interval("[1, +Infinity]"), IsInterval(1, infinity));
  EXPECT_THAT(Interval("[1,]"), IsInterval(1, infinity));
  EXPECT_THAT(Interval("[,3]"), IsInterval(-infinity, 3));
  for (const char* text : {"[,]", "[entire]", "[ ENTIRE ]", "[-inf, inf]", "1.5??"})
    EXPECT_TRUE(isEntire(Interval(text))) << text;
  for (const char* text : {"[]", "[ ]", "[empty]", "[ Empty ]"}) EXPECT_THAT(Interval(text), IsEmptyInterval()) << text;
  EXPECT_THAT(Interval("1.5 +- 0.25"), IsInterval(1.25, 1.75));
  EXPECT_THAT(Interval("1.5 ± 1/4"), IsInterval(1.25, 1.75));
  EXPECT_THAT(Interval("3/2±.25"), IsInterval(1.25, 1.75));
  EXPECT_THAT(Interval("15?"), IsInterval(14.5, 15.5));
  EXPECT_THAT(Interval("1.50?25"), IsInterval(1.25, 1.75));
  EXPECT_THAT(Interval("3.56?1e2"), IsInterval(355, 357));
  EXPECT_THAT(Interval("15?2u"), IsInterval(15, 17));
  EXPECT_THAT(Interval("-15?d"), IsInterval(-15.5, -15));
  EXPECT_THAT(Interval("1.5??u"), IsInterval(1.5, infinity));
  EXPECT_THAT(Interval("1.5??de1"), IsInterval(-infinity, 15));
}

TEST(IntervalText, NumbersBeyondAllDoublesAreEnclosedToo) {
  EXPECT_THAT(Interval("1e400"), IsInterval(largest, infinity));
  EXPECT_THAT(Interval("-1e-400"), IsInterval(-smallest, 0));
  EXPECT_THAT(Interval("1e999999999999999999999"), IsInterval(largest, infinity));
  EXPECT_THAT(Interval("-0.0001e-999999999999999999999"), IsInterval(-smallest, 0));
  EXPECT_THAT(Interval("0e999999999999"), IsInterval(0, 0));
  EXPECT_THAT(Interval("0x1p-99999999999"), IsInterval(0, smallest));
  EXPECT_THAT(Interval("1?2e99999999"), IsInterval(-infinity, infinity));
  EXPECT_THAT(Interval("3?2e99999999"), IsInterval(largest, infinity));
  EXPECT_THAT(Interval(std::string(400, '9')), IsInterval(largest, infinity));
  EXPECT_THAT(Interval("0." + std::string(200000, '0') + "1"), IsInterval(0, smallest));
}

TEST(IntervalText, MalformedTextIsRefusedAndNamedTogetherWithWhatIsAccepted) {
  for (const char* text :
       {"",         " ",         "abc",     "1.2.3",   "1e",          "0x10",     "0x1.8", "0xp1",       "nan",
        "inf",      "1 2",       "1/0",     "1/-2",    "1.5/2",       "1/2/3",    "1e5/2", "[1, 2",      "1, 2]",
        "[1; 2]",   "[[1]]",     "--1",     "[1,2,3]", "1e5.5",       "[nan, 1]", "[inf]", "[inf, inf]", "[-inf, -inf]",
        "[inf, 1]", "[1, -inf]", "empty",   "[nai]",   "[empty]_trv", "1 ±",      "± 1",   "1 ± -1",     "1 ± 2 ± 3",
        "1 ± inf",  "?",         "1??2",    "1?2?",    "1?ud",        "1?u2",     "1?e",   "1.5 ?",      "0x1?",
        "1/2?",     "[1?]",      "[1 ± 2]", "135 deg"}) {
    try {
      const Interval x(text);
      ADD_FAILURE() << "'" << text << "' was read as " << x;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("'" + std::string(text) + "'"));
      EXPECT_THAT(error.what(), ::testing::HasSubstr("accepted are 0.1"));
    }
  }
}

TEST(IntervalText, EndpointsInTheWrongOrderAreFoundHoweverCloseTheyAre) {
  EXPECT_THROW(Interval("[2, 1]"), std::invalid_argument);
  EXPECT_THROW(Interval("[1.0000000000000000000000000000002, 1.0000000000000000000000000000001]"),
               std::invalid_argument);
  EXPECT_THAT(Interval("[1.0000000000000000000000000000001, 1.0000000000000000000000000000002]"),
              IsInterval(1, nextUp(1)));
  EXPECT_THAT(Interval("[1/3, 1/3]"), IsTightestFrom(Rational(1, 3), Rational(1, 3)));
}

TEST(IntervalText, EndpointsThatAreBothBeyondTheGreatestExponentAreRefused) {
  EXPECT_THROW(Interval("[1e200001, 1e200000]"), std::invalid_argument);
  EXPECT_THROW(Interval("[2e-200000, 3e-200001]"), std::invalid_argument);
  EXPECT_THAT(Interval("[-1e200000, 1]"), IsInterval(-infinity, 1));
}

TEST(IntervalText, ZeroHasNoSign) {
  EXPECT_EQ(toString(Interval(-0.0)), "[0, 0]");
  EXPECT_FALSE(std::signbit(Interval("-1e-400").upper()));
  EXPECT_FALSE(std::signbit(sin(Interval(-smallest)).upper()));
  EXPECT_FALSE(std::signbit(nextUp(-smallest)));
}

TEST(IntervalText, HugeExponentsOfMidpointAndRadiusAreRefused) {
  EXPECT_THROW(Interval("1e100001 ± 1"), std::invalid_argument);
  EXPECT_THROW(Interval("1 ± 1e-999999999"), std::invalid_argument);
  EXPECT_THAT(Interval("1 ± 1e-9999"), IsInterval(nextDown(1), nextUp(1)));
}

TEST(IntervalText, ReadsAlikeWithinANarrowExponentRangeOfMpfrAndLeavesItAsItWas) {
  const mpfr_exp_t least = mpfr_get_emin(), greatest = mpfr_get_emax();
  mpfr_set_emin(-10);
  mpfr_set_emax(10);
  const Interval read("1e-300"), power = exp(Interval(300));
  const std::string written = toString(Interval(1e300));
  EXPECT_EQ(mpfr_get_emin(), -10);
  EXPECT_EQ(mpfr_get_emax(), 10);
  mpfr_set_emin(least);
  mpfr_set_emax(greatest);
  EXPECT_TRUE(isEqual(read, Interval("1e-300")));
  EXPECT_TRUE(isEqual(power, exp(Interval(300))));
  EXPECT_EQ(written, toString(Interval(1e300)));
}

// ---- Writing --------------------------------------------------------------------------------------------------------

TEST(IntervalText, PrintedTextHoldsTheIntervalAtEveryLength) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = random.anyInterval();
    ASSERT_THAT(x, IsSubsetOf(Interval(toString(x, random.integer(1, 20))))) << x;
    ASSERT_THAT(x, IsSubsetOf(Interval(toFixedString(x, random.integer(0, 20))))) << x;
  }
  std::ostringstream text;
  text << Interval(0.5, 1) << Interval::empty() << Interval::entire() << Interval(0, infinity);
  EXPECT_EQ(text.str(), "[0.5, 1][empty][entire][0, inf]");
  EXPECT_EQ(toString(Interval("0.1"), 3), "[0.0999, 0.101]");
  EXPECT_EQ(toFixedString(Interval(0.251, 0.339), 2), "[0.25, 0.34]");
  EXPECT_THROW(toString(Interval(1), 0), std::invalid_argument);
  EXPECT_THROW(toFixedString(Interval(1), -1), std::invalid_argument);
}

TEST(IntervalText, SeventeenDigitsReadBackLieAtMostOneDoubleFurtherOut) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = random.anyInterval(), back(toString(x));
    ASSERT_TRUE(back.lower() == x.lower() || back.lower() == nextDown(x.lower())) << x;
    ASSERT_TRUE(back.upper() == x.upper() || back.upper() == nextUp(x.upper())) << x;
  }
}

TEST(IntervalText, ExactTextReadBackIsTheInterval) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = random.anyInterval();
    ASSERT_TRUE(isEqual(Interval(toExactString(x)), x)) << x;
  }
  EXPECT_EQ(toExactString(Interval(-1.5, 0.1)), "[-0x1.8p+0, 0x1.999999999999ap-4]");
  EXPECT_EQ(toExactString(Interval(1, infinity)), "[0x1p+0, inf]");
  EXPECT_EQ(toExactString(Interval(-0.0, smallest)), "[0x0p+0, 0x0.0000000000001p-1022]");
  EXPECT_EQ(toExactString(Interval::empty()), "[empty]");
  EXPECT_EQ(toExactString(Interval::entire()), "[entire]");
}

TEST(IntervalText, TheDecimalPointIsAPointInEveryLocale) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  bool found = false;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8"})
    found = found || std::setlocale(LC_NUMERIC, name) != nullptr;
  const std::string text = toString(Interval(0.5, 1.5)), fixed = toFixedString(Interval(0.25), 2);
  const bool read = isEqual(Interval("0.5"), Interval(0.5));
  std::setlocale(LC_NUMERIC, before.c_str());
  if (!found) GTEST_SKIP() << "no locale with a decimal comma is installed";
  EXPECT_EQ(text, "[0.5, 1.5]");
  EXPECT_EQ(fixed, "[0.25, 0.25]");
  EXPECT_TRUE(read);
}

TEST(IntervalText, ADoubleIsPrintedAsTheShortestDecimalThatIsReadBackAsIt) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const double x = random.any();
    ASSERT_EQ(std::strtod(toString(x).c_str(), nullptr), x) << toString(x);
  }
  EXPECT_EQ(toString(0.1), "0.1");
  EXPECT_EQ(toString(1e-9), "1e-09");
}

}  // namespace
}  // namespace gamut::interval_text_test
