// Membership functions: cuts must be outward, nearly tight and nested, exactly; straight flanks are judged in rational
// arithmetic, the Gaussian in high precision.
#include "scalars/membership.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <functional>
#include <stdexcept>

#include "tests/scalars/high_precision.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::membership_test {
namespace {

using namespace gamut::testing;
using ::testing::HasSubstr;
using ::testing::StrEq;
using ::testing::ThrowsMessage;
using Points = std::vector<Membership::Point>;
using Rational = boost::multiprecision::cpp_rational;

/// A table of up to nine points: degrees rise to 1 and fall, values do not fall and are often repeated.
Points randomTable(RandomDoubles& random) {
  Points points;
  const auto add = [&](double degree) {
    const double before = points.empty() ? random.uniform(-3, 3) : points.back().value;
    points.push_back({random.integer(0, 3) == 0 ? before : before + random.uniform(0, 2), degree});
  };
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> degrees;
    for (int i = random.integer(0, 3); i > 0; --i) degrees.push_back(sign * random.integer(0, 64) / 64);
    std::ranges::sort(degrees);
    for (const double degree : degrees) add(std::abs(degree));
    if (sign > 0)
      for (int i = random.integer(1, 2); i > 0; --i) add(1);
  }
  return points;
}

/// The exact degree of a table: the greatest of the points and lines at the value.
Rational exactDegree(const Points& points, const Rational& value) {
  Rational most = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Rational b = points[i].value, degree = points[i].degree;
    if (b == value && degree > most) most = degree;
    if (i == 0) continue;
    const Rational a = points[i - 1].value, before = points[i - 1].degree;
    if (!(a < value && value < b)) continue;
    const Rational between = before + (degree - before) * (value - a) / (b - a);
    if (between > most) most = between;
  }
  return most;
}

/// The exact ends of the alpha-cut of a table, 0 < alpha <= 1.
std::pair<Rational, Rational> exactCut(const Points& points, const Rational& alpha) {
  const auto end = [&](auto from) -> Rational {
    auto i = from;
    while (Rational(i->degree) < alpha) ++i;
    if (i == from) return i->value;
    const auto before = i - 1;
    return before->value +
           (Rational(i->value) - before->value) * (alpha - before->degree) / (Rational(i->degree) - before->degree);
  };
  return {end(points.begin()), end(points.rbegin())};
}

std::vector<Membership> oneOfEach() {
  return {Membership::triangular(0.1, 0.3, 0.7), Membership::trapezoidal(-0.1, 0.2, 0.3, 0.35),
          Membership::gaussian({0.0, 0.9}, 0.3, 0.2), Membership::table({{0, 0.1}, {0.1, 0.3}, {0.4, 1}, {0.9, 0}})};
}

TEST(Membership, CutsOfATableHoldTheExactOnesAndAreTightToFourUnitsOfTheirSize) {
  RandomDoubles random;
  for (int i = 0; i < cases / 4; ++i) {
    const Points points = randomTable(random);
    const Membership table = Membership::table(points);
    const double size = magnitude(table.support()), unit = std::nextafter(size, infinity) - size;
    for (const double alpha : {smallest, random.uniform(0, 1), points[points.size() / 2].degree, 1.0}) {
      if (alpha == 0) continue;
      const auto [left, right] = exactCut(points, alpha);
      const Interval cut = table.cut(alpha);
      ASSERT_TRUE(Rational(cut.lower()) <= left && right <= Rational(cut.upper())) << cut << " at " << alpha;
      ASSERT_TRUE(left - cut.lower() <= 4 * Rational(unit) && cut.upper() - right <= 4 * Rational(unit)) << cut;
    }
  }
}

TEST(Membership, CutsOfTrianglesAndTrapezoidsHoldTheExactOnes) {
  RandomDoubles random;
  for (int i = 0; i < cases / 4; ++i) {
    double v[4];
    for (double& value : v) value = random.uniform(-3, 3);
    std::ranges::sort(v);
    const double alpha = random.uniform(0, 1);
    const Interval trapezoid = Membership::trapezoidal(v[0], v[1], v[2], v[3]).cut(alpha);
    const Interval triangle = Membership::triangular(v[0], v[1], v[3]).cut(alpha);
    const Rational a = alpha, left = v[0] + a * (Rational(v[1]) - v[0]);
    ASSERT_TRUE(Rational(trapezoid.lower()) <= left && Rational(triangle.lower()) <= left);
    ASSERT_TRUE(Rational(trapezoid.upper()) >= v[3] - a * (Rational(v[3]) - v[2]));
    ASSERT_TRUE(Rational(triangle.upper()) >= v[3] - a * (Rational(v[3]) - v[1]));
  }
}

TEST(Membership, CutsOfAGaussianHoldTheExactOnesAndAreTightToFourUnits) {
  RandomDoubles random;
  for (int i = 0; i < cases / 4; ++i) {
    const double centre = random.uniform(-2, 2), deviation = random.uniform(1e-3, 2), alpha = random.uniform(0, 1);
    const Interval cut = Membership::gaussian({-50.0, 50.0}, centre, deviation).cut(alpha);
    const HighPrecision reach = HighPrecision(deviation) * sqrt(-2 * log(HighPrecision(alpha)));
    ASSERT_LE(HighPrecision(cut.lower()), centre - reach) << alpha;
    ASSERT_GE(HighPrecision(cut.upper()), centre + reach) << alpha;
    const HighPrecision unit = (abs(HighPrecision(centre)) + reach) * HighPrecision(0x1p-52);
    ASSERT_LE(cut.upper() - HighPrecision(cut.lower()), 2 * reach + 8 * unit) << alpha;
  }
}

TEST(Membership, AGaussianIsCutOffAtItsSupport) {
  const Membership m = Membership::gaussian({-1.0, 0.5}, 0, 1);
  EXPECT_THAT(m.cut(1e-9), IsInterval(-1, 0.5));
  EXPECT_EQ(m.cut(0.75).upper(), 0.5);  // the Gaussian's cut, ± sqrt(-2 log 0.75) = ± 0.7585
  EXPECT_THAT(m.cut(0.75).lower(), ::testing::DoubleNear(-std::sqrt(-2 * std::log(0.75)), 1e-15));
  EXPECT_THAT(m(0.5), ::testing::DoubleNear(std::exp(-0.125), 1e-15));
  EXPECT_EQ(m(std::nextafter(0.5, 1)), 0);
}

TEST(Membership, CutsAreNestedFromTheSupportToTheCore) {
  std::vector<Membership> memberships = oneOfEach();
  RandomDoubles random;
  for (int i = 0; i < 50; ++i) memberships.push_back(Membership::table(randomTable(random)));
  for (const Membership& m : memberships) {
    EXPECT_TRUE(isEqual(m.cut(0), m.support())) << m.name();
    EXPECT_TRUE(isEqual(m.cut(1), m.core())) << m.name();
    for (int i = 1; i <= 1000; ++i) ASSERT_TRUE(isSubset(m.cut(i / 1000.0), m.cut((i - 1) / 1000.0))) << m.name();
    EXPECT_EQ(m(m.core().lower()), 1) << m.name();
    EXPECT_EQ(m(m.core().upper()), 1) << m.name();
  }
}

TEST(Membership, AValueLiesInTheCutOfItsOwnMembership) {
  std::vector<Membership> memberships = oneOfEach();
  RandomDoubles random;
  for (int i = 0; i < 50; ++i) memberships.push_back(Membership::table(randomTable(random)));
  for (const Membership& m : memberships) {
    for (int i = 0; i <= 200; ++i) {
      const double value = random.elementOf(m.support());
      ASSERT_TRUE(contains(m.cut(m(value)), value)) << m.name() << ' ' << value;
    }
  }
}

TEST(Membership, TheDegreeOfATableIsTheExactOneRoundedDownward) {
  RandomDoubles random;
  for (int i = 0; i < cases / 4; ++i) {
    const Points points = randomTable(random);
    const Membership table = Membership::table(points);
    for (const double value : {random.elementOf(table.support()), points[points.size() / 2].value}) {
      const Rational exact = exactDegree(points, value);
      ASSERT_TRUE(Rational(table(value)) <= exact) << value;
      ASSERT_TRUE(exact - table(value) <= Rational(0x1p-50)) << value;
    }
  }
}

TEST(Membership, IsZeroOutsideTheSupportAndOneOnTheCore) {
  const Membership m = Membership::trapezoidal(1, 2, 3, 4);
  EXPECT_EQ(m(0.9), 0);
  EXPECT_EQ(m(4.1), 0);
  EXPECT_EQ(m(2.5), 1);
  EXPECT_EQ(m(1.5), 0.5);
  EXPECT_EQ(Membership::trapezoidal(1, 1, 4, 4)(1.0), 1);  // upright flanks: a plain interval
  EXPECT_EQ(Membership()(0), 1);
  EXPECT_EQ(Membership()(smallest), 0);
}

TEST(Membership, ATableMayHaveUprightFlanksAPlateauAndEndsAboveZero) {
  const Membership m = Membership::table({{1, 0.25}, {2, 0.5}, {2, 1}, {3, 1}, {4, 0.5}, {4, 0}});
  EXPECT_THAT(m.support(), IsInterval(1, 4));
  EXPECT_THAT(m.cut(0.25), IsInterval(1, 4));
  EXPECT_THAT(m.cut(0.375), IsInterval(1.5, 4));
  EXPECT_THAT(m.cut(0.75), IsInterval(2, 3.5));
  EXPECT_THAT(m.core(), IsInterval(2, 3));
  EXPECT_EQ(m(1), 0.25);
  EXPECT_EQ(m(2), 1);
  EXPECT_EQ(m(4), 0.5);
  EXPECT_THAT(Membership::table({{7, 1}}).support(), IsInterval(7, 7));
}

TEST(Membership, TheSupportOfATableHasNoValuesThatAreImpossible) {
  const Membership m = Membership::table({{-9, 0}, {0, 0}, {1, 1}, {2, 0}, {5, 0}, {9, 0}});
  EXPECT_THAT(m.support(), IsInterval(0, 2));
  EXPECT_EQ(m(1.5), 0.5);
}

TEST(Membership, RefusesValuesOutOfOrder) {
  EXPECT_THROW(Membership::triangular(0, 2, 1), std::invalid_argument);
  EXPECT_THROW(Membership::trapezoidal(0, 2, 1, 3), std::invalid_argument);
  EXPECT_THROW(Membership::trapezoidal(0, 1, 2, infinity), std::invalid_argument);
  EXPECT_THROW(Membership::gaussian({0.0, 1.0}, 2.0, 0.1), std::invalid_argument);
  EXPECT_THROW(Membership::gaussian({0.0, 1.0}, 0.5, 0), std::invalid_argument);
  EXPECT_THROW(Membership::gaussian(Interval::entire(), 0.5, 1), std::invalid_argument);
  EXPECT_THROW(Membership::triangular(0, 1, 2).cut(1.1), std::invalid_argument);
}

TEST(Membership, RefusesCornersInWordsOfTheFunctionAndInTheNumbersGiven) {
  const std::pair<std::function<void()>, const char*> wrong[] = {
      {[] { Membership::triangular(3, 2, 1); },
       "a membership function's support must be a bounded interval, not from 3 to 1"},
      {[] { Membership::trapezoidal(0, 1, 2, infinity); },
       "a membership function's support must be a bounded interval, not from 0 to inf"},
      {[] { Membership::trapezoidal(0, 2, 1.1, 3); },
       "a membership function's core must be a bounded interval, not from 2 to 1.1"},
      {[] { Membership::triangular(0.1, 0.8050005, 0.805); },
       "the core 0.8050005 of a membership function lies outside its support [0.1, 0.805]"},
      {[] { Membership::trapezoidal(0.1, 0.2, 0.9, 0.805); },
       "the core [0.2, 0.9] of a membership function lies outside its support [0.1, 0.805]"},
      {[] {
         Membership::gaussian({0.1, 0.3}, 0.7, 1);
       },
       "the centre 0.7 of a membership function lies outside its support [0.1, 0.3]"}};
  for (const auto& [make, message] : wrong) EXPECT_THAT(make, ThrowsMessage<std::invalid_argument>(StrEq(message)));
}

TEST(Membership, ATablesRefusalKnowsThePointAndWhatIsWrongWithIt) {
  try {
    Membership::table({{0, 0}, {1, 0.5}, {2, 0.25}, {3, 1}});
    ADD_FAILURE() << "was made";
  } catch (const Membership::BadPoint& error) {
    EXPECT_EQ(error.index, 2u);
    EXPECT_EQ(error.problem, "falls although the table has not reached 1");
  }
}

TEST(Membership, ATableNamesTheFirstPointThatIsWrong) {
  const std::pair<Points, const char*> wrong[] = {
      {{}, "a membership table needs at least one point"},
      {{{0, 0}, {infinity, 1}}, "point 2, (inf, 1), of a membership table is not finite"},
      {{{0, -0.5}, {1, 1}}, "point 1, (0, -0.5), of a membership table has a degree outside [0, 1]"},
      {{{0, 0}, {1, 1.5}, {0, 2}}, "point 2, (1, 1.5), of a membership table has a degree outside [0, 1]"},
      {{{0, 0}, {2, 1}, {1, 0}}, "point 3, (1, 0), of a membership table lies left of the point before it"},
      {{{0, 0}, {1, 1}, {2, 0.5}, {3, 0.75}, {4, 1}},
       "point 4, (3, 0.75), of a membership table rises again after the table has fallen"},
      {{{0, 0}, {1, 0.5}, {2, 0.25}, {3, 1}},
       "point 3, (2, 0.25), of a membership table falls although the table has not reached 1"},
      {{{0, 0}, {1, 0.5}}, "point 2, (1, 0.5), of a membership table ends it although the table has not reached 1"}};
  for (const auto& [points, message] : wrong) {
    const auto make = [&table = points] { Membership::table(table); };
    EXPECT_THAT(make, ThrowsMessage<std::invalid_argument>(HasSubstr(message)));
  }
}

TEST(Membership, SaysOfWhichNumbersItIsMade) {
  const auto written = [](const Membership& m) {
    std::string text;
    for (const auto& [name, value, isOfQuantity] : m.numbers())
      text += (text.empty() ? "" : ", ") + name + " " + (isOfQuantity ? toString(value) : "(" + toString(value) + ")");
    return text;
  };
  EXPECT_EQ(written(Membership::triangular(1, 2, 4)), "lower 1, upper 4, apex 2");
  EXPECT_EQ(written(Membership::trapezoidal(1, 2, 3, 4)), "lower 1, upper 4, left 2, right 3");
  EXPECT_EQ(written(Membership::gaussian({0.0, 5.0}, 2, 0.5)), "lower 0, upper 5, centre 2, deviation 0.5");
  EXPECT_EQ(
      written(Membership::table({{1, 0}, {2, 1}, {4, 0.25}})),
      "lower 1, upper 4, value 1 1, membership 1 (0), value 2 2, membership 2 (1), value 3 4, membership 3 (0.25)");
}

}  // namespace
}  // namespace gamut::membership_test
