// Limits are found from the margins of requirements, and the first plot is of the output that is nearest to its limit.
#include "reports/sections/limits.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "reports/drawing/paper.hpp"
#include "reports/report.hpp"
#include "reports/verdict.hpp"
#include "studies/words.hpp"
#include "tests/reports/example_results.hpp"
#include "tests/reports/page_text.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Adds a requirement with one margin: sign * (output - limit).
void require(Results& results, const std::string& name, std::size_t output, int sign, double limit) {
  RequirementResult& requirement = results.requirements.emplace_back();
  requirement.name = name;
  requirement.statement = "always something";
  requirement.margin = results.outputs.size();
  requirement.until = results.horizon;
  requirement.violation.assign(results.uncertain.size(), std::nan(""));
  const std::string unit = results.outputs[output].unit;
  results.margins.push_back({.output = results.outputs.size(),
                             .what = results.outputs[output].name,
                             .isAbove = sign > 0,
                             .limitText = inUnit(numberText(limit, 6), unit),
                             .unit = unit,
                             .isStrict = true,
                             .limited = output,
                             .limit = limit,
                             .isNumber = true});
  results.outputs.push_back({name, "", unit});
  const std::size_t was = results.outputs.size() - 1;
  const auto widen = [&](Table& table) {
    if (table.empty()) return;
    Table wider(table.times, was + 1);
    for (std::size_t i = 0; i < table.times; ++i)
      for (std::size_t k = 0; k < was; ++k) wider(i, k) = table(i, k);
    table = wider;
  };
  const auto addMargin = [&](Bounds& bounds) {
    widen(bounds.lower);
    widen(bounds.upper);
    for (std::size_t i = 0; i < bounds.lower.times; ++i) {
      const double low = bounds.lower(i, output), high = bounds.upper(i, output);
      bounds.lower(i, was) = sign > 0 ? low - limit : limit - high;
      bounds.upper(i, was) = sign > 0 ? high - limit : limit - low;
    }
  };
  for (Bounds* bounds : {&results.interval.at, &results.interval.over, &results.stochastic.envelope})
    addMargin(*bounds);
  for (auto* cuts : {&results.fuzzy.outer, &results.fuzzy.inner})
    for (Bounds& cut : *cuts) addMargin(cut);
  for (Table* table : {&results.stochastic.mean, &results.stochastic.deviation, &results.stochastic.error,
                       &results.comparison.overestimation})
    widen(*table);
  for (Table& quantile : results.stochastic.quantiles) {
    widen(quantile);
    for (std::size_t i = 0; i < quantile.times; ++i) quantile(i, was) = sign * (quantile(i, output) - limit);
  }
  results.comparison.maximumOf.push_back(1.004);
}

/// A limit that is stated in another unit is said so beside the output's; of a number of degrees, as it is stated.
TEST(Limits, AreToldAsTheyAreStated) {
  Results results = example::pendulum(61, 2);
  require(results, "flat", 0, -1, 0.7853981633974483);
  EXPECT_THAT(renderReport(results), ::testing::AllOf(HasSubstr("limit 0.785398 rad"), Not(HasSubstr(" deg"))));
  MarginInfo& margin = results.margins[0];
  margin.limitText = "45 deg", margin.unit = "deg";
  EXPECT_THAT(renderReport(results), HasSubstr("limit 45 deg (0.785398 rad)"));
  margin.limitText = "90 deg";  // of twice the output
  EXPECT_THAT(renderReport(results), HasSubstr("limit 45 deg (0.785398 rad)"));
  margin.limitText = "785.398 mrad", margin.unit = "mrad";
  EXPECT_THAT(renderReport(results), HasSubstr("limit 785.398 mrad (0.785398 rad)"));
  margin.limit = 0, margin.limitText = "0 mrad";
  EXPECT_THAT(renderReport(results), HasSubstr(">limit 0 rad<"));
  results.outputs[0].unit = "1";
  margin.limit = 45, margin.limitText = "45 deg", margin.unit = "deg";
  EXPECT_THAT(renderReport(results), ::testing::AllOf(HasSubstr(">limit 45 deg<"), Not(HasSubstr("0.785398"))));
  margin.limitText = "90 deg";
  EXPECT_THAT(renderReport(results), HasSubstr(">limit 45<"));
}

/// The name of a limit stands at its end, unless a curve goes through there.
TEST(Limits, AreNamedWhereNoCurveIs) {
  Plot plot{"angle", "rad", {0, 1, 2, 3}, {}, {}};
  plot.layers.push_back({.name = "median", .kind = Layer::Kind::line, .bands = {{{0, 0, 0, 0}, {}}}});
  plot.layers.push_back(
      {.name = "limit", .kind = Layer::Kind::line, .bands = {{{9, 9, 9, 9}, {}}}, .labels = {"limit 9 rad"}});
  EXPECT_THAT(drawPlot(plot, ""), HasSubstr("class=\"end label\""));
  plot.layers[0].bands[0].lower = {0, 0, 4, 18};
  EXPECT_THAT(drawPlot(plot, ""), ::testing::AllOf(HasSubstr("class=\"label\""), Not(HasSubstr("end label"))));
}

/// However near each other limits are, their names in bars do not stand on one line.
TEST(Limits, OfBarsAreNamedBelowEachOther) {
  Plot plot{"length", "m", {0}, {}, {}};
  plot.layers.push_back({.name = "guaranteed", .bands = {{{2}, {3}}}});
  plot.layers.push_back({.name = "limit",
                         .kind = Layer::Kind::line,
                         .bands = {{{1}, {}}, {{1.01}, {}}},
                         .labels = {"limit 1 m", "limit 1.01 m"}});
  const std::string svg = drawBars(plot, "");
  const auto rowOf = [&](const std::string& name) {
    const std::size_t begin = svg.rfind("y=\"", svg.find(">" + name + "<"));
    return std::stod(svg.substr(begin + 3));
  };
  EXPECT_GE(rowOf("limit 1 m") - rowOf("limit 1.01 m"), 12);
  EXPECT_GE(rowOf("limit 1.01 m"), 20 + 6 + 13 + 14 + 11);                         // below the bar
  EXPECT_LT(svg.rfind("<path class=\"limit\""), svg.find("<text class=\"bar\""));  // which they do not strike through
}

TEST(Limits, AreThoseOfTheOutputsWhoseMarginsTheyMake) {
  Results results = example::pendulum(61, 2);
  require(results, "low", 0, 1, -2.5);
  require(results, "high", 1, -1, 4.25);
  const std::vector<Limit> limits = limitsOf(results);
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_EQ(limits[0].output, 0u);
  EXPECT_EQ(limits[0].value, -2.5);
  EXPECT_EQ(limits[1].output, 1u);
  EXPECT_EQ(limits[1].value, 4.25);
  EXPECT_TRUE(isMargin(results, 2));
  EXPECT_FALSE(isMargin(results, 1));
  results.margins[1].limited = 3, results.margins[1].limit = 0;  // of no output: the margin itself is bounded
  EXPECT_EQ(limitsOf(results)[1].output, 3u);
  EXPECT_EQ(limitsOf(results)[1].value, 0);
}

TEST(Limits, NearestIsThatWithTheLeastRoomInSharesOfItsVariation) {
  Results results = example::pendulum(61, 2);
  EXPECT_FALSE(nearestLimit(results));
  require(results, "far", 0, 1, -20);
  require(results, "near", 1, 1, -2.5);
  ASSERT_TRUE(nearestLimit(results));
  EXPECT_EQ(nearestLimit(results)->requirement, 1u);
  require(results, "violated", 0, -1, 1);
  EXPECT_EQ(nearestLimit(results)->requirement, 2u);
  results.requirements[2].isAlways = false;  // met sooner or later, with much room
  EXPECT_EQ(nearestLimit(results)->requirement, 1u);
}

/// What fails leads, however near others come to their limits; of what may fail, the likeliest.
TEST(Limits, NearestIsThatOfTheWorstRequirement) {
  Results results = example::pendulum(61, 2);
  require(results, "near", 1, 1, -2.5);
  require(results, "far", 0, 1, -20);
  EXPECT_THAT(worstFirst(results), ::testing::ElementsAre(0, 1));
  results.requirements[1].word = Decision::partly;
  EXPECT_THAT(worstFirst(results), ::testing::ElementsAre(1, 0));
  EXPECT_EQ(nearestLimit(results)->requirement, 1u);
  results.requirements[0].word = Decision::partly;
  results.requirements[0].probabilityLower = 0.5;
  results.requirements[1].probabilityLower = 0.75;
  EXPECT_THAT(worstFirst(results), ::testing::ElementsAre(0, 1));
  results.requirements[0].word = Decision::met;
  results.requirements[1].word = Decision::violated;
  EXPECT_THAT(worstFirst(results), ::testing::ElementsAre(1, 0));
  for (Bounds* bounds : {&results.interval.at, &results.interval.over})
    for (std::size_t i = 0; i < 61; ++i) bounds->lower(i, 3) = bounds->upper(i, 3) = std::nan("");
  EXPECT_FALSE(nearestOf(results, 1));
  EXPECT_THAT(worstFirst(results), ::testing::ElementsAre(1, 0));  // the worst news, though nothing more is known of it
  EXPECT_EQ(nearestLimit(results)->requirement, 0u);               // but there is nothing to draw
}

/// An output with bounds at some times alone leads only where no other is known at more.
TEST(Report, LeadsWithAnOutputThatIsKnownThroughout) {
  Results results = example::pendulum(61, 2);
  for (Bounds* bounds : {&results.interval.at, &results.interval.over})
    for (std::size_t i = 0; i < 61; ++i) {
      bounds->lower(i, 1) -= 1;
      bounds->upper(i, 1) += 1;
    }
  EXPECT_THAT(leadOf(results, judge(results)), HasSubstr("elbow angle"));
  results.interval.at.upper(40, 1) = results.interval.over.upper(40, 1) = INFINITY;
  EXPECT_THAT(leadOf(results, judge(results)), HasSubstr("shoulder angle"));
  results.interval.at.upper(40, 0) = results.interval.over.upper(40, 0) = INFINITY;
  EXPECT_THAT(leadOf(results, judge(results)), HasSubstr("elbow angle"));
}

TEST(Limits, AreDrawnInTheFirstPlotAndReplaceTheMarginsPlots) {
  Results results = example::pendulum(61, 2);
  require(results, "near", 1, 1, -2.5);
  const std::string page = renderReport(results);
  EXPECT_THAT(page, HasSubstr("elbow angle, and the limit of \u201cnear\u201d"));
  EXPECT_THAT(page, HasSubstr("limit -2.5 rad</text>"));
  EXPECT_EQ(count(page, "<section class=\"output\" data-output="), 2u);
  EXPECT_THAT(page, HasSubstr("margin of near (rad)"));
  EXPECT_THAT(page, HasSubstr("2 outputs"));
}

TEST(Report, RanksWhatToMeasureBetterFirst) {
  Results results = example::pendulum(61, 1);
  EXPECT_THAT(renderReport(results), Not(HasSubstr("What to measure better first")));
  results.uncertain.push_back(results.uncertain.front());
  results.uncertain.back().name = "mass";
  SensitivityResult& s = results.sensitivity;
  s.present = true;
  s.time = {1, 3};
  s.total.lower = Grid({2, 1, 2}, {0.9, 0.1, 0.2, 0.79});
  s.total.upper = Grid({2, 1, 2}, {0.9, 0.1, 0.21, 0.8});
  const std::string page = renderReport(results);
  EXPECT_THAT(page, HasSubstr("\u201cshoulder angle\u201d at 3 s"));
  EXPECT_LT(page.find("<span>mass</span>"), page.find("<span>first angle</span>"));
  EXPECT_THAT(page, HasSubstr("<b>80 %</b>"));
}

/// Beside a headline of one instant stand the shares of that instant.
TEST(Report, RanksWhereTheMarginIsLeast) {
  Results results = example::pendulum(61, 1);
  require(results, "near", 0, 1, -10);
  results.uncertain.push_back(results.uncertain.front());
  results.uncertain.back().name = "mass";
  for (RequirementResult& requirement : results.requirements) requirement.violation.resize(2, std::nan(""));
  SensitivityResult& s = results.sensitivity;
  s.present = true;
  s.time = {1, 3};
  s.total = BoundGrids({2, results.outputs.size(), 2});
  for (std::size_t at = 0; at < 2; ++at)
    for (std::size_t q = 0; q < 2; ++q) {
      const double share = at == q ? 0.8 : 0.2;  // the one at 1 s, the other at 3 s
      s.total.lower(at, 0, q) = s.total.upper(at, 0, q) = share;
    }
  for (const double time : {1.0, 3.0}) {
    results.requirements[0].word = Decision::partly;
    results.requirements[0].violationTime = time;
    const std::string page = renderReport(results);
    EXPECT_THAT(page, HasSubstr("\u201cshoulder angle\u201d at " + std::string(time == 1 ? "1 s" : "3 s")));
    EXPECT_EQ(page.find("<span>mass</span>") < page.find("<span>first angle</span>"), time == 3) << time;
  }
  results.requirements[0].violationTime = std::nan("");
  for (std::size_t i = 0; i < results.time.size(); ++i)
    results.interval.at.lower(i, results.requirements[0].margin) = std::abs(results.time[i] - 1.1);
  EXPECT_EQ(decisiveTime(results, results.requirements[0]), 1.1);
}

}  // namespace
}  // namespace gamut
