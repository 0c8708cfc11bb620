// Laws of Fuzzy: cuts are nested, each is the interval operation on the operands' cuts, and each holds the exact cut.
#include "scalars/fuzzy.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "tests/scalars/reference.hpp"

namespace gamut {
namespace {

using namespace gamut::testing;

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

TEST(Fuzzy, EveryCutOfATriangleHoldsTheExactCut) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const std::size_t levels = random.integer(2, 12);
    double corners[] = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
    std::ranges::sort(corners);
    const auto [lower, apex, upper] = corners;
    const Fuzzy x = Fuzzy::triangular(lower, apex, upper, levels);
    ASSERT_THAT(x, IsNested());
    for (std::size_t level = 0; level < levels; ++level) {
      // (levels - 1) * exact end = outer * (levels - 1 - level) + apex * level, exact in 300 bits
      const unsigned long top = levels - 1;
      for (const double outer : {lower, upper}) {
        Mpfr exact(outer, 300), part(apex, 300),
            scaled(outer == lower ? x.cut(level).lower() : x.cut(level).upper(), 300);
        mpfr_mul_ui(exact, exact, top - level, MPFR_RNDN);
        mpfr_mul_ui(part, part, level, MPFR_RNDN);
        mpfr_add(exact, exact, part, MPFR_RNDN);
        mpfr_mul_ui(scaled, scaled, top, MPFR_RNDN);
        const int order = mpfr_cmp(scaled, exact);
        ASSERT_TRUE(outer == lower ? order <= 0 : order >= 0) << x << " level " << level;
      }
    }
  }
}

TEST(Fuzzy, MakersRefuseCornersOutOfOrderAndTooFewLevels) {
  EXPECT_THROW(Fuzzy::triangular(0, 3, 2, 4), std::invalid_argument);
  EXPECT_THROW(Fuzzy::triangular(2, 1, 0, 4), std::invalid_argument);
  EXPECT_THROW(Fuzzy::triangular(0, 1, 2, 1), std::invalid_argument);
  EXPECT_THROW(Fuzzy::trapezoidal(0, 1, 3, 2, 4), std::invalid_argument);
  EXPECT_THROW(Fuzzy::trapezoidal(0, 1, 2, infinity, 4), std::invalid_argument);
  EXPECT_THROW(Fuzzy(std::vector<Interval>{}), std::invalid_argument);
  EXPECT_THROW(Fuzzy({Interval(0, 1), Interval(0, 2)}), std::invalid_argument);
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
      {abs, abs},
      {exp, exp},
      {log, log},
      {sin, sin},
      {cos, cos},
      {tan, tan},
      {asin, asin},
      {acos, acos},
      {atan, atan},
      {sinh, sinh},
      {cosh, cosh},
      {tanh, tanh},
      {[](const Fuzzy& x) { return pow(x, 3); }, [](const Interval& x) { return pow(x, 3); }},
      {[](const Fuzzy& x) { return pow(x, 0.5); }, [](const Interval& x) { return pow(x, 0.5); }},
      {[](const Fuzzy& x) { return pow(x, x); }, [](const Interval& x) { return pow(x, x); }},
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

TEST(Fuzzy, PrintsFromSupportToCore) {
  std::ostringstream text;
  text << Fuzzy::triangular(0, 1, 2, 2);
  EXPECT_EQ(text.str(), "{[0, 2], [1, 1]}");
}

}  // namespace
}  // namespace gamut
