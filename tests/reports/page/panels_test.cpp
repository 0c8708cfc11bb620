// The list of outputs: a row each, whatever is known, with its range, when, and how its requirement stands.
#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <string>

#include "reports/report.hpp"
#include "reports/sections/contribution.hpp"
#include "tests/reports/example_results.hpp"
#include "tests/reports/page_text.hpp"

namespace gamut::panels {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// The row of an output, its keys of order included.
std::string rowOf(const std::string& page, std::size_t output) {
  const auto id = page.find("id=\"output-" + std::to_string(output) + "\"");
  const auto begin = page.rfind("<section", id), end = page.find("</summary>", id);
  return id == std::string::npos ? "" : page.substr(begin, end - begin);
}

/// An output that is limited from above at its own middle, so that some values violate that at all times.
Results limited() {
  Results results = example::pendulum(61, 2);
  RequirementResult& requirement = results.requirements.emplace_back();
  requirement.name = "ceiling";
  requirement.statement = "always a < 1 rad";
  requirement.word = Decision::partly;
  requirement.margin = 1;
  requirement.margins = 1;
  requirement.from = 1;
  requirement.until = 2;
  requirement.violation.assign(results.uncertain.size(), std::nan(""));
  results.margins.push_back({1, "a", false, "1 rad", "rad", true, 0, 1, true});
  for (std::size_t i = 0; i < 61; ++i) {
    results.interval.at.lower(i, 1) = i == 30 ? -1 : 1;
    results.interval.over.lower(i, 1) = i == 30 || i == 31 ? -1 : 1;
  }
  return results;
}

TEST(Panels, HoldARowOfEachOutputThatUnfoldsWithoutAScript) {
  const Results results = example::pendulum(61, 3);
  const std::string page = renderReport(results);
  EXPECT_EQ(count(page, "<details class=\"panel\"><summary class=\"row\">"), 3u);
  EXPECT_EQ(count(page, "<svg class=\"spark\""), 3u);
  EXPECT_THAT(rowOf(page, 1),
              AllOf(HasSubstr("<h3>elbow angle</h3>"), HasSubstr("data-head=\"\">rad</span>"),
                    HasSubstr("data-least=\"-"), HasSubstr("data-peak=\""), Not(HasSubstr("data-state"))));
  EXPECT_THAT(rowOf(page, 1), HasSubstr("data-head=\"peak\">0 to 0.05 s</span>"));  // where it begins
}

/// Of a requirement whose margins are the outputs from the second on.
Results withMet(const std::string& statement, int margins) {
  Results results = example::pendulum(61, static_cast<std::size_t>(margins) + 1);
  RequirementResult& requirement = results.requirements.emplace_back();
  requirement.name = requirement.statement = statement;
  requirement.word = Decision::met;
  requirement.margin = 1;
  requirement.margins = margins;
  requirement.until = results.horizon;
  requirement.violation.assign(results.uncertain.size(), std::nan(""));
  return results;
}

/// Beyond an upper limit lies what is to the right of it, beyond a lower one what is to the left, as outputs do.
TEST(Cards, DrawMarginsAsTheirOutputsLie) {
  Results results = withMet("always a < 1 rad", 1);
  results.margins.push_back({1, "a", false, "1 rad", "rad", true, 0, 1, true});
  const auto number = [&](const std::string& shape, const std::string& name) {
    const std::string page = renderReport(results);
    const auto at = page.find("class=\"" + shape + "\"", page.find("<svg class=\"drawing margin\""));
    return at == std::string::npos ? NAN : std::stod(page.substr(page.find(name, at) + name.size()));
  };
  const double limit = number("zero", "d=\"M");
  EXPECT_NEAR(number("missed", "x=\""), limit, 0.1);
  EXPECT_NEAR(number("missed", "width=\""), 320 - limit, 0.1);
  const double left = number("mark-guaranteed", "x=\"");
  results.margins[0].isAbove = true;
  EXPECT_NEAR(number("zero", "d=\"M"), limit, 0.1);
  EXPECT_EQ(number("missed", "x=\""), 0);
  EXPECT_NEAR(number("missed", "width=\""), limit, 0.1);
  EXPECT_NEAR(number("mark-guaranteed", "x=\""), left, 0.1);
}

/// Of a requirement that names two, both, unless one is so far off that nothing else would be seen.
TEST(Cards, DrawBothLimits) {
  Results results = withMet("always -3 rad < a < 3 rad", 2);
  for (std::size_t i = 0; i < results.time.size(); ++i)
    results.interval.at.lower(i, 0) = -2.5, results.interval.at.upper(i, 0) = 2.5;
  const auto bar = [&](double low, double high) {
    results.margins = {{1, "a", true, "LOW", "rad", true, 0, low, true},
                       {2, "a", false, "HIGH", "rad", true, 0, high, true}};
    const std::string page = renderReport(results);
    const auto from = page.find("<svg class=\"drawing margin\"");
    return page.substr(from, page.find("</figcaption>", from) - from);
  };
  const auto limits = [](const std::string& text) {
    EXPECT_EQ(count(text, "class=\"missed\""), count(text, "class=\"zero\""));
    EXPECT_THAT(text, HasSubstr("; limits LOW and HIGH"));
    return count(text, "class=\"zero\"");
  };
  EXPECT_EQ(limits(bar(-3, 3)), 2u);
  EXPECT_EQ(limits(bar(-3, 300)) + limits(bar(-300, 3)), 3u);
}

TEST(Panels, TellHowTheRequirementOfAnOutputStands) {
  Results results = limited();
  EXPECT_THAT(rowOf(renderReport(results), 0),
              AllOf(HasSubstr("<b class=\"state marked violated\">can fail</b>"), HasSubstr("data-state=\"1\"")));
  results.requirements[0].word = Decision::open;
  EXPECT_THAT(rowOf(renderReport(results), 0), HasSubstr("<b class=\"state marked open\">not decided</b>"));
  results.requirements[0].isViolatedInSimulation = true;
  EXPECT_THAT(rowOf(renderReport(results), 0),
              HasSubstr("<b class=\"state marked simulated\">fails in simulation</b>"));
  results.requirements[0].isViolatedInSimulation = false;
  results.requirements[0].word = Decision::met;
  EXPECT_THAT(rowOf(renderReport(results), 0), HasSubstr("<b class=\"state marked met\">met</b>"));
  results.comparison.verdict = Agreement::outside;
  EXPECT_THAT(rowOf(renderReport(results), 0), HasSubstr("<b class=\"state\"></b>"));
}

TEST(Panels, SayThatNothingIsKnown) {
  Results results = example::pendulum(61, 1);
  results.interval = {};
  results.stochastic = {};
  results.fuzzy = {};
  results.comparison = {};
  const std::string page = renderReport(results);
  EXPECT_THAT(rowOf(page, 0),
              AllOf(HasSubstr("<h3>shoulder angle</h3>"), Not(HasSubstr("data-least=")), Not(HasSubstr("nan"))));
  EXPECT_THAT(page, HasSubstr("Nothing is known."));
}

/// Between output times where that is known; within the window; only where the requirement is not proved to be met.
TEST(Missed, IsWhereAMarginMayBeBelowZero) {
  Results results = limited();
  const auto missed = [&] { return plotOf(results, 0).missed; };
  ASSERT_EQ(missed().size(), 1u);
  EXPECT_EQ(missed()[0].from, results.time[29]);
  EXPECT_EQ(missed()[0].until, results.time[31]);
  results.interval.over = {};
  ASSERT_EQ(missed().size(), 1u);
  EXPECT_EQ(missed()[0].from, results.time[30]);
  EXPECT_EQ(missed()[0].until, results.time[30]);
  results.requirements[0].from = 1.6;
  EXPECT_TRUE(missed().empty());
  results = limited();
  results.requirements[0].word = Decision::met;
  EXPECT_TRUE(missed().empty());
  results.requirements[0].word = Decision::open;
  results.requirements[0].isAlways = false;
  EXPECT_TRUE(missed().empty());
}

}  // namespace
}  // namespace gamut::panels
