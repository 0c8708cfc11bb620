// Formulas of a study: grammar, exact numbers, units that are checked, one formula in every scalar.
#include "mechanics/description/expression.hpp"

#include <gmock/gmock.h>

#include <map>
#include <tuple>
#include <utility>

#include "scalars/evaluation/evaluator.hpp"
#include "scalars/fuzzy.hpp"
#include "scalars/recorded.hpp"
#include "scalars/samples.hpp"

namespace gamut {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::map<std::string, double> values = {{"rod.length", 1.5}, {"m1", 2},  {"angle", 0.25},  {"rate", -3},
                                              {"k", 10},           {"t", 0.5}, {"upper arm", 7}, {"x_2", 0.125}};

double valueOf(const std::string& name) { return values.at(name); }
double value(const std::string& text) { return Expression::parse(text).evaluate<double>(valueOf); }

TEST(Expression, FollowsTheGrammar) {
  const struct {
    const char* text;
    double value;
  } cases[] = {
      {"2", 2},
      {"2 rod.length + 3 mm", 3.003},
      {"2*rod.length+3mm", 3.003},
      {"1/2 rod.length", 0.75},
      {"-rod.length", -1.5},
      {"- rod.length", -1.5},
      {"+rod.length", 1.5},
      {"−rod.length", -1.5},
      {"rod.length/2/3", 0.25},
      {"rod.length / 2 * 3", 2.25},
      {"rod.length - 1 m - 0.25 m", 0.25},
      {"-k*angle - m1*rate^3", -2.5 + 54},
      {"-rate^2", -9},
      {"(-rate)^2", 9},
      {"rate²", 9},
      {"rate³", -27},
      {"2^3^2", 512},
      {"rate^-1", -1.0 / 3},
      {"4^0.5", 2},
      {"4^(1/2)", 2},
      {"m1^m1", 4},
      {"2 m1^2", 8},
      {"9.81 m/s^2", 9.81},
      {"1/s * 2", 2},
      {"3*-2", -6},
      {"3 - -2", 5},
      {"--2", 2},
      {"sqrt(rod.length^2 + (2 m)^2)", 2.5},
      {"atan2(1, 1)", 0.78539816339744831},
      {"hypot(3 m, 4 m)", 5},
      {"max(rate, min(1, 2))", 1},
      {"abs(rate)", 3},
      {"sign(-rate) + sign(0) + 2 sign(m1)", 3},
      {"where(rate > 2, 5, 7)", 7},
      {"where(rate < 2, 5, 7)", 5},
      {"where(rate >= -3, 5, 7)", 6},
      {"where(rate > -3, 5, 7)", 6},
      {"where(rate <= -3, 5, 7)", 6},
      {"where(rate < -3, 5, 7)", 6},
      {"where(rate <= -2, 5, 7)", 5},
      {"where(rate + 3, 5, 7)", 6},
      {"where(2 >= rate, where(rate, 1, 2), 7)", 2},
      {"2 sqrt(4)", 4},
      {"0.3 rad * sin(2*pi*t)", 0.3 * 1.2246467991473532e-16},
      {"2*pi*t/x_2", 25.132741228718345},
      {"2 t", 2000},
      {"2*t", 1},
      {"'upper arm' + 1", 8},
      {"((((1))))", 1},
      {" 1 ", 1},
      {"1e3", 1000},
      {"2.5e-1k", 2.5},
      {"tanh(0)", 0},
      {"cosh(0)+sinh(0)+exp(0)+log(1)+asin(0)+acos(1)+atan(0)+tan(0)+cos(0)", 3},
  };
  for (const auto& c : cases) EXPECT_NEAR(value(c.text), c.value, 1e-15 * std::abs(c.value)) << c.text;
}

TEST(Expression, NumbersWithoutNamesAreExact) {
  const auto enclosure = [](const char* text) {
    return Expression::parse(text).evaluate<Interval>([](const std::string&) { return Interval::entire(); });
  };
  EXPECT_TRUE(isEqual(enclosure("0.1 + 0.2"), Interval("0.3")));
  EXPECT_TRUE(isEqual(enclosure("3 mm + 1 m"), Interval("1.003")));
  EXPECT_TRUE(isEqual(enclosure("1/3 * 3"), Interval(1.0)));
  EXPECT_TRUE(isEqual(enclosure("(1/10)^2"), Interval("0.01")));
  EXPECT_TRUE(isEqual(enclosure("90 deg + 1/4 pi"), enclosure("135 deg")));
  EXPECT_TRUE(isEqual(enclosure("-(0.25 - 1)"), Interval(0.75)));
}

TEST(Expression, NamesStandInTheOrderOfTheirFirstUse) {
  EXPECT_THAT(Expression::parse("b*a + b^2").names(), ElementsAre("b", "a"));
  EXPECT_THAT(Expression::parse("2 m").names(), IsEmpty());
  EXPECT_TRUE(Expression(3.0).isConstant());
  EXPECT_EQ(Expression::named("k", 2.0).evaluate<double>(valueOf), 20);
}

TEST(Expression, IsMadeOfOthersByName) {
  const Expression sum = Expression::parse("a + 2*b");
  const Expression whole =
      Expression::parse("c^2 - b").with([&](const std::string& name) { return name == "c" ? &sum : nullptr; });
  EXPECT_THAT(whole.names(), ElementsAre("a", "b"));
  EXPECT_EQ(whole.evaluate<double>([](const std::string& name) { return name == "a" ? 1.0 : 3.0; }), 46);
  EXPECT_EQ((-Expression::parse("a")).evaluate<double>([](const std::string&) { return 2.0; }), -2);
  EXPECT_TRUE((-Expression::parse("3 mm")).amount()->value == mpq_class(-3, 1000));
  EXPECT_EQ(Expression::parse("abs(a - b)").insideOfAbs()->names().size(), 2U);
  EXPECT_FALSE(Expression::parse("abs(a) - b").insideOfAbs());
}

TEST(Expression, IsAffineInWhatItsFormSays) {
  const auto form = [](const char* whole, const char* part) {
    return Expression::parse(whole).affineIn(Expression::parse(part));
  };
  for (const auto& [whole, part, factor, offset] : {std::tuple("x - 2 m", "x", 1.0, -2.0),
                                                    {"2 m - x", "x", -1.0, 2.0},
                                                    {"3 - (-(x))", "x", 1.0, 3.0},
                                                    {"(2*x - 1)/4 + x", "x", 1.5, -0.25},
                                                    {"5 - 2*hypot(x, y)", "hypot(x, y)", -2.0, 5.0},
                                                    {"x^2 + 1", "x^2", 1.0, 1.0},
                                                    {"a + x - 1", "a + x", 1.0, -1.0}}) {
    const auto found = form(whole, part);
    ASSERT_TRUE(found) << whole;
    EXPECT_TRUE(isEqual(found->factor, Interval(factor))) << whole;
    EXPECT_TRUE(isEqual(found->offset, Interval(offset))) << whole;
  }
  for (const auto& [whole, part] : {std::pair("x - y", "x"),
                                    {"x^2", "x"},
                                    {"x*x", "x"},
                                    {"1/x", "x"},
                                    {"x - x", "x"},
                                    {"x^3", "x^2"},
                                    {"sin(x)", "x"},
                                    {"0*x + 1", "x"},
                                    {"x/(y - y)", "x"},
                                    {"3", "x"}})
    EXPECT_FALSE(form(whole, part)) << whole;
}

const std::map<std::string, std::string> units = {{"rod.length", "m"}, {"mass", "kg"},   {"angle", "rad"},
                                                  {"rate", "rad/s"},   {"k", "N m/rad"}, {"t", "s"}};

Dimension unitFor(const std::string& name) { return dimensionOf(units.at(name)); }

TEST(Expression, AMomentIsKnownByWhatItIsMadeOf) {
  const std::map<std::string, std::string> of = {{"M", "N m"},      {"k", "N m/rad"},   {"angle", "rad"},
                                                 {"rate", "rad/s"}, {"c", "N m s/rad"}, {"F", "N"},
                                                 {"lever", "m"},    {"E", "J"},         {"t", "s"}};
  const auto unit = [&](const char* text) {
    return unitOf(Expression::parse(text).dimension([&](const std::string& name) { return dimensionOf(of.at(name)); }));
  };
  for (const char* text : {"M", "-2*M", "k*angle", "-k*angle - c*rate", "max(-M, min(M, -30 N m*angle))", "F*lever + M",
                           "where(angle > 0, M, 0 J)", "sqrt(M^2 + (k*angle)^2)", "F/(2 N)*M"})
    EXPECT_EQ(unit(text), "N m") << text;
  for (const char* text : {"E", "F*lever", "E + 2*E", "E*(M/M)", "E*M^0"}) EXPECT_EQ(unit(text), "J") << text;
  EXPECT_EQ(unit("M/t"), "N m/s");
  EXPECT_EQ(unit("E/t"), "W");
}

TEST(Expression, UnitsAreCarriedThrough) {
  const struct {
    const char *text, *unit;
  } cases[] = {{"2 rod.length + 3 mm", "m"},
               {"-k*angle", "N m/rad rad"},
               {"rod.length^2", "m^2"},
               {"sqrt(rod.length^2)", "m"},
               {"rod.length/t", "m/s"},
               {"sin(angle)*rod.length", "m"},
               {"atan2(rod.length, 1 m)", "rad"},
               {"angle + 1", "rad"},
               {"where(angle > 1, rod.length, 3 mm)", "m"},
               {"sign(rod.length)", "1"},
               {"1 + angle", "rad"},
               {"0.5 mass*(rod.length*rate)^2", "J"},
               {"abs(mass)", "kg"},
               {"max(rod.length, 0)", "m"},  // nothing is of any kind
               {"max(0, 2 rod.length)", "m"},
               {"where(mass > 0, rod.length, 0)", "m"},
               {"where(0 < t, 0, rod.length)", "m"},
               {"0 - mass + 0", "kg"},
               {"rod.length + max(0, 0)", "m"},
               {"rod.length + where(1, 0, 0)", "m"},
               {"rod.length*t^-2", "m/s^2"}};
  for (const auto& c : cases) {
    Dimension expected = std::string_view(c.unit) == "N m/rad rad" ? dimensionOf("N m") : dimensionOf(c.unit);
    Dimension found = Expression::parse(c.text).dimension(unitFor);
    if (expected.mass != 0) found.angle = expected.angle;  // beside other units radians are only for display
    EXPECT_EQ(unitOf(found), unitOf(expected)) << c.text;
  }
}

TEST(Expression, WhatDoesNotFitTogetherIsRefusedWithItsPlace) {
  const struct {
    const char *text, *message;
  } cases[] = {
      {"rod.length + mass", "adds kg to m at column 12; expected quantities of one kind"},
      {"rod.length - 3", "subtracts a number without unit from m at column 12"},
      {"rod.length - 0 s", "subtracts s from m at column 12"},
      {"max(rod.length, 0 + 0 mass)", "compares kg with m"},
      {"where(0, mass, mass) + rod.length", "adds m to kg"},
      {"sin(rod.length)", "a function of m at column 1"},
      {"sqrt(mass)", "the square root of kg at column 1"},
      {"2^mass", "an exponent in kg at column 2"},
      {"mass^0.5", "a power of kg at column 5"},
      {"where(mass > t, 1, 2)", "compares s with kg at column 12"},
      {"max(mass, t)", "compares s with kg at column 1"},
      {"3 m + 2 kg", "adds kg to m at column 5"},
      {"2 π + mass", "adds kg to a number without unit at column 5"},
  };
  for (const auto& c : cases) {
    try {
      Expression::parse(c.text).dimension(unitFor);
      ADD_FAILURE() << c.text;
    } catch (const UnitError& error) {
      EXPECT_THAT(error.what(), HasSubstr(c.message)) << c.text;
    }
  }
}

TEST(Expression, AWordIsANameWhereItIsKnownAsOneAndAUnitElsewhere) {
  const auto isName = [](std::string_view word) { return word == "T" || word == "mA" || word == "kg"; };
  EXPECT_EQ(unitOf(Expression::parse("3 V", isName).amount()->dimension), "V");
  EXPECT_EQ(unitOf(Expression::parse("0.05 N m/A", isName).amount()->dimension), "N m/A");
  EXPECT_THAT(Expression::parse("1 - exp(-t/T)", isName).names(), ::testing::ElementsAre("t", "T"));
  EXPECT_THAT(Expression::parse("2 mA + 3 A*T", isName).names(), ::testing::ElementsAre("mA", "T"));
  EXPECT_TRUE(Expression::parse("2 kg", isName).isConstant()) << "nothing else can be named so";
}

TEST(Expression, TheWholeMustBeOfTheKindThatIsExpected) {
  const auto check = [&](const char* text) { Expression::parse(text).check(unitFor, "m"); };
  EXPECT_NO_THROW(check("0.5"));
  EXPECT_NO_THROW(check("1/2*3"));
  EXPECT_NO_THROW(check("sqrt(2)"));
  EXPECT_NO_THROW(check("2 rod.length"));
  EXPECT_NO_THROW(check("rod.length*angle"));
  for (const char* text : {"2 kg", "mass", "12 %", "angle", "sin(angle)", "2 m^2"})
    EXPECT_THROW(check(text), UnitError);
}

TEST(Expression, WhatIsNoFormulaIsRefusedWithItsPlace) {
  const struct {
    const char *text, *message;
  } cases[] = {
      {"", "'' holds no number at column 1; expected"},
      {"  ", "holds no number"},
      {"m", "holds a unit but no number"},
      {"2 +", "the end after an operator at column 4"},
      {"2 *", "the end after an operator"},
      {"(2", "the end at column 3; expected ')'"},
      {"2)", "unexpected ')' at column 2"},
      {"a b", "no operator before 'b' at column 3; expected *, /, + or -, or single quotes about a name with blanks"},
      {"a 3", "unexpected '3' at column 3"},
      {"1,5", "unexpected ',' at column 2; expected a point before decimals, and no mark between thousands"},
      {"a**2", "a second '*' at column 3; expected '^' for a power"},
      {"2 m k", "no operator before 'k' at column 5"},
      {"2 kg m2", "no operator before 'm2' at column 6; expected 'm^2'"},
      {"2 m(3)", "unexpected '(' at column 4"},
      {"(a) b", "no operator before 'b'"},
      {"sine(2)",
       "unknown function 'sine' at column 1; expected 'sin'? (one of: sqrt, exp, log, sin, cos, tan, asin, acos, "
       "atan, sinh, cosh, tanh, abs, sign, where, atan2, hypot, min, max)"},
      {"if(a > 1, 1, 2)", "unknown function 'if' at column 1; expected 'where'? (one of: sqrt"},
      {"sgn(a)", "unknown function 'sgn' at column 1; expected 'sign'? (one of: sqrt"},
      {"ln(a)", "unknown function 'ln' at column 1; expected 'log'? (one of: sqrt"},
      {"arcsin(a)", "unknown function 'arcsin' at column 1; expected 'asin'? (one of: sqrt"},
      {"gamma(a)", "unknown function 'gamma' at column 1; expected one of: sqrt"},
      {"sin(1, 2)", "',' at column 6; expected ')': sin takes one number"},
      {"atan2(1)", "')' at column 8; expected ',': atan2 takes two numbers"},
      {"where(a == b, 1, 2)", "'=' at column 9; expected a comparison by >, >=, < or <="},
      {"where(a != b, 1, 2)", "'!' at column 9; expected a comparison by >, >=, < or <="},
      {"where(a > b > 1, 1, 2)", "a second condition at column 13; expected one; where(a, where(b, x, y), y) is"},
      {"where(a > 1 && b > 1, 1, 2)", "a second condition at column 13"},
      {"2 > 1", "a comparison by '>' at column 3; expected one as the first of where(condition, a, b)"},
      {"3*(t > 1)", "a comparison by '>' at column 6"},
      {"where(1, 2)", "')' at column 11; expected ',': where takes a condition and two numbers"},
      {"1/0", "a division by zero at column 2"},
      {"1/(2-2)", "a division by zero"},
      {"0^-1", "a division by zero"},
      {"1e999", "too large or too small"},
      {"1e99999999999999999999", "too large or too small"},
      {"10^1000", "too large or too small"},
      {".", "a point without digits"},
      {"2 $ 3", "unexpected '$' at column 3"},
      {"2 m € 3", "no operator before '€' at column 5"},
      {"''", "a quotation mark without a name"},
      {"'a", "a quotation mark without a name"},
      {"5 % %", "more than one '%'"},
  };
  for (const auto& c : cases) {
    try {
      Expression::parse(c.text);
      ADD_FAILURE() << c.text;
    } catch (const UnitError& error) {
      EXPECT_THAT(error.what(), HasSubstr(c.message)) << c.text;
      EXPECT_THAT(error.what(), HasSubstr("; expected ")) << c.text;
    }
  }
  EXPECT_THROW(Expression::parse(std::string(9000, '(')), UnitError);
  EXPECT_THROW(Expression::parse("2" + std::string(9000, '^')), UnitError);
  std::string powers = "2";
  for (int i = 0; i < 4000; ++i) powers += "^1";
  EXPECT_THROW(Expression::parse(powers), UnitError);
  EXPECT_EQ(value(std::string(9000, '-') + "2"), 2);
  EXPECT_EQ(value(std::string(9999, ' ') + "2"), 2);
  EXPECT_THROW(Expression::parse(std::string(10000, ' ') + "2"), UnitError);
}

TEST(Expression, OneFormulaServesEveryScalar) {
  const Expression formula = Expression::parse("0.3 * sin(2*pi*t) + sqrt(x^2 + 1)/max(x, 2) - x^3 + atan2(x, 3)^1.5");
  const auto plain = [&](double t, double x) {
    return formula.evaluate<double>([&](const std::string& name) { return name == "t" ? t : x; });
  };
  const Interval t(0.25, 0.3), x(1, 1.25);
  const Interval range = formula.evaluate<Interval>([&](const std::string& name) { return name == "t" ? t : x; });
  const Fuzzy fuzzy = formula.evaluate<Fuzzy>([&](const std::string& name) { return Fuzzy(name == "t" ? t : x); });
  const Program program = record(1, 0, [&](auto time, const auto& state, const auto&, auto& out) {
    out[0] = formula.evaluate<Recorded>([&](const std::string& name) { return name == "t" ? time : state[0]; });
  });
  Evaluator<double> recorded(program);
  for (double a : {0.25, 0.28, 0.3})
    for (double b : {1.0, 1.1, 1.25}) {
      EXPECT_TRUE(contains(range, plain(a, b)));
      EXPECT_TRUE(contains(fuzzy.cut(0), plain(a, b)));
      EXPECT_NEAR(recorded(a, std::vector{b})[0], plain(a, b), 1e-14);
      const Samples samples =
          formula.evaluate<Samples>([&](const std::string& name) { return Samples(name == "t" ? a : b); });
      EXPECT_NEAR(samples[0], plain(a, b), 1e-14);
    }
}

}  // namespace
}  // namespace gamut
