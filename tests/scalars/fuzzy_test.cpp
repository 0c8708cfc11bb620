// Laws of Fuzzy: cuts are nested, each is the interval operation on the operands' cuts, and each holds the exact cut;
// what is said of possibility, necessity and centroid holds for the number enclosed.
#include "scalars/fuzzy.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tests/scalars/reference.hpp"

namespace gamut::fuzzy_test {
namespace {

using namespace gamut::testing;
using ::testing::StrEq;
using ::testing::ThrowsMessage;
using Rational = boost::multiprecision::cpp_rational;

Fuzzy randomTriangle(RandomDoubles& random, double lower, double upper, std::size_t levels) {
  double corners[] = {random.uniform(lower, upper), random.uniform(lower, upper), random.uniform(lower, upper)};
  std::ranges::sort(corners);
  return Fuzzy::triangular(corners[0], corners[1], corners[2], levels);
}

MATCHER(IsNested, "has nested cuts") {
  for (std::size_t level = 1; level < arg.levels(); ++level) {
    if (!isSubset(arg.cut(level), arg.cut(level - 1))) return false;
  }
  return true;
}

TEST(Fuzzy, ATriangleHasItsSupportBelowAndItsApexOnTop) {
  const Fuzzy x = Fuzzy::triangular(1, 2, 4, 5);
  EXPECT_EQ(x.levels(), 5u);
  EXPECT_THAT(x.support(), IsInterval(1, 4));
  EXPECT_THAT(x.cut(2), IsInterval(1.5, 3));
  EXPECT_THAT(x.core(), IsInterval(2, 2));
  EXPECT_EQ(x.alpha(0), 0);
  EXPECT_EQ(x.alpha(1), 0.25);
  EXPECT_EQ(x.alpha(4), 1);
}

TEST(Fuzzy, ATrapezoidHasItsPlateauOnTop) {
  const Fuzzy x = Fuzzy::trapezoidal(0, 1, 3, 5, 3);
  EXPECT_THAT(x.support(), IsInterval(0, 5));
  EXPECT_THAT(x.cut(1), IsInterval(0.5, 4));
  EXPECT_THAT(x.core(), IsInterval(1, 3));
}

TEST(Fuzzy, EveryMakerCutsItsMembershipAtTheAlphaOfEachLevel) {
  const std::vector<Membership::Point> points = {{-1, 0}, {0.1, 0.3}, {0.2, 1}, {0.9, 0}};
  const std::pair<Fuzzy, Membership> made[] = {
      {Fuzzy::triangular(0.1, 0.3, 0.7, 11), Membership::triangular(0.1, 0.3, 0.7)},
      {Fuzzy::trapezoidal(0.1, 0.3, 0.4, 0.7, 8), Membership::trapezoidal(0.1, 0.3, 0.4, 0.7)},
      {Fuzzy::gaussian({-1.0, 0.9}, 0.1, 0.3, 31), Membership::gaussian({-1.0, 0.9}, 0.1, 0.3)},
      {Fuzzy::table(points, 7), Membership::table(points)}};
  for (const auto& [x, membership] : made) {
    EXPECT_THAT(x, IsNested());
    for (std::size_t level = 0; level < x.levels(); ++level) {
      EXPECT_EQ(x.alpha(level), static_cast<double>(level) / static_cast<double>(x.levels() - 1));
      EXPECT_TRUE(isEqual(x.cut(level), membership.cut(x.alpha(level)))) << membership.name() << ' ' << level;
    }
  }
}

TEST(Fuzzy, MakersRefuseCornersOutOfOrderAndTooFewLevels) {
  EXPECT_THROW(Fuzzy::triangular(0, 3, 2, 4), std::invalid_argument);
  EXPECT_THROW(Fuzzy::triangular(2, 1, 0, 4), std::invalid_argument);
  EXPECT_THROW(Fuzzy::triangular(0, 1, 2, 1), std::invalid_argument);
  EXPECT_THROW(Fuzzy(Membership(), 0), std::invalid_argument);
  EXPECT_THROW(Fuzzy::trapezoidal(0, 1, 3, 2, 4), std::invalid_argument);
  EXPECT_THROW(Fuzzy::trapezoidal(0, 1, 2, infinity, 4), std::invalid_argument);
  EXPECT_THROW(Fuzzy(std::vector<Interval>{}), std::invalid_argument);
  EXPECT_THROW(Fuzzy({Interval(0, 1), Interval(0, 2)}), std::invalid_argument);
}

TEST(Fuzzy, MakersSayWhichPartOfTheMembershipFunctionIsWrong) {
  EXPECT_THAT([] { Fuzzy::triangular(3, 2, 1, 11); },
              ThrowsMessage<std::invalid_argument>(
                  StrEq("a membership function's support must be a bounded interval, not from 3 to 1")));
}

TEST(Fuzzy, ALevelThatThereIsNotIsRefusedByItsNumber) {
  const Fuzzy x = Fuzzy::triangular(1, 2, 4, 11);
  EXPECT_THAT(x.cut(10), IsInterval(2, 2));
  for (const std::size_t level : {11u, 12u, 1000u}) {
    EXPECT_THAT([&] { x.cut(level); },
                ThrowsMessage<std::out_of_range>(
                    StrEq("level " + std::to_string(level) + " of a fuzzy number of 11 levels, counted from 0")));
  }
}

TEST(Fuzzy, ArithmeticIsIntervalArithmeticCutByCutAndStaysNested) {
  RandomDoubles random;
  for (int i = 0; i < cases / 10; ++i) {
    const Fuzzy x = randomTriangle(random, -3, 3, 6), y = randomTriangle(random, 0.5, 3, 6);
    for (const Fuzzy& result : {x + y, x - y, x * y, x / y, -x}) ASSERT_THAT(result, IsNested());
    for (std::size_t level = 0; level < 6; ++level) {
      ASSERT_TRUE(isEqual((x + y).cut(level), x.cut(level) + y.cut(level)));
      ASSERT_TRUE(isEqual((x - y).cut(level), x.cut(level) - y.cut(level)));
      ASSERT_TRUE(isEqual((x * y).cut(level), x.cut(level) * y.cut(level)));
      ASSERT_TRUE(isEqual((x / y).cut(level), x.cut(level) / y.cut(level)));
      ASSERT_TRUE(isEqual((-x).cut(level), -x.cut(level)));
    }
  }
}

TEST(Fuzzy, FunctionsAreThoseOfIntervalCutByCutAndStayNested) {
  using OfFuzzy = Fuzzy (*)(const Fuzzy&);
  using OfInterval = Interval (*)(const Interval&);
  const std::pair<OfFuzzy, OfInterval> functions[] = {
      {sqr, sqr},
      {sqrt, sqrt},
      {cbrt, cbrt},
      {abs, abs},
      {sign, sign},
      {floor, floor},
      {ceil, ceil},
      {trunc, trunc},
      {round, round},
      {roundEven, roundEven},
      {exp, exp},
      {exp2, exp2},
      {exp10, exp10},
      {expm1, expm1},
      {log, log},
      {log2, log2},
      {log10, log10},
      {log1p, log1p},
      {sin, sin},
      {cos, cos},
      {tan, tan},
      {asin, asin},
      {acos, acos},
      {atan, atan},
      {sinh, sinh},
      {cosh, cosh},
      {tanh, tanh},
      {asinh, asinh},
      {acosh, acosh},
      {atanh, atanh},
      {[](const Fuzzy& x) { return rootn(x, 3); }, [](const Interval& x) { return rootn(x, 3); }},
      {[](const Fuzzy& x) { return pow(x, 3); }, [](const Interval& x) { return pow(x, 3); }},
      {[](const Fuzzy& x) { return pow(x, 0.5); }, [](const Interval& x) { return pow(x, 0.5); }},
      {[](const Fuzzy& x) { return pow(x, x); }, [](const Interval& x) { return pow(x, x); }},
      {[](const Fuzzy& x) { return atan2(x, 0.5); }, [](const Interval& x) { return atan2(x, 0.5); }},
      {[](const Fuzzy& x) { return atan2(0.5, x); }, [](const Interval& x) { return atan2(0.5, x); }},
      {[](const Fuzzy& x) { return hypot(x, 0.5); }, [](const Interval& x) { return hypot(x, 0.5); }},
      {[](const Fuzzy& x) { return min(x, 0.5); }, [](const Interval& x) { return min(x, 0.5); }},
      {[](const Fuzzy& x) { return max(x, 0.5); }, [](const Interval& x) { return max(x, 0.5); }}};
  RandomDoubles random;
  for (int i = 0; i < cases / 20; ++i) {
    const Fuzzy x = randomTriangle(random, -2, 4, 5);
    for (const auto& [ofFuzzy, ofInterval] : functions) {
      const Fuzzy result = ofFuzzy(x);
      ASSERT_THAT(result, IsNested());
      for (std::size_t level = 0; level < 5; ++level) {
        ASSERT_TRUE(isEqual(result.cut(level), ofInterval(x.cut(level)))) << x;
      }
    }
  }
}

TEST(Fuzzy, AWholeExponentInADoubleTakesNegativeBases) {
  const Fuzzy x = Fuzzy::triangular(-2, -0.5, 1, 4);
  EXPECT_THAT(pow(x, 2.0).support(), IsInterval(0, 4));
  EXPECT_THAT(pow(x, 3.0).support(), IsInterval(-8, 1));
  EXPECT_THAT(pow(x, -1.0).core(), IsInterval(-2, -2));
  for (std::size_t level = 0; level < 4; ++level) {
    EXPECT_TRUE(isEqual(pow(x, 2.0).cut(level), sqr(x).cut(level)));
    EXPECT_TRUE(isEqual(pow(x, 3.0).cut(level), pow(x, 3).cut(level)));
    EXPECT_TRUE(isEqual(pow(x, 3u).cut(level), pow(x, 3L).cut(level)));
  }
  EXPECT_THAT(pow(x, 2.5).support(), IsInterval(0, 1));
  EXPECT_THROW(pow(x, ~0UL), std::out_of_range);
}

TEST(Fuzzy, EachCutOfAFunctionHoldsTheFunctionOfEachElementOfTheOperandsCut) {
  const std::pair<Fuzzy (*)(const Fuzzy&), OfOne> functions[] = {
      {sqr, mpfr_sqr},     {sqrt, mpfr_sqrt},   {cbrt, mpfr_cbrt},  {exp, mpfr_exp},   {exp2, mpfr_exp2},
      {exp10, mpfr_exp10}, {expm1, mpfr_expm1}, {log, mpfr_log},    {log2, mpfr_log2}, {log10, mpfr_log10},
      {log1p, mpfr_log1p}, {sin, mpfr_sin},     {cos, mpfr_cos},    {tan, mpfr_tan},   {asin, mpfr_asin},
      {acos, mpfr_acos},   {atan, mpfr_atan},   {sinh, mpfr_sinh},  {cosh, mpfr_cosh}, {tanh, mpfr_tanh},
      {asinh, mpfr_asinh}, {acosh, mpfr_acosh}, {atanh, mpfr_atanh}};
  RandomDoubles random;
  for (int i = 0; i < cases / 50; ++i) {
    const Fuzzy x = Fuzzy::gaussian({-2.0, 3.0}, random.uniform(-2, 3), random.uniform(0.01, 1), 4);
    for (const auto& [function, exact] : functions) {
      const Fuzzy result = function(x);
      for (std::size_t level = 0; level < x.levels(); ++level) {
        const double value = random.elementOf(x.cut(level));
        const double down = rounded(exact, value, MPFR_RNDD), up = rounded(exact, value, MPFR_RNDU);
        if (std::isnan(down) || std::isinf(down) || std::isinf(up)) continue;  // outside of the domain, or at its end
        ASSERT_TRUE(result.cut(level).lower() <= down && up <= result.cut(level).upper()) << value << ' ' << result;
      }
    }
  }
}

TEST(Fuzzy, ACrispQuantityCombinesWithAnyNumberOfLevels) {
  const Fuzzy x = Fuzzy::triangular(1, 2, 3, 3);
  EXPECT_THAT((2 * x).cut(1), IsInterval(3, 5));
  EXPECT_THAT((x + Interval(0, 1)).core(), IsInterval(2, 3));
  EXPECT_EQ((Fuzzy(1) + 2).levels(), 1u);
  EXPECT_EQ(Fuzzy(1).alpha(0), 1);
  EXPECT_THAT(Fuzzy(Interval(1, 2)).cut(7), IsInterval(1, 2));
  EXPECT_THROW(x + Fuzzy::triangular(1, 2, 3, 4), std::invalid_argument);
}

TEST(Fuzzy, AnEnclosedConstantIsThatIntervalAtEveryLevel) {
  EXPECT_TRUE(isEqual(constant<Fuzzy>(pi()).support(), pi()));
  EXPECT_TRUE(isEqual(constant<Fuzzy>(pi()).core(), pi()));
}

TEST(Fuzzy, CutsOutsideAFunctionsDomainAreEmptyAndStayNested) {
  const Fuzzy root = sqrt(Fuzzy::triangular(-2, -1, 4, 4));
  EXPECT_THAT(root, IsNested());
  EXPECT_EQ(root.support().lower(), 0);
  EXPECT_THAT(root.core(), IsEmptyInterval());
}

TEST(Fuzzy, PossibilityIsTheLeastAlphaWhoseCutMissesTheEvent) {
  const Fuzzy x = Fuzzy::triangular(0, 1, 2, 5);
  EXPECT_THAT(possibility(x, {2.5, infinity}), IsInterval(0, 0));
  EXPECT_THAT(possibility(x, {2, infinity}), IsInterval(0, 0.25));
  EXPECT_THAT(possibility(x, {1.6, infinity}), IsInterval(0, 0.5));  // exactly 0.4
  EXPECT_THAT(possibility(x, {-infinity, 0.5}), IsInterval(0, 0.75));
  EXPECT_THAT(possibility(x, {1.5, 1.7}), IsInterval(0, 0.75));
  EXPECT_THAT(possibility(x, {1, infinity}), IsInterval(1, 1));
  EXPECT_THAT(possibility(x, Interval::entire()), IsInterval(1, 1));
  EXPECT_THAT(possibility(x, Interval::empty()), IsInterval(0, 0));
}

TEST(Fuzzy, NecessityIsWhatThePossibilityOfTheComplementLeaves) {
  const Fuzzy x = Fuzzy::trapezoidal(0, 1, 2, 3, 5);
  EXPECT_THAT(necessity(x, {0, infinity}), IsInterval(1, 1));
  EXPECT_THAT(necessity(x, {0.3, infinity}), IsInterval(0.5, 1));  // exactly 0.7
  EXPECT_THAT(necessity(x, {1, 2}), IsInterval(0, 1));             // exactly 0
  EXPECT_THAT(necessity(x, {0.75, 2.75}), IsInterval(0.25, 1));
  EXPECT_THAT(necessity(x, {1.5, infinity}), IsInterval(0, 1));
  EXPECT_THAT(necessity(x, {2.5, infinity}), IsInterval(0, 0));
  EXPECT_THAT(necessity(x, Interval::empty()), IsInterval(0, 0));
}

TEST(Fuzzy, ACrispQuantityIsPossibleAndNecessaryOrNotUnlessItsIntervalCannotTell) {
  const Fuzzy x = Interval(1, 2);
  EXPECT_THAT(possibility(x, {0, 3}), IsInterval(1, 1));
  EXPECT_THAT(necessity(x, {0, 3}), IsInterval(1, 1));
  EXPECT_THAT(possibility(x, {3, 4}), IsInterval(0, 0));
  EXPECT_THAT(necessity(x, {3, 4}), IsInterval(0, 0));
  EXPECT_THAT(possibility(x, {1.5, 4}), IsInterval(0, 1));
  EXPECT_THAT(necessity(x, {1.5, 4}), IsInterval(0, 1));
}

TEST(Fuzzy, PossibilityAndNecessityAreDualAndWhatIsNecessaryAtAllIsWhollyPossible) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Fuzzy x = randomTriangle(random, -3, 3, 7);
    const double threshold = random.integer(0, 1) == 0 ? random.uniform(-3, 3) : x.cut(3).lower();
    const Interval above(threshold, infinity), below(-infinity, std::nextafter(threshold, -infinity));
    ASSERT_TRUE(isEqual(necessity(x, above), 1 - possibility(x, below))) << x << ' ' << threshold;
    ASSERT_TRUE(isEqual(necessity(x, below), 1 - possibility(x, above))) << x << ' ' << threshold;
    for (const Interval& event : {above, below, random.intervalIn(-3, 3)}) {
      const Interval certain = necessity(x, event), possible = possibility(x, event);
      ASSERT_TRUE(isSubset(certain, {0, 1}) && isSubset(possible, {0, 1}));
      ASSERT_TRUE(certain.lower() == 0 || possible.lower() == 1) << x << ' ' << event;
      ASSERT_TRUE(possible.upper() == 1 || certain.upper() == 0) << x << ' ' << event;
    }
  }
}

TEST(Fuzzy, NoValueIsMorePossibleThanItsEventAndNoneOutsideOfItMoreThanItsNecessityLeaves) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const double apex = random.uniform(-1, 1);
    const Membership membership = Membership::triangular(apex - random.uniform(0, 2), apex, apex + 1);
    const Fuzzy square = sqr(Fuzzy(membership, 6)) + 1;
    const double value = random.elementOf(membership.support()), degree = membership(value);
    const Interval image = sqr(Interval(value)) + 1, event = random.intervalIn(0.5, 6);
    if (isSubset(image, event)) {
      ASSERT_LE(degree, possibility(square, event).upper()) << value << ' ' << event;
    }
    if (isDisjoint(image, event)) {
      ASSERT_LE(necessity(square, event).lower(), 1 - degree) << value << ' ' << event;
    }
  }
}

TEST(Fuzzy, TheCentroidOfKnownShapesIsEnclosedTightly) {
  EXPECT_THAT(centroid(Fuzzy::triangular(0, 3, 6, 5)), IsInterval(3, 3));
  EXPECT_TRUE(contains(centroid(Fuzzy::triangular(0, 1, 5, 5)), 2));            // the mean of the corners
  EXPECT_TRUE(contains(centroid(Fuzzy::trapezoidal(0, 2, 2, 4, 2)), 2));        // two levels tell all of it
  EXPECT_TRUE(contains(centroid(Fuzzy::trapezoidal(-1, 0, 4, 11, 17)), 3.75));  // areas 1/2, 4, 7/2 at -1/3, 2, 19/3
  EXPECT_TRUE(contains(centroid(Fuzzy::gaussian({-2.0, 2.0}, 0, 0.5, 11)), 0));
  EXPECT_THAT(centroid(Fuzzy(Interval(1, 4))), IsInterval(2.5, 2.5));
  EXPECT_THAT(centroid(Fuzzy(0.1)), IsInterval(0.1, 0.1));
  EXPECT_THAT(centroid(Fuzzy({Interval(1, 2), Interval::empty()})), IsInterval(1.5, 1.5));
  EXPECT_THAT(centroid(Fuzzy(Interval(0, infinity))), IsEmptyInterval());
  EXPECT_THAT(centroid(Fuzzy(Interval::empty())), IsEmptyInterval());
}

TEST(Fuzzy, TheCentroidIsThatOfTheStackExactlyAndTight) {
  RandomDoubles random;
  for (int i = 0; i < cases / 10; ++i) {
    const std::size_t levels = random.integer(2, 9);
    const Fuzzy x = sqr(randomTriangle(random, -3, 3, levels)) + random.uniform(-1e3, 1e3);
    Rational area = 0, moment = 0;  // of the trapezoids between neighbouring levels, times 2 and 6
    for (std::size_t level = 1; level < levels; ++level) {
      const Rational l0 = x.cut(level - 1).lower(), u0 = x.cut(level - 1).upper();
      const Rational l1 = x.cut(level).lower(), u1 = x.cut(level).upper();
      area += u0 - l0 + u1 - l1;
      moment += u0 * u0 + u0 * u1 + u1 * u1 - l0 * l0 - l0 * l1 - l1 * l1;
    }
    const Rational exact = moment / area / 3;
    const Interval result = centroid(x);
    ASSERT_TRUE(Rational(result.lower()) <= exact && exact <= Rational(result.upper())) << x;
    ASSERT_LE(width(result), 0x1p-50 * magnitude(x.support()) + 0x1p-46 * width(x.support())) << x;
  }
}

TEST(Fuzzy, TheCentroidOfANarrowNumberFarFromZeroKeepsItsDigits) {
  const double unit = 0x1p-20;
  const Interval result = centroid(Fuzzy::triangular(1e6, 1e6 + unit, 1e6 + 5 * unit, 9));
  EXPECT_TRUE(contains(result, 1e6 + 2 * unit));
  EXPECT_LE(width(result), 1e-9);
}

TEST(Fuzzy, PrintsFromSupportToCore) {
  std::ostringstream text;
  text << Fuzzy::triangular(0, 1, 2, 2);
  EXPECT_EQ(text.str(), "{[0, 2], [1, 1]}");
}

}  // namespace
}  // namespace gamut::fuzzy_test
