// The page as text: nothing from elsewhere, nothing unescaped, guaranteed numbers outward, whatever is missing.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/description/units.hpp"
#include "reports/drawing/screen.hpp"
#include "reports/report.hpp"
#include "reports/sections/contribution.hpp"
#include "scalars/interval.hpp"
#include "studies/analyses/equilibria.hpp"
#include "studies/analyses/modes.hpp"
#include "studies/analyses/postures.hpp"
#include "studies/analyses/workspace.hpp"
#include "studies/words.hpp"
#include "tests/reports/example_results.hpp"
#include "tests/reports/page_text.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// The page without the library's banner, which names its home in a comment.
std::string withoutBanner(std::string page) {
  const auto from = page.find("/*! https://github.com/leeoniya/uPlot "), to = page.find("*/", from);
  return from == std::string::npos ? page : page.erase(from, to - from);
}

TEST(Report, RefersToNothingOutsideItself) {
  const std::string page = withoutBanner(renderReport(example::pendulum()));
  EXPECT_THAT(page, AllOf(Not(HasSubstr("http://")), Not(HasSubstr("https://")), Not(HasSubstr("@import")),
                          Not(HasSubstr("<link"))));
  EXPECT_EQ(count(page, "url("), count(page, "url(#"));  // of the page itself
  EXPECT_THAT(page, AllOf(Not(HasSubstr("<script src")), Not(HasSubstr("<img"))));
  EXPECT_EQ(count(page, " href="), count(page, " href=\"#"));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
}

/// However many outputs, times, quantities and words there are.
/// What is conserved has wide bounds and tells little: what moves leads, where anything does.
TEST(Report, LeadsWithWhatMoves) {
  Results results = example::pendulum();
  results.stochastic = {};
  results.fuzzy = {};
  results.comparison = {};
  const auto hold = [&](std::size_t output) {
    for (Bounds* bounds : {&results.interval.at, &results.interval.over})
      for (std::size_t i = 0; i < bounds->lower.times; ++i) bounds->lower(i, output) = 1, bounds->upper(i, output) = 2;
  };
  hold(0);
  EXPECT_THAT(renderReport(results), HasSubstr("\u201c" + results.outputs[1].name + "\u201d stays between"));
  for (std::size_t output = 1; output < results.outputs.size(); ++output) hold(output);
  EXPECT_THAT(renderReport(results), HasSubstr("\u201d stays between 1.000 and 2.000 rad"));
}

/// Of what nothing uncertain moves the page has no digits that rounding made.
TEST(Report, ListsWhatIsFoundBesideTheAnswers) {
  Results results = example::pendulum();
  EXPECT_THAT(renderReport(results), Not(HasSubstr("Also proved")));
  EquilibriaResult& found = results.of<EquilibriaResult>();
  found.present = found.isComplete = true;
  found.coordinates = "slide<1>.displacement, hinge.angle";
  found.coordinate = {1, 2};
  found.number = {1};
  found.lower = Grid({1, 2}, {-0.5, 0.25});
  found.upper = Grid({1, 2}, {-0.25, 0.25});
  found.stability = {-1};
  EXPECT_THAT(
      renderReport(results),
      AllOf(HasSubstr("<h3>Also proved: equilibria</h3>"), HasSubstr("<li>1 position in the region, and no other"),
            HasSubstr("<li>unstable: slide&lt;1&gt;.displacement in [-0.5, -0.25], hinge.angle in [0.25, 0.25]")));
}

/// That samples lie within what is guaranteed says nothing of the mechanism.
TEST(Report, TellsACheckOfItselfFromRequirements) {
  const std::string page = renderReport(example::pendulum());
  EXPECT_THAT(page, AllOf(HasSubstr("<a class=\"chip none\" href=\"#asked\">no requirement is stated</a>"),
                          HasSubstr("\">self-check of the computation: all "),
                          HasSubstr("<b class=\"word\">self-check passed</b>")));
}

TEST(Report, HasAColumnForEachShape) {
  Results results = example::pendulum();
  EXPECT_THAT(renderReport(results), Not(HasSubstr("<h2>Modes</h2>")));
  ModesResult& found = results.of<ModesResult>();
  found.present = true;
  found.coordinates = "slide<1>.displacement, hinge.angle";
  found.coordinate = {1, 2};
  found.number = {1, 2};
  found.mode = {1, 2};
  found.first = {1, 2};
  found.last = {1, 3};
  found.reference = {2, 1};
  found.slowest = {0.5, 2};
  found.fastest = {0.75, 2.5};
  found.lower = Grid({2, 2}, {-0.5, 1, 1, 0.125});
  found.upper = Grid({2, 2}, {-0.25, 1, 1, 0.25});
  found.imaginaryLower = Grid({2, 2}, {0, 0, 0, -0.5});
  found.imaginaryUpper = Grid({2, 2}, {0, 0, 0, 0.5});
  const std::string page = renderReport(results);
  EXPECT_THAT(page, AllOf(HasSubstr("<h2>Modes</h2>"), HasSubstr("mode 1, [0.5, 0.75] Hz"),
                          HasSubstr("mode 2 of 2 to 3, which are not told apart, [2, 2.5] Hz"),
                          HasSubstr("slide&lt;1&gt;.displacement"), HasSubstr("[-0.5, -0.25]"),
                          HasSubstr("[0.125, 0.25] + [-0.5, 0.5] i")));
}

TEST(Report, TellsOfPostures) {
  Results results = example::pendulum();
  PosturesResult& found = results.of<PosturesResult>();
  found.present = true;
  found.goal = "tool<1> at target";
  found.coordinates = "slide.displacement, hinge.angle";
  found.coordinate = {1, 2};
  found.number = {1, 2};
  found.lower = Grid({2, 2}, {-0.5, 0.25, 0, 1});
  found.upper = Grid({2, 2}, {-0.25, 0.25, 0, 1.5});
  found.always = {1, 0};
  EXPECT_THAT(
      renderReport(results),
      AllOf(HasSubstr("<h3>Also proved: postures</h3>"),
            HasSubstr("<li>tool&lt;1&gt; at target: 2 postures in the region, and no other, but not for all values"),
            HasSubstr("<li>1: slide.displacement in [-0.5, -0.25], hinge.angle in [0.25, 0.25]"),
            HasSubstr("<li>2, for some values: slide.displacement in [0, 0], hinge.angle in [1, 1.5]")));
}

TEST(Report, DrawsTheMapOfAWorkspace) {
  Results results = example::pendulum();
  EXPECT_THAT(renderReport(results), Not(HasSubstr("<h2>Workspace</h2>")));
  WorkspaceResult& found = results.of<WorkspaceResult>();
  found.present = true;
  found.first = "x<1>";
  found.second = "y";
  found.firstUnit = found.secondUnit = "m";
  found.from = {0, 1, 2};
  found.to = {1, 2, 3};
  found.besideFrom = {0, 1};
  found.besideTo = {1, 2};
  found.reached = Grid({3, 2}, {1, 0, 1, -1, -1, -1});
  found.least = 2;
  found.most = 3;
  const std::string page = renderReport(results);
  EXPECT_THAT(page,
              AllOf(HasSubstr("<h2>Workspace</h2>"), HasSubstr("aria-label=\"Map of what x&lt;1&gt; and y can reach\""),
                    HasSubstr("x&lt;1&gt; and y: 2 m² are reached for all values at least, 3 m² for any at most"),
                    HasSubstr("of 6 cells: 2 reached, 3 not reached, 1 not settled")));
  // One run of two cells that are reached, and one cell that is not settled.
  const auto pathOf = [&](const std::string& kind) {
    const std::size_t at = page.find("<path class=\"" + kind + "\"");
    return page.substr(at, page.find("/>", at) - at);
  };
  EXPECT_EQ(std::ranges::count(pathOf("reach-always"), 'M'), 1);
  EXPECT_EQ(std::ranges::count(pathOf("reach-open"), 'M'), 1);
  found.second.clear();
  found.besideFrom = {0};
  found.besideTo = {1};
  found.reached = Grid({3, 1}, {1, 0, -1});
  EXPECT_THAT(renderReport(results),
              HasSubstr("x&lt;1&gt;: 2 m are reached for all values at least, 3 m for any at most"));
}

TEST(Report, HasNoDigitsOfRounding) {
  Results results = example::pendulum();
  const std::size_t last = results.time.size() - 1;
  for (Bounds* bounds : {&results.interval.at, &results.stochastic.envelope})
    bounds->lower(last, 1) = -3.662e-16, bounds->upper(last, 1) = 2.682e-16;
  for (Bounds& bounds : results.fuzzy.outer) bounds.lower(last, 1) = -3.662e-16, bounds.upper(last, 1) = 2.682e-16;
  EXPECT_THAT(renderReport(results), AllOf(HasSubstr("[about 0, about 0]"), Not(HasSubstr("[-3.662e-16"))));
}

TEST(Report, StaysSmall) {
  struct Size {
    std::size_t times, outputs, levels, quantities;
  };
  for (const Size& size : {Size{301, 310, 11, 1}, {5, 20000, 3, 1}, {20001, 20, 11, 1}, {11, 3, 11, 30000}}) {
    SCOPED_TRACE(size.outputs);
    Results results = example::pendulum(size.times, size.outputs, size.levels);
    results.uncertain.resize(size.quantities, results.uncertain[0]);
    results.studyText.assign(30000000, '=');
    const std::string page = renderReport(results);
    EXPECT_LT(page.size(), 10000000u);
    EXPECT_EQ(count(page, " are not shown here, so that the page stays small"), size.outputs > 60 ? 1u : 0u);
    EXPECT_LE(count(page, "<section class=\"output\""), 60u);
    EXPECT_EQ(count(page, "<section class=\"output foremost\""), 1u);
    const auto foremost = page.find("data-output=\"") + 13;
    const std::string output = page.substr(foremost, page.find('"', foremost) - foremost);
    EXPECT_EQ(count(page, "data-output=\"" + output + "\""), 2u) << "the foremost plot needs its output's numbers";
  }
}

/// Of outputs that find no room in sight there are drawings, which a browser makes when they are unfolded.
TEST(Report, FoldsDrawingsOfFurtherOutputs) {
  const Results results = example::pendulum(2001, 310, 11);
  const std::string page = renderReport(results);
  EXPECT_LT(page.size(), 10000000u);
  EXPECT_EQ(count(page, "<details class=\"more folded\">"), 250u);
  EXPECT_EQ(count(page, "<section class=\"output\""), 60u);
  EXPECT_EQ(count(renderReport(example::pendulum(301, 8)), "<details class=\"more folded\">"), 0u);
  const std::string many = renderReport(example::pendulum(11, 3000, 3));  // no more than find room
  EXPECT_LT(many.size(), 10000000u);
  EXPECT_EQ(count(many, "<details class=\"more folded\">"), 320u);
}

TEST(Report, ShowsEverythingOfFewOutputs) {
  const std::string page = renderReport(example::pendulum(301, 8));
  EXPECT_EQ(count(page, "<section class=\"output\""), 8u);
  EXPECT_EQ(count(page, "<figure class=\"membership kept\""), 8u * 13u);
  EXPECT_THAT(page, Not(HasSubstr("so that the page stays small")));
}

TEST(Report, ShowsTheWorstOfManyRequirements) {
  Results results = example::pendulum();
  for (int i = 0; i < 5000; ++i) {
    RequirementResult& requirement = results.requirements.emplace_back();
    requirement.name = "requirement " + std::to_string(i) + ".";
    requirement.statement = "always a > 1 m";
    requirement.word = i == 4321 ? Decision::partly : i % 1000 == 999 ? Decision::open : Decision::met;
    requirement.violation.assign(results.uncertain.size(), std::nan(""));
  }
  const std::string page = renderReport(results);
  EXPECT_EQ(count(page, "<article class=\"requirement "), 200u);
  EXPECT_EQ(count(page, "and 4800 more in the results file"), 1u);
  for (const char* shown : {"requirement 4321.", "requirement 999.", "requirement 4999.", "requirement 0."})
    EXPECT_THAT(page, HasSubstr(shown));
  EXPECT_THAT(page, Not(HasSubstr("requirement 3000.")));
  results.requirements.resize(200);
  EXPECT_EQ(count(renderReport(results), "more in the results file"), 0u);
}

TEST(Report, CarriesThePlottingLibraryAndItsLicence) {
  EXPECT_THAT(renderReport(example::pendulum()),
              AllOf(HasSubstr("var uPlot="), HasSubstr("Permission is hereby granted, free of charge")));
}

TEST(Report, EscapesEverythingAPersonWrote) {
  const std::string attack = "</script></pre><script>alert(1)</script>'\"&{{word}}";
  Results results = example::pendulum();
  const std::size_t scripts = count(renderReport(results), "<script");
  results.title = results.studyText = results.studyFile = results.host = results.version = results.date = attack;
  results.analysis = results.interval.why = attack;
  results.interval.reached = 2;
  results.libraries = {{attack, attack}};
  results.uncertain[0] = {attack, attack, attack, 1, 2, 3, attack, attack};
  for (OutputInfo& output : results.outputs) output = {attack, attack, attack};
  results.comparison.disputed.push_back({});
  results.comparison.disputed.back().farthest.assign(results.outputs.size(), 0.0);
  const std::string page = renderReport(results);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_EQ(count(page, "<script"), scripts);
  EXPECT_EQ(count(page, "</script"), scripts);
  EXPECT_EQ(count(page, "</pre"), 1u);
  EXPECT_THAT(page, HasSubstr("&lt;/script&gt;"));
}

TEST(Report, PrintsTheIntervalOfAQuantityOutwardOrAsAStudyStatesIt) {
  Results results = example::pendulum(2, 1);
  UncertainInfo& quantity = results.uncertain[0];
  const auto [lower, upper] = std::pair(std::nextafter(0.795, 0.0), std::nextafter(0.805, 1.0));
  quantity.lower = Interval("0.795").lower();
  quantity.upper = Interval("0.805").upper();
  EXPECT_THAT(renderReport(results), HasSubstr("<td>[0.795, 0.805]</td>"));
  quantity.lower = std::min(lower, std::nextafter(quantity.lower, 0.0));  // as 0.8 ± 0.005 is enclosed
  quantity.upper = std::max(upper, std::nextafter(quantity.upper, 1.0));
  EXPECT_THAT(renderReport(results), HasSubstr("<td>[0.795, 0.805]</td>"));
  quantity.lower = 0.795 * (1 - 1e-13);
  quantity.upper = 0.805 * (1 + 1e-13);
  EXPECT_THAT(renderReport(results), HasSubstr("<td>[0.794999, 0.805001]</td>"));
  quantity.lower = 1.0 / 3;
  quantity.upper = 2.0 / 3;
  EXPECT_THAT(renderReport(results), HasSubstr("<td>[0.333333, 0.666667]</td>"));
}

TEST(Report, TellsQuantitiesInTheUnitsThatTheStudyStates) {
  Results results = example::pendulum(2, 1);
  UncertainInfo& quantity = results.uncertain[0];
  const Interval range = enclose(parseAmount("135 deg")) * Interval("[0.99, 1.01]");
  quantity.lower = range.lower();
  quantity.nominal = nearest(parseAmount("135 deg"));
  quantity.upper = range.upper();
  quantity.told = "deg";
  RequirementResult requirement;
  requirement.name = requirement.statement = "limit";
  requirement.word = Decision::partly;
  requirement.violation = {nearest(parseAmount("134.71312 deg"))};
  results.requirements.push_back(requirement);
  EXPECT_THAT(renderReport(results),
              ::testing::AllOf(HasSubstr("<td>shoulder.angle (deg)</td><td>[133.65, 136.35]</td><td>135</td>"),
                               HasSubstr("first angle 134.7131 deg"), Not(HasSubstr("2.35"))));
}

TEST(Report, ShowsQuantitiesAsTheStudyStatesThem) {
  Results results = example::pendulum(2, 1);
  EXPECT_THAT(renderReport(results), Not(HasSubstr("as stated")));  // of an older file
  results.uncertain[0].stated = "± <1> %";
  for (const auto& [kind, top] : {std::pair(ShapeKind::distribution, "mode"), {ShapeKind::membership, "apex"}})
    for (const auto& [name, value] : {std::pair("lower", 2.2777), {"upper", 2.3223}, {top, 2.3}})
      results.shapes.push_back({"first angle", kind, name, value, "rad"});
  EXPECT_THAT(renderReport(results),
              ::testing::AllOf(HasSubstr("<th scope=\"col\">as stated</th>"), HasSubstr("<td>± &lt;1&gt; %</td>"),
                               HasSubstr("class=\"shape-distribution\""), HasSubstr("class=\"shape-membership\"")));
}

TEST(Report, SaysHowManySamplesTheResultsHoldOneByOne) {
  Results results = example::pendulum(2, 1);
  results.stochastic.kept = {true, 4e6, 1, 18, {}, {}, {}, {}};
  EXPECT_THAT(renderReport(results), HasSubstr("; in the results: values of all, motions of one in 18</td>"));
}

TEST(Report, PrintsGuaranteedBoundsOutwardInItsTable) {
  Results results = example::pendulum(2, 1);
  results.interval.at.lower(1, 0) = -1.23412;
  results.interval.at.upper(1, 0) = 7.65432;
  results.stochastic.envelope.lower(1, 0) = results.stochastic.envelope.upper(1, 0) = 1;
  EXPECT_THAT(renderReport(results), HasSubstr("<td>[-1.235, 7.655]</td>"));
}

/// All cells of a row have the decimals of the widest, zeros at their ends too.
TEST(Report, PrintsBoundsOfOneOutputWithTheSameDecimals) {
  Results results = example::pendulum(2, 1);
  results.interval.at.lower(1, 0) = -1.3446;
  results.interval.at.upper(1, 0) = -1.08207;
  results.stochastic.envelope.lower(1, 0) = -1.30004;
  results.stochastic.envelope.upper(1, 0) = -1.3;
  EXPECT_THAT(renderReport(results), ::testing::AllOf(HasSubstr("<td>[about -1.3446, -1.0820]</td>"),
                                                      HasSubstr("<td>[-1.3001, -1.3000]</td>")));
}

/// A drawing shows the bounds between output times too: what is said instead says which are meant.
TEST(Report, SaysInDrawingsOfWhichTimesBoundsAre) {
  Results results = example::pendulum(3, 1);
  for (std::size_t i = 0; i < 3; ++i) results.interval.at.lower(i, 0) = 3.777e-87;
  for (std::size_t i = 0; i < 3; ++i) results.interval.at.upper(i, 0) = 0.05001;
  EXPECT_THAT(renderReport(results),
              ::testing::AllOf(HasSubstr(", at the output times guaranteed within [0.00000, 0.05001] rad"),
                               Not(HasSubstr("e-87"))));
}

/// Its two ends, the bounds of which are 0 and 1, would be drawn as a square.
TEST(Report, DrawsNoDistributionOfWhatIsOneValueButForRoundings) {
  Results results = example::pendulum();
  DistributionResult& d = results.distribution;
  d.present = true;
  d.time = {3};
  d.point = {0, 1, 2};
  const double none = std::nan("");
  d.value = Grid({1, 2, 3}, {1, 1 + 1e-15, none, 0, 1, 2});
  d.lower = d.upper = d.sampled = Grid({1, 2, 3}, {0, 1, none, 0, 0.5, 1});
  d.gaps = Grid({1, 2}, {0, 0.5});
  d.excess = Grid({1, 2}, {0, 0});
  const std::string page = renderReport(results);
  EXPECT_THAT(page, HasSubstr("one value, to a billionth of the greatest, at 3 s"));
  EXPECT_THAT(page, Not(HasSubstr("Plot of the distribution function of " + results.outputs[0].name)));
  EXPECT_THAT(page, HasSubstr("Plot of the distribution function of " + results.outputs[1].name));
}

TEST(Report, CaptionsOfWhereNoTimePassesNameNone) {
  Results results = example::kinematics();
  DistributionResult& d = results.distribution;
  d.present = true;
  d.time = {0};
  d.point = {0, 1, 2};
  const double none = std::nan("");
  d.value = Grid({1, 2, 3}, {1, 1 + 1e-15, none, none, none, none});
  d.lower = d.upper = d.sampled = Grid({1, 2, 3}, {0, 1, none, none, none, none});
  d.gaps = Grid({1, 2}, {0, none});
  d.excess = Grid({1, 2}, {0, 0});
  const std::string page = renderReport(results);
  EXPECT_THAT(page, HasSubstr("one value, to a billionth of the greatest<"));
  EXPECT_THAT(page, HasSubstr("nothing is known<"));
}

/// Of what nothing uncertain moves a distribution, or a spread, would show roundings.
TEST(Report, HasNoCardsOfWhatNothingUncertainMoves) {
  Results results = example::pendulum();
  const auto cardsOf = [&](std::size_t output) {
    const std::string page = renderReport(results);
    return count(page, "<section class=\"card\">\n<h3>" + results.outputs[output].name + "</h3>");
  };
  ASSERT_GT(cardsOf(0), 1U);
  EXPECT_THAT(renderReport(results), HasSubstr("Plot of the spread around the middle of " + results.outputs[0].name));
  std::vector<Bounds*> all{&results.interval.at, &results.interval.over, &results.stochastic.envelope};
  for (std::vector<Bounds>* cuts : {&results.fuzzy.outer, &results.fuzzy.inner})
    for (Bounds& cut : *cuts) all.push_back(&cut);
  for (Bounds* bounds : all)
    for (std::size_t i = 0; i < bounds->lower.times; ++i) {
      bounds->lower(i, 0) = 0.1 * static_cast<double>(i);
      bounds->upper(i, 0) = bounds->lower(i, 0) + 1e-15;
    }
  for (Table& quantile : results.stochastic.quantiles)
    for (std::size_t i = 0; i < quantile.times; ++i) quantile(i, 0) = 0.1 * static_cast<double>(i);
  EXPECT_THAT(renderReport(results),
              Not(HasSubstr("Plot of the spread around the middle of " + results.outputs[0].name)));
  EXPECT_EQ(cardsOf(0), 0U);
  EXPECT_GT(cardsOf(1), 1U);
}

json plotNumbers(const Results& results) { return json::parse(plotData(plotOf(results, 0))); }

/// Whole numbers of a line, NaN where there is none.
std::vector<double> wholes(const json& line) {
  std::vector<double> numbers;
  double value = 0, slope = 0;
  bool isFirst = true;
  for (const json& change : line) {
    if (!change.is_null()) {
      if (!isFirst) slope += change.get<double>();
      value = isFirst ? change.get<double>() : value + slope;
      isFirst = false;
    }
    numbers.push_back(change.is_null() ? NAN : value);
  }
  return numbers;
}

/// The lines of one band of a layer, as the page shows them.
std::vector<std::vector<double>> linesOf(const json& output, const std::string& layer, std::size_t band = 0) {
  const Decimals decimals(output.at("scale").get<int>());
  const std::vector<double> middle = wholes(output.at("middle"));
  for (const json& one : output.at("layers")) {
    if (one.at("name") != layer) continue;
    std::vector<std::vector<double>> lines;
    for (const json& line : one.at("bands").at(band)) {
      std::vector<double>& numbers = lines.emplace_back(wholes(line));
      for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = decimals.value(numbers[i] + (std::isnan(middle[i]) ? 0 : middle[i]));
    }
    return lines;
  }
  throw std::logic_error("no layer " + layer);
}

TEST(PlotData, HoldsEveryBoundItRounds) {
  for (const double unit : {1e-9, 1.0, 1e9, 1e-280, 1e280}) {
    Results results = example::pendulum(301, 1);
    std::vector<Bounds*> all{&results.interval.at, &results.interval.over, &results.stochastic.envelope};
    for (Bounds& cut : results.fuzzy.outer) all.push_back(&cut);
    for (Bounds* bounds : all)
      for (Table* table : {&bounds->lower, &bounds->upper})
        for (double& number : table->data) number *= unit;
    for (Table& quantile : results.stochastic.quantiles)
      for (double& number : quantile.data) number *= unit;
    const json output = plotNumbers(results);
    const auto guaranteed = linesOf(output, "guaranteed"), widest = linesOf(output, "possible"),
               narrowest = linesOf(output, "possible", 5);
    for (std::size_t i = 0; i < 301; ++i) {
      EXPECT_LE(guaranteed[0][i], results.interval.at.lower(i, 0));
      EXPECT_GE(guaranteed[1][i], results.interval.at.upper(i, 0));
      EXPECT_NEAR(guaranteed[0][i] / unit, results.interval.at.lower(i, 0) / unit, 1e-5);
      EXPECT_LE(widest[0][i], results.fuzzy.outer[0].lower(i, 0));
      EXPECT_GE(narrowest[1][i], results.fuzzy.outer[10].upper(i, 0));
    }
  }
}

TEST(PlotData, HasNullWhereThereIsNoFiniteNumber) {
  Results results = example::pendulum(3, 1);
  results.interval.at.lower(1, 0) = std::numeric_limits<double>::quiet_NaN();
  results.interval.at.upper(2, 0) = std::numeric_limits<double>::infinity();
  const auto guaranteed = linesOf(plotNumbers(results), "guaranteed");
  EXPECT_TRUE(std::isnan(guaranteed[0][1]));
  EXPECT_TRUE(std::isnan(guaranteed[1][2]));
  EXPECT_LE(guaranteed[0][2], results.interval.at.lower(2, 0));
}

TEST(PlotData, IsThinnedWhereThereAreTooManyTimes) {
  const Plot plot = plotOf(example::pendulum(5001, 1, 2), 0);
  const json times = json::parse(timeData(plot)), output = json::parse(plotData(plot));
  EXPECT_LE(times.at("time").size(), plottedTimes);
  EXPECT_EQ(times.at("time").size(), linesOf(output, "guaranteed")[0].size());
  EXPECT_TRUE(output.at("around").is_array());
  EXPECT_TRUE(plotNumbers(example::pendulum(301, 1)).at("around").is_null());
}

TEST(Report, StaysUnderThreeMegabytesForSevenOutputs) {
  EXPECT_LT(renderReport(example::pendulum(301, 7, 11)).size(), 3'000'000u);
}

struct Absence {
  std::string name;
  std::function<void(Results&)> change;
  std::string missing;  ///< what the page then does not draw
};

void PrintTo(const Absence& absence, std::ostream* stream) { *stream << absence.name; }

class ReportWithout : public ::testing::TestWithParam<Absence> {};

TEST_P(ReportWithout, IsStillAPageThatDrawsTheRest) {
  Results results = example::pendulum();
  GetParam().change(results);
  const std::string page = renderReport(results);
  EXPECT_THAT(page, AllOf(HasSubstr("<svg"), HasSubstr("</html>")));
  if (!GetParam().missing.empty()) {
    EXPECT_THAT(page, Not(HasSubstr("class=\"" + GetParam().missing + "\"")));
  }
  for (const std::string number : {"nan", "inf"}) {
    for (const std::string before : {"M", "L", " ", "\"", "-"}) {
      for (const std::string after : {"L", "Z", " ", "\""}) EXPECT_THAT(page, Not(HasSubstr(before + number + after)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Report, ReportWithout,
    ::testing::Values(Absence{"Interval", [](Results& r) { r.interval = {}, r.comparison = {}; }, "guaranteed"},
                      Absence{"Stochastic", [](Results& r) { r.stochastic = {}, r.comparison = {}; }, "sampled"},
                      Absence{"Fuzzy", [](Results& r) { r.fuzzy = {}; }, "possible"},
                      Absence{"Median",
                              [](Results& r) { r.stochastic.probabilities.clear(), r.stochastic.quantiles.clear(); },
                              "median"},
                      Absence{"TheLastHalfOfTheEnclosure",
                              [](Results& r) {
                                for (std::size_t i = 30; i < 61; ++i) {
                                  r.interval.at.lower(i, 0) = r.interval.at.upper(i, 0) = NAN;
                                }
                                r.interval.reached = 1.4;
                              },
                              ""}),
    [](const auto& tested) { return tested.param.name; });

TEST(Report, SaysHowAlphaCutsAreMeantAndWhereSamplesLieInThem) {
  Results results = example::pendulum();
  Grid& gaps = results.fuzzy.transformation.gap = Grid({results.fuzzy.alpha.size(), results.outputs.size()});
  std::ranges::fill(gaps.data, 0.0123);
  results.stochastic.alphaPoints = 77;
  EXPECT_THAT(
      renderReport(results),
      AllOf(HasSubstr("placed by the extended transformation method after Hanss (2 corners and 77 points inside "
                      "the cuts); they leave 1.3 % of the widest proved cut at most."),
            HasSubstr("is the least of theirs (minimum t-norm), and no quantity restricts another.")));
  std::ranges::fill(gaps.data, 2.8e-14);
  EXPECT_THAT(renderReport(results), HasSubstr("inside the cuts); they reach the ends of every proved cut."));
}

TEST(Report, OfResultsWithoutAnythingIsStillAPage) {
  EXPECT_THAT(renderReport(Results{}), AllOf(HasSubstr("incomplete"), HasSubstr("</html>")));
}

TEST(Report, OfKinematicsDrawsBarsAndNeedsNoPlottingLibrary) {
  const std::string page = renderReport(example::kinematics());
  EXPECT_THAT(page, AllOf(HasSubstr("<rect class=\"direct\""), HasSubstr("<rect class=\"guaranteed\""),
                          HasSubstr("<rect class=\"sampled\""), HasSubstr("<rect class=\"probable\"")));
  EXPECT_EQ(count(page, "<rect class=\"possible\""), 22u);
  EXPECT_THAT(page, AllOf(Not(HasSubstr("var uPlot=")), Not(HasSubstr("output times")), Not(HasSubstr("darker"))));
}

/// No limit goes through the numbers of a bar, wherever it is; where there is no room, they stay.
TEST(Report, WritesTheNumbersOfBarsBesideLimits) {
  for (const double limit : {-1e3, -12.0, -8.0, -5.0, -2.0, 0.0, 3.0, 50.0}) {
    Results results = example::kinematics();
    RequirementResult& requirement = results.requirements.emplace_back();
    requirement.name = "limit";
    requirement.statement = "always a > 0";
    requirement.margin = requirement.margins = 1;
    requirement.violation.assign(results.uncertain.size(), std::nan(""));
    results.margins = {{1, "a", true, "limit", "", true, 0, limit, true}};
    const std::string page = renderReport(results);
    double begin = 0, line = 0;
    const auto words = page.find("<text class=\"bar\" x=\""), path = page.find("<path class=\"limit\" d=\"M");
    ASSERT_TRUE(words != std::string::npos && path != std::string::npos) << limit;
    ASSERT_EQ(std::sscanf(page.c_str() + words, "<text class=\"bar\" x=\"%lf", &begin), 1);
    ASSERT_EQ(std::sscanf(page.c_str() + path, "<path class=\"limit\" d=\"M%lf", &line), 1);
    const auto open = page.find('>', words) + 1;
    const double width = 6.5 * static_cast<double>(page.find('<', open) - open);
    EXPECT_TRUE(line < begin - 4 || line > begin + width) << limit << ": " << begin << " " << line << " " << width;
    EXPECT_LT(begin + width, 720) << limit;
  }
}

TEST(Report, DescribesEveryDrawingInWords) {
  const std::string page = renderReport(example::pendulum());
  const std::size_t sparks = count(page, "<svg class=\"spark\" viewBox=\"0 0 96 22\" aria-hidden=\"true\">");
  EXPECT_EQ(count(page, "<svg ") - sparks, count(page, "role=\"img\" aria-label=\"Plot "));
  EXPECT_EQ(sparks, example::pendulum().outputs.size());
}

TEST(WrittenReport, ReplacesTheOldPageAndLeavesNothingBeside) {
  const TemporaryFolder folder;
  const std::string path = folder.write("report.html", "old");
  writeReport(example::pendulum(), path);
  EXPECT_EQ(folder.read("report.html"), renderReport(example::pendulum()));
  EXPECT_EQ(folder.count(), 1u);
}

TEST(WrittenReport, NamesThePathThatCannotBeWritten) {
  const TemporaryFolder folder;
  const std::string path = folder.path("nowhere/report.html");
  try {
    writeReport(example::pendulum(), path);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(path));
  }
}

/// Requirements lead the page and are words, not markup.
TEST(Report, BeginsWithRequirements) {
  Results results = example::pendulum();
  EXPECT_THAT(renderReport(results), Not(HasSubstr("class=\"requirements\"")));
  RequirementResult& requirement = results.requirements.emplace_back();
  requirement.name = "<b>clearance";
  requirement.statement = "always angle > 0";
  requirement.until = results.horizon;
  requirement.word = Decision::partly;
  requirement.factor = 0.98765;
  requirement.probabilityLower = 0.96841;
  requirement.probabilityUpper = 0.97019;
  requirement.violation.assign(results.uncertain.size(), 0.25);
  requirement.violationTime = 0.5;
  requirement.violationLower = -0.003;
  requirement.violationUpper = -0.001;
  const std::string page = renderReport(results);
  EXPECT_LT(page.find("class=\"requirements\""), page.find("class=\"verdict"));
  EXPECT_THAT(page,
              AllOf(HasSubstr("&lt;b&gt;clearance"), HasSubstr("violated for some values"),
                    HasSubstr("up to 98.7 % of what is stated"), HasSubstr("a probability of 0.0298 to 0.0316"),
                    HasSubstr("(short by 0.002"),
                    HasSubstr("<dt>It holds</dt><dd>if all tolerances shrink to 98.7&nbsp;% of what is stated</dd>")));
  EXPECT_THAT(page, HasSubstr("<h2 class=\"lead\">The requirement can be violated within the stated tolerances.</h2>"));
}

/// Two outputs with margins: the height's is met by far, the speed's is missed at the third of five output times.
Results withMargins() {
  Results results = example::pendulum();
  const std::size_t times = results.time.size(), first = results.outputs.size();
  for (const char* name : {"height", "speed"}) results.outputs.push_back({std::string("margin of ") + name, "", "m"});
  const auto widen = [&](Table& grid, double height, double speed) {
    Table wide(times, first + 2);
    for (std::size_t i = 0; i < times; ++i) {
      for (std::size_t k = 0; k < first; ++k) wide(i, k) = grid(i, k);
      wide(i, first) = height;
      wide(i, first + 1) = i == 2 ? speed : 1 + speed;
    }
    grid = wide;
  };
  widen(results.interval.at.lower, 2, -0.25);
  widen(results.interval.at.upper, 3, 0.75);
  results.interval.over = results.interval.at;
  results.stochastic = {};
  results.fuzzy = {};
  results.comparison = {};
  for (std::size_t r = 0; r < 2; ++r) {
    RequirementResult& requirement = results.requirements.emplace_back();
    requirement.name = r == 0 ? "height" : "speed";
    requirement.statement = "always a > 1 m";
    requirement.until = results.horizon;
    requirement.margin = first + r;
    requirement.word = r == 0 ? Decision::met : Decision::partly;
    requirement.violation.assign(results.uncertain.size(), std::nan(""));
    results.margins.push_back({.output = first + r, .what = "a", .limitText = "1 m", .limited = first + r});
  }
  return results;
}

/// Their margins where these are least: the guaranteed one ends left of zero where the requirement can be violated.
TEST(Report, ShowsRequirementsAsCardsTheWorstFirst) {
  const Results results = withMargins();
  const std::string page = renderReport(results), when = numberText(results.time[2], 6);
  const std::size_t speed = page.find("id=\"requirement-2\""), height = page.find("id=\"requirement-1\"");
  ASSERT_NE(height, std::string::npos);
  EXPECT_LT(speed, height);
  EXPECT_THAT(page, HasSubstr("aria-label=\"Bar of speed at " + when + " s: guaranteed (outline) -0.25 to 0.75 m\""));
  EXPECT_THAT(page, HasSubstr("Bar of height at 0 s: guaranteed (outline) 2.00 to 3.00 m\""));
  const auto numberBehind = [&](const std::string& text, std::size_t from) {
    return std::stod(page.substr(page.find(text, from) + text.size()));
  };
  const double zero = numberBehind("class=\"zero\" d=\"M", speed),
               left = numberBehind("class=\"mark-guaranteed\" x=\"", speed);
  EXPECT_LT(left, zero);
  EXPECT_NEAR((zero - left) / numberBehind("width=\"", page.find("class=\"mark-guaranteed\" x=\"", speed)), 0.25, 0.01);
  EXPECT_GT(numberBehind("class=\"mark-guaranteed\" x=\"", height), numberBehind("class=\"zero\" d=\"M", height));
  EXPECT_THAT(page, HasSubstr("<figure class=\"close\">"));
  Results ofOutputs = results;
  for (MarginInfo& margin : ofOutputs.margins) margin.limited = 0, margin.limit = 1;
  const std::string linked = renderReport(ofOutputs);
  EXPECT_THAT(linked, HasSubstr("<a href=\"#output-0\"><figure class=\"close\">"));
  EXPECT_THAT(linked, HasSubstr("id=\"output-0\""));
}

/// Every link leads to a place on the page.
TEST(Report, LinksToItsParts) {
  Results results = withMargins();
  const std::string page = renderReport(results);
  EXPECT_THAT(page, HasSubstr("<a class=\"chip violated\" href=\"#found\">1 of 2 can fail</a>"));
  const auto chip = [](const Results& of) {
    const std::string text = renderReport(of), begin = "<a class=\"chip violated\" href=\"#found\">";
    const auto from = text.find(begin) + begin.size();
    return text.substr(from, text.find('<', from) - from);
  };
  Results others = results;
  for (RequirementResult& requirement : others.requirements) requirement.word = Decision::violated;
  EXPECT_EQ(chip(others), "2 of 2 fail in every case");
  others.requirements[0].word = Decision::partly;
  EXPECT_EQ(chip(others), "2 of 2 can fail");
  others.requirements[0].word = Decision::met;
  EXPECT_EQ(chip(others), "1 of 2 fails in every case");
  others.requirements.resize(1);
  others.requirements[0].word = Decision::violated;
  EXPECT_EQ(chip(others), "fails in every case");
  others.requirements[0].word = Decision::partly;
  EXPECT_EQ(chip(others), "can fail");
  std::size_t links = 0;
  for (std::size_t at = 0; (at = page.find("href=\"#", at)) != std::string::npos; ++links) {
    at += 7;
    EXPECT_THAT(page, HasSubstr("id=\"" + page.substr(at, page.find('"', at) - at) + "\""));
  }
  EXPECT_GT(links, 5u);
  results.requirements.pop_back();
  EXPECT_THAT(renderReport(results), HasSubstr("<a class=\"chip met\" href=\"#found\">met in every case</a>"));
}

TEST(Report, TellsItsDateInWords) {
  Results results = example::pendulum();
  results.date = "2026-03-07T09:05:59Z";
  EXPECT_THAT(renderReport(results), HasSubstr(", 7 March 2026, 09:05 UTC</p>"));
  results.date = "yesterday";
  EXPECT_THAT(renderReport(results), HasSubstr(", yesterday</p>"));
}

}  // namespace
}  // namespace gamut
