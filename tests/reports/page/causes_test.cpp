// What quantities alone do to an output, by a polynomial that is known, and how the page tells it.
#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "reports/report.hpp"
#include "studies/varied_alone.hpp"
#include "tests/reports/example_results.hpp"
#include "tests/reports/page_text.hpp"

namespace gamut::causes {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t row = 30;
constexpr double radius = 0.0625;

/// 1 + η/2 - ζ/4 + η²/8 ± 1/16 at one output time, of an output that is to stay above 0.75 and may not: η and ζ are -1
/// and 1 at the ends of the first and the second quantity; the third does nothing.
Results tilted() {
  Results results = example::pendulum(61, 2);
  results.uncertain = {{"first <angle>", "a", "rad", 2, 2.5, 3, "uniform", "triangular"},
                       {"mass", "m", "kg", 8, 9, 10, "uniform", "triangular"},
                       {"colour", "c", "m", 0, 1, 2, "uniform", "triangular"}};
  SurrogateResult& s = results.surrogate;
  s.present = true;
  s.part = {0};
  s.term = s.number = {0, 1, 2, 3};
  s.centre = {2.5, 9, 0};
  s.half = {0.5, 1, 0};
  s.row = {row};
  s.firstTerm = {0};
  s.partCentre = {0, 0, 0};
  s.partHalf = {1, 1, 1};
  s.exponent = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0};
  s.first = {0, 0};
  s.count = {4, 0};
  s.radius = {radius, std::numeric_limits<double>::quiet_NaN()};
  s.coefficient = {1, 0.5, -0.25, 0.125};
  RequirementResult& requirement = results.requirements.emplace_back();
  requirement.name = "floor";
  requirement.statement = "always a > 0.75";
  requirement.word = Decision::partly;
  requirement.margin = 1;
  requirement.until = results.horizon;
  requirement.violationTime = results.time[row];
  requirement.violation.assign(3, std::nan(""));
  results.margins.push_back({1, "a", true, "0.75 rad", "rad", true, 0, 0.75, true});
  return results;
}

void expectTight(const ProvedValue& value, double exact) {
  EXPECT_LE(value.lower, exact - radius);
  EXPECT_GE(value.upper, exact + radius);
  EXPECT_NEAR(value.lower, exact - radius, 1e-9);
  EXPECT_NEAR(value.upper, exact + radius, 1e-9);
}

TEST(VariedAlone, IsWhatThePolynomialIsAtTheEnds) {
  for (const std::size_t asked : {row, std::size_t{0}, std::size_t{60}}) {  // there is one time alone
    const AllVariedAlone all = variedAlone(tilted(), 0, asked);
    EXPECT_EQ(all.row, row);
    expectTight(all.nominal, 1);
    ASSERT_EQ(all.quantities.size(), 3u);
    expectTight(all.quantities[0].atLeast, 0.625);
    expectTight(all.quantities[0].atGreatest, 1.625);
    expectTight(all.quantities[1].atLeast, 1.25);
    expectTight(all.quantities[1].atGreatest, 0.75);
    expectTight(all.quantities[2].atLeast, 1);
    expectTight(all.quantities[2].atGreatest, 1);
    EXPECT_EQ(all.quantities[1].low(), all.quantities[1].atGreatest.lower);
    EXPECT_EQ(all.quantities[1].high(), all.quantities[1].atLeast.upper);
  }
}

/// No polynomial, none of this output, or numbers that make none.
TEST(VariedAlone, IsNotKnownWithoutPolynomials) {
  EXPECT_TRUE(variedAlone(tilted(), 1, row).quantities.empty());
  Results results = tilted();
  results.surrogate.exponent.clear();
  EXPECT_TRUE(variedAlone(results, 0, row).quantities.empty());
  results.surrogate = {};
  EXPECT_TRUE(variedAlone(results, 0, row).quantities.empty());
}

TEST(Causes, LeadWithTheQuantityThatMattersMost) {
  const std::string page = renderReport(tilted());
  const auto begin = page.find("<details class=\"causes\" open>"), end = page.find("</details>", begin);
  ASSERT_NE(begin, std::string::npos);
  const std::string told = page.substr(begin, end - begin);
  EXPECT_LT(told.find("first &lt;angle&gt;"), told.find("mass"));
  EXPECT_THAT(told,
              AllOf(HasSubstr("2 to 3 rad"), HasSubstr("8 to 10 kg"), HasSubstr("at 1.5 s"), Not(HasSubstr("nan"))));
  // From the nominal value, halves to both sides; the ground where the limit is missed lies left of it.
  const auto number = [&](const std::string& of, const std::string& name, std::size_t from) {
    const auto at = told.find(name + "=\"", told.find("class=\"" + of + "\"", from)) + name.size() + 2;
    return std::stod(told.substr(at));
  };
  const std::size_t mass = told.find(">mass<");
  const double unit = number("at-greatest", "width", 0) / 0.625;
  EXPECT_NEAR(number("at-least", "width", 0), 0.375 * unit, 0.2);
  EXPECT_NEAR(number("at-least", "x", 0) + number("at-least", "width", 0), number("at-greatest", "x", 0), 0.2);
  EXPECT_NEAR(number("at-greatest", "x", mass), number("at-least", "x", mass) - 0.25 * unit, 0.2);
  EXPECT_EQ(number("missed", "x", 0), 0);
  EXPECT_NEAR(number("missed", "width", 0), number("at-greatest", "x", mass), 0.2);  // 0.75 is the limit, too
}

/// Nominal values give one number, but for what the proof, or what varies in time, leaves open.
TEST(Causes, SayWhatIsOpenAtNominalValues) {
  Results results = tilted();
  EXPECT_THAT(renderReport(results),
              HasSubstr("lies between 0.9374 and 1.063 rad, as closely as its bounds are proved, "
                        "with nominal values"));
  results.uncertain[2].distribution = "varies in time";
  EXPECT_THAT(renderReport(results), HasSubstr(", as colour may vary in time, with nominal values"));
  results.surrogate.radius = {1e-3, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THAT(renderReport(results), HasSubstr(" is 1 rad with nominal values"));
}

TEST(Causes, SayWhichToleranceWouldDoAlone) {
  Results results = tilted();
  EXPECT_THAT(renderReport(results), Not(HasSubstr("not alone")));
  results.requirements[0].aloneLower = {0.501, 0, 0};
  results.requirements[0].aloneUpper = {0.51, 0, 1};
  const std::string page = renderReport(results);
  EXPECT_THAT(page, AllOf(HasSubstr("<b>± 10 % would do</b></li>"), HasSubstr("<b>not alone</b></li>"),
                          HasSubstr("<dt>It holds</dt><dd>if first &lt;angle&gt; alone shrinks from ±&nbsp;20&nbsp;% "
                                    "to ±&nbsp;10&nbsp;%</dd>")));
}

TEST(Causes, AreToldOfWhatCanFailAlone) {
  Results results = tilted();
  results.requirements[0].word = Decision::met;
  EXPECT_EQ(count(renderReport(results), "class=\"causes\""), 0u);
  results.requirements[0].word = Decision::open;
  EXPECT_EQ(count(renderReport(results), "class=\"causes\""), 1u);
  results.surrogate = {};
  EXPECT_EQ(count(renderReport(results), "class=\"causes\""), 0u);
}

}  // namespace
}  // namespace gamut::causes
