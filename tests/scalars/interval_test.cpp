// Laws of Interval: arithmetic, functions, measures, sets, predicates, construction. That functions hold MPFR's value
// and are tight is in interval_containment_test.cpp, text in interval_text_test.cpp.
#include "scalars/interval.hpp"

#include <cfenv>

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <type_traits>

#include "tests/scalars/reference.hpp"

namespace gamut::interval_test {
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
  double lower, upper;  // where it is tried
};

void PrintTo(const Function& function, std::ostream* stream) { *stream << function.name; }

class IntervalFunction : public ::testing::TestWithParam<Function> {};

TEST_P(IntervalFunction, IsInclusionIsotone) {
  const Interval all = GetParam().of(Interval::entire());
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = i % 2 == 0 ? random.anyInterval() : random.intervalIn(GetParam().lower, GetParam().upper);
    const double a = random.elementOf(x), b = random.elementOf(x);
    const Interval inner(std::min(a, b), std::max(a, b)), outer = GetParam().of(x);
    ASSERT_THAT(GetParam().of(inner), IsSubsetOf(outer)) << GetParam().name << " of " << inner << " in " << x;
    ASSERT_THAT(outer, IsSubsetOf(all)) << GetParam().name << " of " << x;
  }
}

TEST_P(IntervalFunction, OfTheEmptyIntervalIsEmpty) {
  EXPECT_THAT(GetParam().of(Interval::empty()), IsEmptyInterval());
}

INSTANTIATE_TEST_SUITE_P(
    Interval, IntervalFunction,
    ::testing::Values(Function{"sqr", sqr, -5, 5}, Function{"sqrt", sqrt, -1, 9}, Function{"cbrt", cbrt, -9, 9},
                      Function{"abs", abs, -3, 3}, Function{"sign", sign, -1, 1}, Function{"floor", floor, -3, 3},
                      Function{"ceil", ceil, -3, 3}, Function{"trunc", trunc, -3, 3}, Function{"round", round, -3, 3},
                      Function{"roundEven", roundEven, -3, 3}, Function{"exp", exp, -20, 20},
                      Function{"exp2", exp2, -20, 20}, Function{"exp10", exp10, -20, 20},
                      Function{"expm1", expm1, -20, 20}, Function{"log", log, -1, 10}, Function{"log2", log2, -1, 10},
                      Function{"log10", log10, -1, 10}, Function{"log1p", log1p, -2, 10}, Function{"sin", sin, -10, 10},
                      Function{"cos", cos, -10, 10}, Function{"tan", tan, -3, 3}, Function{"asin", asin, -1.5, 1.5},
                      Function{"acos", acos, -1.5, 1.5}, Function{"atan", atan, -10, 10}, Function{"sinh", sinh, -5, 5},
                      Function{"cosh", cosh, -5, 5}, Function{"tanh", tanh, -5, 5}, Function{"asinh", asinh, -5, 5},
                      Function{"acosh", acosh, 0, 5}, Function{"atanh", atanh, -1.5, 1.5}),
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
    ASSERT_THAT(sin(Interval(x)), IsInterval(rounded(mpfr_sin, x, MPFR_RNDD), rounded(mpfr_sin, x, MPFR_RNDU))) << x;
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
  EXPECT_THAT(log2(Interval(0, 8)), IsInterval(-infinity, 3));
  EXPECT_THAT(log10(Interval(-1, 1000)), IsInterval(-infinity, 3));
  EXPECT_THAT(log1p(Interval(-2, 0)), IsInterval(-infinity, 0));
  EXPECT_THAT(log1p(Interval(-1)), IsEmptyInterval());
  EXPECT_EQ(asin(Interval(0, 3)).lower(), 0);
  EXPECT_THAT(acos(Interval(2, 3)), IsEmptyInterval());
  EXPECT_THAT(acosh(Interval(-3, 1)), IsInterval(0, 0));
  EXPECT_THAT(acosh(Interval(-3, 0.5)), IsEmptyInterval());
  EXPECT_TRUE(isEntire(atanh(Interval(-1, 2))));
  EXPECT_THAT(atanh(Interval(1)), IsEmptyInterval());
}

TEST(Interval, RootsOfOddDegreeTakeNegativeNumbersAndThoseOfEvenDegreeDoNot) {
  EXPECT_THAT(cbrt(Interval(-8, 27)), IsInterval(-2, 3));
  EXPECT_THAT(rootn(Interval(-32, 1), 5), IsInterval(-2, 1));
  EXPECT_THAT(rootn(Interval(-16, 16), 4), IsInterval(0, 2));
  EXPECT_THAT(rootn(Interval(-2, -1), 2), IsEmptyInterval());
  EXPECT_THAT(rootn(Interval(-2, 5), 1), IsInterval(-2, 5));
  EXPECT_THROW(rootn(Interval(1), 0), std::invalid_argument);
  EXPECT_THROW(rootn(Interval(1), -3), std::invalid_argument);
}

TEST(Interval, IntegerPowersTreatZeroAsDivisionDoes) {
  EXPECT_THAT(pow(Interval(0), 0), IsInterval(1, 1));
  EXPECT_THAT(pow(Interval(-2, 1), 4), IsInterval(0, 16));
  EXPECT_THAT(pow(Interval(-2, 1), 3), IsInterval(-8, 1));
  EXPECT_THAT(pow(Interval(-2, 1), -2), IsInterval(0.25, infinity));
  EXPECT_TRUE(isEntire(pow(Interval(-2, 1), -1)));
  EXPECT_THAT(pow(Interval(0), -1), IsEmptyInterval());
}

TEST(Interval, RealPowersTakeNonnegativeBases) {
  EXPECT_THAT(pow(Interval(0, 4), 0.5), IsInterval(0, 2));
  EXPECT_THAT(pow(Interval(-2, -1), Interval(0.5)), IsEmptyInterval());
  EXPECT_THAT(pow(Interval(-2, 4), Interval(2)), IsInterval(0, 16));
  EXPECT_THAT(pow(Interval(-0.0, 1), Interval(-1)), IsInterval(1, infinity));
  EXPECT_THAT(pow(Interval(0), Interval(-1, 0)), IsEmptyInterval());
}

TEST(Interval, AWholeExponentIsWholeWhateverItsType) {
  const Interval x(-2, 1);
  for (const Interval& square : {pow(x, 2), pow(x, 2u), pow(x, 2L), pow(x, std::size_t{2}), pow(x, 2.0)})
    EXPECT_THAT(square, IsInterval(0, 4));
  EXPECT_THAT(pow(x, 3.0), IsInterval(-8, 1));
  EXPECT_THAT(pow(Interval(-2), -1.0), IsInterval(-0.5, -0.5));
  EXPECT_THAT(pow(x, 0.5), IsInterval(0, 1));
  EXPECT_THAT(pow(Interval(-1, 0.5), 0x1p70), IsInterval(0, 1));
  EXPECT_THROW(pow(x, std::numeric_limits<std::uint64_t>::max()), std::out_of_range);
}

TEST(Interval, HoldsWholeNumbersThatAreNoDoubles) {
  const Interval x(9007199254740993L), y(-9007199254740993L), z(std::numeric_limits<std::uint64_t>::max());
  EXPECT_THAT(x, IsInterval(9007199254740992.0, 9007199254740994.0));
  EXPECT_THAT(y, IsInterval(-9007199254740994.0, -9007199254740992.0));
  EXPECT_THAT(z, IsInterval(0x1.fffffffffffffp63, 0x1p64));
  EXPECT_THAT(Interval(std::int64_t{-4}), IsInterval(-4, -4));
  static_assert(!std::is_constructible_v<Interval, std::nullptr_t>);
  const char* none = nullptr;
  EXPECT_THROW(Interval{none}, std::invalid_argument);
}

/// Computes while the thread's other objects are being destroyed.
struct Late {
  explicit Late(Interval& result) : result_(result) {}
  ~Late() { result_ = sinh(Interval(1)) + sin(Interval(1e300)); }
  Interval& result_;
};

TEST(Interval, WorksWhileAThreadsObjectsAreDestroyed) {
  const Interval expected = sinh(Interval(1)) + sin(Interval(1e300));
  Interval result, before;
  std::thread([&] {
    thread_local const Late late(result);
    before = late.result_ + sinh(Interval(1)) + sin(Interval(1e300));
  }).join();
  EXPECT_TRUE(isEqual(before, expected));
  EXPECT_TRUE(isEqual(result, expected));
}

TEST(Interval, AnAngleIsUndefinedAtTheOriginAloneAndJumpsAtTheNegativeAxis) {
  const double up = pi().upper(), down = pi().lower();
  EXPECT_THAT(atan2(Interval(0), Interval(0)), IsEmptyInterval());
  EXPECT_THAT(atan2(Interval(-0.0), Interval(-2, -1)), IsInterval(down, up));
  EXPECT_THAT(atan2(Interval(-0.0), Interval(-2, 0)), IsInterval(down, up));
  EXPECT_THAT(atan2(Interval(0), Interval(-1, 1)), IsInterval(0, up));
  EXPECT_THAT(atan2(Interval(0), Interval(0, 1)), IsInterval(0, 0));
  EXPECT_THAT(atan2(Interval(-1, 1), Interval(-2, -1)), IsInterval(-up, up));
  EXPECT_THAT(atan2(Interval(-1, 0), Interval(-2, -1)), IsInterval(-up, up));
  EXPECT_EQ(atan2(Interval(0, 1), Interval(-2, -1)).upper(), up);
  EXPECT_GT(atan2(Interval(0, 1), Interval(-2, -1)).lower(), 2);
  EXPECT_LT(atan2(Interval(-1, -0.5), Interval(-2, -1)).upper(), -2);
  EXPECT_THAT(atan2(Interval(-1, 1), Interval(0, infinity)), IsInterval(-halfPi().upper(), halfPi().upper()));
}

TEST(Interval, StepFunctionsHoldEveryValueBetweenThoseAtTheEndpoints) {
  EXPECT_THAT(sign(Interval(-2, 3)), IsInterval(-1, 1));
  EXPECT_THAT(sign(Interval(0)), IsInterval(0, 0));
  EXPECT_THAT(floor(Interval(-1.5, 2.5)), IsInterval(-2, 2));
  EXPECT_THAT(ceil(Interval(-1.5, 2.5)), IsInterval(-1, 3));
  EXPECT_THAT(trunc(Interval(-1.5, 2.5)), IsInterval(-1, 2));
  EXPECT_THAT(round(Interval(-1.5, 2.5)), IsInterval(-2, 3));
  EXPECT_THAT(roundEven(Interval(-1.5, 2.5)), IsInterval(-2, 2));
  EXPECT_THAT(floor(Interval(0.5, infinity)), IsInterval(0, infinity));
}

TEST(Interval, AHypotenuseDoesNotOverflowOnTheWay) {
  EXPECT_THAT(hypot(Interval(-3, 0), Interval(4)), IsInterval(4, 5));
  EXPECT_THAT(hypot(Interval(3e300), Interval(4e300)), IsSubsetOf(Interval(4.9999e300, 5.0001e300)));
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

TEST(Interval, TheHalvesOfABisectionShareTheCutAndCoverTheInterval) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = random.anyInterval();
    const auto [lower, upper] = bisect(x);
    ASSERT_TRUE(isEqual(hull(lower, upper), x)) << x;
    ASSERT_EQ(lower.upper(), upper.lower()) << x;
    ASSERT_EQ(lower.upper(), midpoint(x)) << x;
  }
  EXPECT_THAT(bisect(Interval(1, 3)).lower, IsInterval(1, 2));
  EXPECT_THAT(bisect(Interval(1, 3)).upper, IsInterval(2, 3));
  EXPECT_THAT(bisect(Interval(5)).lower, IsInterval(5, 5));
  EXPECT_THAT(bisect(Interval(5)).upper, IsInterval(5, 5));
  EXPECT_THAT(bisect(Interval::empty()).lower, IsEmptyInterval());
  EXPECT_THAT(bisect(Interval::empty()).upper, IsEmptyInterval());
  EXPECT_THAT(bisect(Interval::entire()).lower, IsInterval(-infinity, 0));
  EXPECT_THAT(bisect(Interval::entire()).upper, IsInterval(0, infinity));
  EXPECT_THAT(bisect(Interval(3, infinity)).lower, IsInterval(3, largest));
  EXPECT_THAT(bisect(Interval(-infinity, 3)).upper, IsInterval(-largest, 3));
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
  EXPECT_TRUE(isCommon(Interval(1, 2)) && !isCommon(Interval(1, infinity)) && !isCommon(empty));
}

TEST(Interval, WhatIsCertainHoldsForEveryElementAndNeverForNone) {
  EXPECT_TRUE(certainlyLess(Interval(0, 1), Interval(2, 3)));
  EXPECT_FALSE(certainlyLess(Interval(0, 1), Interval(1, 3)));
  EXPECT_TRUE(certainlyLessOrEqual(Interval(0, 1), Interval(1, 3)));
  EXPECT_TRUE(certainlyGreater(Interval(2, 3), Interval(0, 1)) && !certainlyGreater(Interval(1, 3), Interval(0, 1)));
  EXPECT_TRUE(certainlyGreaterOrEqual(Interval(1, 3), Interval(0, 1)));
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
template <class T>
concept ThreeWayComparable = requires(const T& x) {
  x <=> x;
};
static_assert(!Ordered<Interval> && !Comparable<Interval> && !ThreeWayComparable<Interval>,
              "a comparison of intervals has no yes-or-no answer");
static_assert(!std::is_convertible_v<const char*, Interval> && std::is_convertible_v<double, Interval>);

// ---- Construction ---------------------------------------------------------------------------------------------------

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

}  // namespace
}  // namespace gamut::interval_test
