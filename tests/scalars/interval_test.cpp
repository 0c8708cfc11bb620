// Laws of Interval. Containment is exact: MPFR's value at 200 bits, rounded either way, must lie between the endpoints.
#include "scalars/interval.hpp"

#include <cfenv>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <type_traits>

#include "tests/scalars/reference.hpp"

namespace gamut {
namespace {

using namespace gamut::testing;

/// f(x) lies in enclosure, exactly (or f(x) is undefined).
void expectHolds(const Interval& enclosure, OfOne f, double x) {
  Mpfr argument(x), value(0, 200);
  for (const mpfr_rnd_t direction : {MPFR_RNDD, MPFR_RNDU}) {
    f(value, argument, direction);
    if (mpfr_nan_p(static_cast<mpfr_ptr>(value))) return;
    ASSERT_LE(mpfr_cmp_d(value, enclosure.upper()), 0) << x << " in " << enclosure;
    ASSERT_GE(mpfr_cmp_d(value, enclosure.lower()), 0) << x << " in " << enclosure;
  }
}

// ---- Arithmetic -----------------------------------------------------------------------------------------------------

struct Arithmetic {
  const char* name;
  Interval (*of)(const Interval&, const Interval&);
  OfTwo exact;
};

void PrintTo(const Arithmetic& operation, std::ostream* stream) { *stream << operation.name; }

class IntervalArithmetic : public ::testing::TestWithParam<Arithmetic> {};

TEST_P(IntervalArithmetic, IsTheTightestEnclosureOfTheExactResultsAtTheCorners) {
  const auto& [name, of, exact] = GetParam();
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const bool ordinary = i % 2 == 0;
    const Interval x = ordinary ? random.intervalIn(-8, 8) : random.anyInterval();
    const Interval y = ordinary ? random.intervalIn(-8, 8) : random.anyInterval();
    if (exact == mpfr_div && contains(y, 0)) continue;
    double lower = infinity, upper = -infinity;
    for (const double a : {x.lower(), x.upper()}) {
      for (const double b : {y.lower(), y.upper()}) {
        lower = std::min(lower, rounded(exact, a, b, MPFR_RNDD));
        upper = std::max(upper, rounded(exact, a, b, MPFR_RNDU));
      }
    }
    ASSERT_THAT(of(x, y), IsInterval(lower, upper)) << name << " of " << x << " and " << y;
  }
}

TEST_P(IntervalArithmetic, HoldsTheExactResultOfEveryPairOfElements) {
  const auto& [name, of, exact] = GetParam();
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = random.intervalIn(-3, 3), y = random.intervalIn(-3, 3);
    const double a = random.elementOf(x), b = random.elementOf(y);
    if (exact == mpfr_div && b == 0) continue;
    const Interval result = of(x, y);
    ASSERT_LE(result.lower(), rounded(exact, a, b, MPFR_RNDD)) << name;
    ASSERT_GE(result.upper(), rounded(exact, a, b, MPFR_RNDU)) << name;
  }
}

TEST_P(IntervalArithmetic, IsInclusionIsotone) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = random.anyInterval(), y = random.anyInterval();
    const Interval inX = random.elementOf(x), inY = random.elementOf(y);
    ASSERT_THAT(GetParam().of(inX, inY), IsSubsetOf(GetParam().of(x, y))) << x << y;
  }
}

TEST_P(IntervalArithmetic, OfAnEmptyIntervalIsEmpty) {
  EXPECT_THAT(GetParam().of(Interval::empty(), 1), IsEmptyInterval());
  EXPECT_THAT(GetParam().of(Interval(0, 1), Interval::empty()), IsEmptyInterval());
}

TEST_P(IntervalArithmetic, OfTheWholeLineIsTheWholeLine) {
  EXPECT_TRUE(isEntire(GetParam().of(Interval::entire(), Interval(1, 2))));
}

Interval add(const Interval& x, const Interval& y) { return x + y; }
Interval subtract(const Interval& x, const Interval& y) { return x - y; }
Interval multiply(const Interval& x, const Interval& y) { return x * y; }
Interval divide(const Interval& x, const Interval& y) { return x / y; }

INSTANTIATE_TEST_SUITE_P(Interval, IntervalArithmetic,
                         ::testing::Values(Arithmetic{"sum", add, mpfr_add},
                                           Arithmetic{"difference", subtract, mpfr_sub},
                                           Arithmetic{"product", multiply, mpfr_mul},
                                           Arithmetic{"quotient", divide, mpfr_div}),
                         [](const auto& operation) { return operation.param.name; });

TEST(Interval, DivisionByAnIntervalWithZeroInsideIsTheWholeLine) {
  EXPECT_TRUE(isEntire(Interval(1, 2) / Interval(-1, 1)));
  EXPECT_THAT(Interval(0) / Interval(-1, 1), IsInterval(0, 0));
}

TEST(Interval, DivisionByAnIntervalThatEndsAtZeroIsAHalfLine) {
  EXPECT_THAT(Interval(1, 2) / Interval(0, 4), IsInterval(0.25, infinity));
  EXPECT_THAT(Interval(1, 2) / Interval(-4, 0), IsInterval(-infinity, -0.25));
  EXPECT_TRUE(isEntire(Interval(-1, 2) / Interval(0, 4)));
}

TEST(Interval, DivisionByZeroAloneIsEmpty) { EXPECT_THAT(Interval(1, 2) / Interval(0), IsEmptyInterval()); }

TEST(Interval, ZeroTimesTheWholeLineIsZero) { EXPECT_THAT(Interval(0) * Interval::entire(), IsInterval(0, 0)); }

TEST(Interval, BesideOrdinaryDoubleArithmeticStillContainsTheSum) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const double a = random.uniform(-1, 1), b = random.uniform(-1, 1);
    const double nearest = a + b;  // an optimiser may merge this with the interval's own sum, which must not matter
    const Interval sum = Interval(a) + Interval(b);
    ASSERT_TRUE(contains(sum, nearest));
    ASSERT_EQ(sum.lower(), rounded(mpfr_add, a, b, MPFR_RNDD));
    ASSERT_EQ(sum.upper(), rounded(mpfr_add, a, b, MPFR_RNDU));
  }
}

TEST(Interval, LeavesTheRoundingModeAloneAndGivesTheSameInEveryThread) {
  const Interval here = sin(Interval("0.1")) / Interval("0.3") + sqrt(Interval(2));
  Interval there;
  std::thread([&there] { there = sin(Interval("0.1")) / Interval("0.3") + sqrt(Interval(2)); }).join();
  EXPECT_TRUE(isEqual(here, there));
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

// ---- Functions ------------------------------------------------------------------------------------------------------

struct Function {
  const char* name;
  Interval (*of)(const Interval&);
  OfOne exact;
  double lower, upper;  // where it is tried
};

void PrintTo(const Function& function, std::ostream* stream) { *stream << function.name; }

class IntervalFunction : public ::testing::TestWithParam<Function> {};

TEST_P(IntervalFunction, HoldsTheExactValueAtEveryElement) {
  const auto& [name, of, exact, lower, upper] = GetParam();
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = random.intervalIn(lower, upper);
    expectHolds(of(x), exact, random.elementOf(x));
    if (HasFatalFailure()) return;
  }
}

TEST_P(IntervalFunction, OfADoubleLiesBetweenTheNeighboursOfTheExactValue) {
  const auto& [name, of, exact, lower, upper] = GetParam();
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const double x = i % 2 == 0 ? random.any() : random.uniform(lower, upper);
    const double down = rounded(exact, x, MPFR_RNDD), up = rounded(exact, x, MPFR_RNDU);
    if (std::isnan(down) || std::isinf(x)) continue;
    if (exact == mpfr_log && x == 0) continue;
    ASSERT_THAT(of(x), IsInterval(down, up)) << name << " of " << x;
  }
}

TEST_P(IntervalFunction, IsInclusionIsotone) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = i % 2 == 0 ? random.anyInterval() : random.intervalIn(GetParam().lower, GetParam().upper);
    const double a = random.elementOf(x), b = random.elementOf(x);
    const Interval inner(std::min(a, b), std::max(a, b));
    ASSERT_THAT(GetParam().of(inner), IsSubsetOf(GetParam().of(x)))
        << GetParam().name << " of " << inner << " in " << x;
  }
}

TEST_P(IntervalFunction, OfTheEmptyIntervalIsEmpty) {
  EXPECT_THAT(GetParam().of(Interval::empty()), IsEmptyInterval());
}

TEST_P(IntervalFunction, OfTheWholeLineHoldsEveryValue) {
  const Interval all = GetParam().of(Interval::entire());
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    expectHolds(all, GetParam().exact, random.any());
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Interval, IntervalFunction,
    ::testing::Values(Function{"sqr", sqr, mpfr_sqr, -5, 5}, Function{"sqrt", sqrt, mpfr_sqrt, -1, 9},
                      Function{"abs", abs, [](mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t d) { return mpfr_abs(r, x, d); },
                               -3, 3},
                      Function{"exp", exp, mpfr_exp, -20, 20}, Function{"log", log, mpfr_log, -1, 10},
                      Function{"sin", sin, mpfr_sin, -10, 10}, Function{"cos", cos, mpfr_cos, -10, 10},
                      Function{"tan", tan, mpfr_tan, -3, 3}, Function{"asin", asin, mpfr_asin, -1.5, 1.5},
                      Function{"acos", acos, mpfr_acos, -1.5, 1.5}, Function{"atan", atan, mpfr_atan, -10, 10},
                      Function{"sinh", sinh, mpfr_sinh, -5, 5}, Function{"cosh", cosh, mpfr_cosh, -5, 5},
                      Function{"tanh", tanh, mpfr_tanh, -5, 5}),
    [](const auto& function) { return function.param.name; });

TEST(Interval, SineAndCosineReachTheirExtremaJustWhenAMultipleOfHalfPiLiesInside) {
  Mpfr halfPiExact(0, 1200), multiple(0, 1300);
  mpfr_const_pi(halfPiExact, MPFR_RNDN);
  mpfr_div_2ui(halfPiExact, halfPiExact, 1, MPFR_RNDN);
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const long k = i < 2000 ? i - 1000 : random.integer(-2000000000, 2000000000);
    mpfr_mul_si(multiple, halfPiExact, k, MPFR_RNDN);
    const double below = mpfr_get_d(multiple, MPFR_RNDD), above = mpfr_get_d(multiple, MPFR_RNDU);
    const Interval around(below, above);
    const Interval sine = sin(around), cosine = cos(around);
    const long quarter = k & 3;
    ASSERT_EQ(sine.upper() == 1 && sine.lower() > 0, quarter == 1) << k;
    ASSERT_EQ(sine.lower() == -1 && sine.upper() < 0, quarter == 3) << k;
    ASSERT_EQ(cosine.upper() == 1 && cosine.lower() > 0, quarter == 0) << k;
    ASSERT_EQ(cosine.lower() == -1 && cosine.upper() < 0, quarter == 2) << k;
    ASSERT_EQ(isEntire(tan(around)), (quarter & 1) == 1) << k;
    if (k == 0) continue;
    const double before = below - random.uniform(0, 1), beyond = above + random.uniform(0, 1);
    ASSERT_FALSE(isEntire(tan(Interval(before, below)))) << k;  // the multiple itself is left out
    ASSERT_FALSE(isEntire(tan(Interval(above, beyond)))) << k;
    ASSERT_EQ(sin(Interval(before, beyond)).upper() == 1, quarter == 1) << k;
    ASSERT_EQ(cos(Interval(before, beyond)).lower() == -1, quarter == 2) << k;
  }
}

TEST(Interval, SineOfAHalfTurnOrMoreSeesTheExtremaItPasses) {
  EXPECT_THAT(sin(Interval(0, 2)), IsInterval(0, 1));
  EXPECT_EQ(sin(Interval(0, 4)).upper(), 1);
  EXPECT_GT(sin(Interval(0, 4)).lower(), -1);
  EXPECT_THAT(sin(Interval(0, 5)), IsInterval(-1, 1));
  EXPECT_THAT(cos(Interval(-1, 6)), IsInterval(-1, 1));
  EXPECT_THAT(sin(Interval(0, 7)), IsInterval(-1, 1));
  EXPECT_LT(cos(Interval(0.1, 6.1)).upper(), 1);
  EXPECT_EQ(cos(Interval(0.1, 6.1)).lower(), -1);
}

TEST(Interval, SineOfHugeArgumentsIsTightWhenThinAndTheWholeRangeWhenWide) {
  RandomDoubles random;
  for (int i = 0; i < 1000; ++i) {
    const double x = std::ldexp(random.uniform(-1, 1), random.integer(30, 1023));
    ASSERT_THAT(sin(x), IsInterval(rounded(mpfr_sin, x, MPFR_RNDD), rounded(mpfr_sin, x, MPFR_RNDU))) << x;
    const Interval wide(std::min(x, nextUp(x)), nextUp(nextUp(x)));
    expectHolds(sin(wide), mpfr_sin, x);
    expectHolds(sin(wide), mpfr_sin, wide.upper());
  }
  EXPECT_THAT(sin(Interval(1e300, nextUp(1e300))), IsInterval(-1, 1));
  EXPECT_THAT(cos(Interval(0, infinity)), IsInterval(-1, 1));
}

TEST(Interval, SineAndCosineTogetherAreWhatTheyAreApart) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = i % 2 == 0 ? random.intervalIn(-10, 10) : Interval(random.any());
    const auto [sine, cosine] = sinCos(x);
    ASSERT_TRUE(isEqual(sine, sin(x)) && isEqual(cosine, cos(x))) << x;
  }
}

TEST(Interval, FunctionsAreRestrictedToTheirDomains) {
  EXPECT_THAT(sqrt(Interval(-1, 4)), IsInterval(0, 2));
  EXPECT_THAT(sqrt(Interval(-2, -1)), IsEmptyInterval());
  EXPECT_THAT(log(Interval(-1, 1)), IsInterval(-infinity, 0));
  EXPECT_THAT(log(Interval(-1, 0)), IsEmptyInterval());
  EXPECT_EQ(asin(Interval(0, 3)).lower(), 0);
  EXPECT_THAT(acos(Interval(2, 3)), IsEmptyInterval());
}

TEST(Interval, IntegerPowersHoldTheExactPowerAndAreTight) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = random.intervalIn(-3, 3);
    const int n = random.integer(-9, 9);
    const double a = random.elementOf(x);
    if (a == 0) continue;
    Mpfr base(a), low, high;
    mpfr_pow_si(low, base, n, MPFR_RNDD);
    mpfr_pow_si(high, base, n, MPFR_RNDU);
    ASSERT_THAT(Interval(mpfr_get_d(low, MPFR_RNDD), mpfr_get_d(high, MPFR_RNDU)), IsSubsetOf(pow(x, n))) << x << n;
    ASSERT_THAT(pow(Interval(a), n), IsInterval(mpfr_get_d(low, MPFR_RNDD), mpfr_get_d(high, MPFR_RNDU))) << a << n;
  }
  EXPECT_THAT(pow(Interval(0), 0), IsInterval(1, 1));
  EXPECT_THAT(pow(Interval(-2, 1), 4), IsInterval(0, 16));
  EXPECT_THAT(pow(Interval(-2, 1), 3), IsInterval(-8, 1));
  EXPECT_THAT(pow(Interval(-2, 1), -2), IsInterval(0.25, infinity));
  EXPECT_TRUE(isEntire(pow(Interval(-2, 1), -1)));
  EXPECT_THAT(pow(Interval(0), -1), IsEmptyInterval());
}

TEST(Interval, RealPowersHoldTheExactPower) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = random.intervalIn(0, 4), y = random.intervalIn(-3, 3);
    const double a = random.elementOf(x), b = random.elementOf(y);
    if (a == 0) continue;
    const Interval exact(rounded(mpfr_pow, a, b, MPFR_RNDD), rounded(mpfr_pow, a, b, MPFR_RNDU));
    ASSERT_THAT(exact, IsSubsetOf(pow(x, y))) << x << y;
  }
  EXPECT_THAT(pow(Interval(0, 4), 0.5), IsInterval(0, 2));
  EXPECT_THAT(pow(Interval(-2, -1), Interval(0.5)), IsEmptyInterval());
  EXPECT_THAT(pow(Interval(-0.0, 1), Interval(-1)), IsInterval(1, infinity));
}

TEST(Interval, ConstantsAreTheTightestEnclosures) {
  Mpfr exact(0, 300);
  mpfr_const_pi(exact, MPFR_RNDN);
  EXPECT_THAT(pi(), IsInterval(mpfr_get_d(exact, MPFR_RNDD), mpfr_get_d(exact, MPFR_RNDU)));
  EXPECT_TRUE(isEqual(twoPi(), 2 * pi()) && isEqual(halfPi(), pi() / 2));
}

// ---- Measures and sets ----------------------------------------------------------------------------------------------

TEST(Interval, MidpointAndRadiusCoverTheInterval) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = random.anyInterval();
    const double middle = midpoint(x), reach = radius(x);
    ASSERT_TRUE(contains(x, middle)) << x;
    for (const double end : {x.lower(), x.upper()}) {
      Mpfr distance(end, 2200), m(middle);  // 2200 bits: the difference of any two doubles is exact
      mpfr_sub(distance, distance, m, MPFR_RNDN);
      ASSERT_LE(mpfr_cmpabs(distance, Mpfr(reach)), 0) << x;
    }
    ASSERT_GE(width(x), reach);
  }
}

TEST(Interval, MeasuresOfUnboundedAndEmptyIntervals) {
  EXPECT_EQ(midpoint(Interval::entire()), 0);
  EXPECT_EQ(midpoint(Interval(3, infinity)), largest);
  EXPECT_EQ(midpoint(Interval(-infinity, 3)), -largest);
  EXPECT_EQ(radius(Interval(3, infinity)), infinity);
  EXPECT_EQ(width(Interval::entire()), infinity);
  EXPECT_EQ(midpoint(Interval(-largest, largest)), 0);
  for (const double measure : {midpoint(Interval::empty()), radius(Interval::empty()), width(Interval::empty()),
                               magnitude(Interval::empty()), mignitude(Interval::empty())}) {
    EXPECT_TRUE(std::isnan(measure));
  }
}

TEST(Interval, MagnitudeAndMignitudeAreTheGreatestAndLeastAbsoluteValues) {
  EXPECT_EQ(magnitude(Interval(-3, 2)), 3);
  EXPECT_EQ(mignitude(Interval(-3, 2)), 0);
  EXPECT_EQ(mignitude(Interval(-3, -2)), 2);
  EXPECT_THAT(abs(Interval(-3, 2)), IsInterval(0, 3));
}

TEST(Interval, HullAndIntersectionAreTheLeastAndGreatest) {
  EXPECT_THAT(hull(Interval(0, 1), Interval(3, 4)), IsInterval(0, 4));
  EXPECT_THAT(hull(Interval::empty(), Interval(3, 4)), IsInterval(3, 4));
  EXPECT_THAT(intersection(Interval(0, 3), Interval(1, 4)), IsInterval(1, 3));
  EXPECT_THAT(intersection(Interval(0, 1), Interval(1, 4)), IsInterval(1, 1));
  EXPECT_THAT(intersection(Interval(0, 1), Interval(2, 4)), IsEmptyInterval());
  EXPECT_THAT(min(Interval(0, 3), Interval(1, 2)), IsInterval(0, 2));
  EXPECT_THAT(max(Interval(0, 3), Interval(1, 2)), IsInterval(1, 3));
}

TEST(Interval, PredicatesFollowTheSets) {
  const Interval empty = Interval::empty(), entire = Interval::entire();
  EXPECT_TRUE(isSubset(empty, empty) && isSubset(empty, Interval(1)) && !isSubset(Interval(1), empty));
  EXPECT_TRUE(isSubset(Interval(1, 2), Interval(1, 3)) && !isInterior(Interval(1, 2), Interval(1, 3)));
  EXPECT_TRUE(isInterior(Interval(1, 2), Interval(0, 3)) && isInterior(entire, entire));
  EXPECT_TRUE(isDisjoint(Interval(0, 1), Interval(2, 3)) && !isDisjoint(Interval(0, 1), Interval(1, 3)));
  EXPECT_TRUE(isDisjoint(empty, entire));
  EXPECT_TRUE(isEqual(empty, empty) && !isEqual(empty, entire));
  EXPECT_TRUE(contains(entire, largest) && !contains(entire, infinity) && !contains(empty, 0));
  EXPECT_TRUE(isThin(Interval(2)) && !isThin(empty));
  EXPECT_TRUE(isBounded(Interval(1, 2)) && !isBounded(Interval(1, infinity)) && isBounded(empty));
}

TEST(Interval, WhatIsCertainHoldsForEveryElementAndNeverForNone) {
  EXPECT_TRUE(certainlyLess(Interval(0, 1), Interval(2, 3)));
  EXPECT_FALSE(certainlyLess(Interval(0, 1), Interval(1, 3)));
  EXPECT_TRUE(certainlyLessOrEqual(Interval(0, 1), Interval(1, 3)));
  EXPECT_TRUE(certainlyGreater(Interval(2, 3), Interval(0, 1)));
  EXPECT_TRUE(certainlyPositive(Interval(1, 2)) && !certainlyPositive(Interval(0, 2)));
  EXPECT_TRUE(certainlyNegative(Interval(-2, -1)) && certainlyNonzero(Interval(-2, -1)));
  EXPECT_TRUE(certainlyNonnegative(Interval(0, 2)) && certainlyNonpositive(Interval(-1, 0)));
  EXPECT_FALSE(certainlyLess(Interval::empty(), 1) || certainlyLessOrEqual(1, Interval::empty()));
  EXPECT_FALSE(certainlyPositive(Interval::empty()) || certainlyNonzero(Interval::empty()));
}

template <class T>
concept Ordered = requires(const T& x) {
  x < x;
};
template <class T>
concept Comparable = requires(const T& x) {
  x == x;
};
static_assert(!Ordered<Interval> && !Comparable<Interval>, "a comparison of intervals has no yes-or-no answer");
static_assert(!std::is_convertible_v<const char*, Interval> && std::is_convertible_v<double, Interval>);

// ---- Construction and text ------------------------------------------------------------------------------------------

TEST(Interval, IsNotMadeOfNaNOrOfEndpointsInTheWrongOrder) {
  EXPECT_THROW(Interval(std::nan("")), std::invalid_argument);
  EXPECT_THROW(Interval{infinity}, std::invalid_argument);
  EXPECT_THROW(Interval(0, std::nan("")), std::invalid_argument);
  EXPECT_THROW(Interval(infinity, infinity), std::invalid_argument);
  try {
    Interval(2.5, 1.5);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("2.5"), ::testing::HasSubstr("1.5")));
  }
}

TEST(Interval, ReadsDecimalTextOutward) {
  const Interval tenth("0.1");
  EXPECT_EQ(tenth.upper(), 0.1);  // the double 0.1 lies above one tenth
  EXPECT_EQ(tenth.lower(), nextDown(0.1));
  EXPECT_THAT(Interval("-1.5e3"), IsInterval(-1500, -1500));
  EXPECT_THAT(Interval("[0.1, 0.2]"), IsInterval(nextDown(0.1), 0.2));
  EXPECT_THAT(Interval(" [ -inf , 3 ] "), IsInterval(-infinity, 3));
  EXPECT_THAT(Interval("1e400"), IsInterval(largest, infinity));
  EXPECT_THAT(Interval("-1e-400"), IsInterval(-smallest, 0));
  EXPECT_THAT(Interval("[empty]"), IsEmptyInterval());
  EXPECT_TRUE(isEntire(Interval("[entire]")));
  EXPECT_THAT(Interval(".5"), IsInterval(0.5, 0.5));
  EXPECT_THAT(Interval("[2.]"), IsInterval(2, 2));
}

TEST(Interval, RefusesMalformedTextAndNamesIt) {
  for (const char* text : {"", "abc", "1.2.3", "1e", "0x10", "nan", "inf", "1 2", "[1, 2", "[1; 2]", "[2, 1]", "[[1]]",
                           "[,]", "--1", "[1,2,3]", "1e5.5", "[nan, 1]"}) {
    EXPECT_THROW(Interval{text}, std::invalid_argument) << text;
  }
  try {
    Interval("twelve");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("twelve"));
  }
}

TEST(Interval, ADoubleIsPrintedAsTheShortestDecimalThatIsReadBackAsIt) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const double x = random.any();
    ASSERT_EQ(std::strtod(toString(x).c_str(), nullptr), x) << toString(x);
  }
  EXPECT_EQ(toString(0.1), "0.1");
  EXPECT_EQ(toString(1e-9), "1e-09");
}

TEST(Interval, PrintedTextHoldsTheIntervalAtEveryLength) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = random.anyInterval();
    ASSERT_THAT(x, IsSubsetOf(Interval(toString(x, random.integer(1, 20))))) << x;
  }
  std::ostringstream text;
  text << Interval(0.5, 1) << Interval::empty() << Interval::entire() << Interval(0, infinity);
  EXPECT_EQ(text.str(), "[0.5, 1][empty][entire][0, inf]");
  EXPECT_EQ(toString(Interval("0.1"), 3), "[0.0999, 0.101]");
  EXPECT_THROW(toString(Interval(1), 0), std::invalid_argument);
}

}  // namespace
}  // namespace gamut
