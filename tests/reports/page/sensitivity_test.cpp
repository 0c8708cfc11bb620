// What the page says of whose doing the spread is: what is proved, with estimates beside it, and what is folded away.
#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "reports/report.hpp"
#include "studies/analyses/derivatives.hpp"
#include "tests/reports/example_results.hpp"
#include "tests/reports/page_text.hpp"

namespace gamut {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// The section of this name; empty if the page has none.
std::string sectionOf(const Results& results, const std::string& name) {
  const std::string page = renderReport(results), begin = "<section class=\"", card = begin + "card\">";
  const auto from = page.find("\n" + begin + name + "\" id=\"" + name + "\">");
  if (from == std::string::npos) return "";
  auto to = from;
  do to = page.find("\n" + begin, to + 1);
  while (to != std::string::npos && page.compare(to + 1, card.size(), card) == 0);
  return page.substr(from, to - from);
}

std::string sensitivities(const Results& results) { return sectionOf(results, "sensitivities"); }

TEST(SensitivitySection, ShowsOneFigureAnOutputAndFoldsTheOthers) {
  std::string text = sensitivities(example::sensitive());
  EXPECT_EQ(count(text, "<section class=\"card\">"), 2u);
  for (const char* kind : {"total", "first", "derivative", "pinching", "influence"})
    EXPECT_EQ(count(text, "<figure class=\"kept " + std::string(kind) + "\">"), 2u) << kind;
  for (auto from = text.find("<details"); from != std::string::npos; from = text.find("<details"))
    text.erase(from, text.find("</details>", from) - from);
  EXPECT_EQ(count(text, "<figure"), 2u);
  EXPECT_EQ(count(text, "<figure class=\"kept total\">"), 2u);
  EXPECT_EQ(count(text, "class=\"keys\""), 1u);
}

TEST(SensitivitySection, HasEstimatesWithTheirIntervalsBesideWhatIsProved) {
  const std::string text = sensitivities(example::sensitive());
  EXPECT_EQ(count(text, "class=\"cause0 estimate\""), 4u);  // total and first-order index, two outputs
  EXPECT_THAT(text, AllOf(HasSubstr("0.6989 to 0.7010 (0.704 ± 0.020)"), HasSubstr("0.679 to 0.690 (0.685 ± 0.030)"),
                          HasSubstr("from 8192 independent samples")));
  Results results = example::sensitive();
  results.sensitivity.totalSampled = results.sensitivity.firstSampled = {};
  EXPECT_THAT(sensitivities(results), AllOf(Not(HasSubstr("estimate\"")), Not(HasSubstr("independent samples"))));
}

/// Violet is blue to those who see no green: what looks alike to some is dashed.
TEST(SensitivitySection, TellsQuantitiesApartWithoutColours) {
  Results results = example::sensitive();
  SensitivityResult& s = results.sensitivity;
  DerivativeResult& derivatives = results.of<DerivativeResult>();
  for (const char* name : {"third", "fourth"}) {
    results.uncertain.push_back(results.uncertain.back());
    results.uncertain.back().name = name;
  }
  for (Grid* grid :
       {&s.first.lower, &s.first.upper, &s.total.lower, &s.total.upper, &s.firstSampled, &s.totalSampled, &s.firstError,
        &s.totalError, &s.pinched, &results.fuzzy.influence.share, &derivatives.lower, &derivatives.upper}) {
    Grid wider({grid->extents[0], 2, 4});
    for (std::size_t i = 0; i < 2 * grid->extents[0]; ++i)
      for (std::size_t q = 0; q < 4; ++q) wider(i / 2, i % 2, q) = (*grid)(i / 2, i % 2, q % 2);
    *grid = wider;
  }
  const std::string page = renderReport(results);
  for (const char* solid : {"0", "1", "2"})
    EXPECT_EQ(
        count(page, std::string(".drawing .cause") + solid + "{stroke:var(--cause" + solid + ");stroke-width:1.4}"), 1u)
        << solid;
  EXPECT_EQ(count(page, ".drawing .cause3{stroke:var(--cause3);stroke-width:1.4;stroke-dasharray:"), 1u);
  EXPECT_EQ(count(page, ".swatch.cause3{background:var(--cause3-fill);border:1.5px dashed var(--cause3)}"), 1u);
}

TEST(SensitivitySection, RanksTheQuantitiesOverTime) {
  const std::string text = sensitivities(example::sensitive());
  EXPECT_THAT(text,
              HasSubstr("<figcaption>total Sobol’ indices at 7 times, joined by lines; the greatest: &lt;mass&gt; "
                        "at 57 %, first angle at 43 % of the times"));
  EXPECT_LT(text.find("<th scope=\"row\">&lt;mass&gt;"), text.find("<th scope=\"row\">first angle"));
}

/// Drawn as changes of the output, copied as they are; and how far they are known is told where it is not to the end.
TEST(SensitivitySection, DrawsDerivativesInTheOutputsUnit) {
  const std::string text = sensitivities(example::sensitive());
  EXPECT_THAT(text, AllOf(HasSubstr(">change (rad)<"), HasSubstr("derivative by first angle (rad per rad), from"),
                          HasSubstr("derivative by \\u003cmass> (rad per kg), from")));
  EXPECT_THAT(text, AllOf(HasSubstr("derivative (at 2 s)"), HasSubstr("2.09 to 2.8"), HasSubstr("rad per kg"),
                          HasSubstr("They are known up to 2 s: the work that limits.derivatives allows is done.")));
}

TEST(SensitivitySection, ShowsWhatIsKnownWhereTheOthersAreNot) {
  Results results = example::sensitive();
  results.sensitivity = {};
  results.of<DerivativeResult>() = {};
  const std::string text = sensitivities(results);
  EXPECT_EQ(count(text, "<figure class=\"kept influence\">"), 2u);
  EXPECT_THAT(text, AllOf(HasSubstr("<p class=\"hint\">Measure of influence"), Not(HasSubstr("Sobol"))));
  results.fuzzy.influence = {};
  EXPECT_EQ(sensitivities(results), "");
}

/// Bounds that say nothing are not drawn; what is estimated still is.
TEST(SensitivitySection, SaysWhyThereAreNoIndices) {
  Results results = example::sensitive();
  EXPECT_THAT(sensitivities(results), Not(HasSubstr("There are no")));
  results.sensitivity.why = "quantities depend on each other";
  EXPECT_THAT(sensitivities(results), HasSubstr("There are no Sobol’ indices: quantities depend on each other."));
}

TEST(SensitivitySection, DrawsEstimatesWhereNothingIsProved) {
  Results results = example::sensitive();
  for (double& x : results.sensitivity.total.lower.data) x = 0;
  for (double& x : results.sensitivity.total.upper.data) x = 1;
  const std::string text = sensitivities(results);
  EXPECT_THAT(text, HasSubstr("about 0.704 ± 0.020"));
  EXPECT_EQ(count(text, "<path class=\"cause0\""), 4u);  // first-order index and derivative, two outputs
}

TEST(SensitivitySection, IsATableWhereNothingMoves) {
  Results results = example::kinematics();
  SensitivityResult& s = results.sensitivity;
  s.present = true;
  s.time = {0};
  results.uncertain.push_back(results.uncertain[0]);
  s.total.lower = Grid({1, 2, 2}, {0.5, 0.7, 0.5, 0.7});
  s.total.upper = Grid({1, 2, 2}, {0.5, 0.8, 0.5, 0.8});
  s.first = s.total;
  const std::string text = sensitivities(results);
  EXPECT_THAT(text, AllOf(HasSubstr("<caption>All that is known</caption>"), HasSubstr("<td>0.69 to 0.81</td>"),
                          Not(HasSubstr("<svg")), Not(HasSubstr("<details class=\"more wide\""))));
}

TEST(SensitivitySection, HasNoDigitsOfHardlyAnyShare) {
  Results results = example::sensitive();
  SensitivityResult& s = results.sensitivity;
  const std::size_t quantities = results.uncertain.size(), behindStart = results.outputs.size() * quantities;
  for (std::size_t i = behindStart; i < s.total.lower.data.size(); i += quantities) {  // of the first quantity
    s.total.lower.data[i] = 0;
    s.total.upper.data[i] = 6.6e-30;
    s.totalSampled.data[i] = -0.000013;
    s.totalError.data[i] = 0.000085;
  }
  const std::string text = sensitivities(results);
  EXPECT_THAT(text, AllOf(HasSubstr("<td>less than 0.0001 (0.0000 ± 0.0001)</td>"), Not(HasSubstr("to 6.6"))));
}

/// Proved bounds are told outward, with no "about", which is of what is estimated.
TEST(SensitivitySection, RoundsProvedSharesOutward) {
  Results results = example::kinematics();
  SensitivityResult& s = results.sensitivity;
  s.present = true;
  s.time = {0};
  results.uncertain.push_back(results.uncertain[0]);
  s.total.lower = Grid({1, 2, 2}, {1.0 / 3, 0.25 - 1e-13, 1.0 / 3, 0.25 - 1e-13});
  s.total.upper = Grid({1, 2, 2}, {1.0 / 3, 0.35 + 1e-13, 1.0 / 3, 0.35 + 1e-13});
  s.first = s.total;
  EXPECT_THAT(sensitivities(results), AllOf(HasSubstr("<td>0.3333 to 0.3334</td>"), HasSubstr("<td>0.24 to 0.36</td>"),
                                            Not(HasSubstr("about 0.25"))));
}

/// Per degree a derivative is less than per radian; what is drawn, times half the interval, is the same.
TEST(SensitivitySection, TellsDerivativesPerUnitThatTheStudyStates) {
  Results results = example::sensitive();
  std::ranges::fill(results.of<DerivativeResult>().lower.data, 180);
  std::ranges::fill(results.of<DerivativeResult>().upper.data, 270);
  const std::string si = sensitivities(results);
  EXPECT_THAT(si, HasSubstr("180 to 270 rad per rad"));
  results.uncertain[0].told = "deg";
  const std::string told = sensitivities(results);
  EXPECT_THAT(told, HasSubstr("3.14 to 4.72 rad per deg"));
  const auto paths = [](const std::string& text) {
    const std::size_t at = text.find("<path class=\"cause0\"");
    return text.substr(at, text.find('>', at) - at);
  };
  EXPECT_EQ(paths(si), paths(told));
}

/// Of one quantity there is nothing to rank, and of an output that varies by roundings nothing to say.
TEST(SensitivitySection, LeavesOutWhatSaysNothing) {
  Results results = example::sensitive();
  for (Bounds* bounds : {&results.interval.at, &results.interval.over})
    for (std::size_t i = 0; i < 61; ++i) bounds->upper(i, 1) = bounds->lower(i, 1);
  EXPECT_EQ(count(sensitivities(results), "<section class=\"card\">"), 1u);
  results = example::sensitive();
  results.uncertain.pop_back();
  SensitivityResult& s = results.sensitivity;
  for (Grid* numbers : {&s.first.lower, &s.first.upper, &s.total.lower, &s.total.upper, &s.firstSampled, &s.firstError,
                        &s.totalSampled, &s.totalError, &s.pinched, &results.of<DerivativeResult>().lower,
                        &results.of<DerivativeResult>().upper, &results.fuzzy.influence.share})
    *numbers = Grid({numbers->extents[0], numbers->extents[1], 1},
                    std::vector(numbers->data.begin(), numbers->data.begin() + std::ssize(numbers->data) / 2));
  const std::string text = sensitivities(results);
  EXPECT_EQ(count(text, "<figure class=\"kept derivative\">"), 2u);
  EXPECT_EQ(count(text, "<figure"), 2u);
}

// ---- Samples --------------------------------------------------------------------------------------------------------

TEST(SamplesSection, SaysWhatShareOfAllMotionsTheSamplesSpan) {
  EXPECT_THAT(sectionOf(example::sensitive(), "samples"), HasSubstr("at least 99.53 % of all motions lie between"));
  Results results = example::sensitive();
  results.stochastic.covered = 0;
  EXPECT_THAT(sectionOf(results, "samples"), Not(HasSubstr("Wilks")));
}

TEST(SamplesSection, NamesAndCountsFailedSamples) {
  EXPECT_THAT(sectionOf(example::sensitive(), "samples"), Not(HasSubstr("did not arrive")));
  Results results = example::sensitive();
  results.stochastic.failures = 25;
  for (int i = 0; i < 25; ++i) results.stochastic.failed.push_back({i == 0 ? 4096 : i, 1.25, "<step> too small"});
  const std::string text = sectionOf(results, "samples");
  EXPECT_THAT(text, AllOf(HasSubstr("25 of 4099 sampled motions did not arrive at 3 s"),
                          HasSubstr("<li>corner 0, up to 1.25 s: &lt;step&gt; too small</li>"),
                          HasSubstr("<li>sample 19, up to"), Not(HasSubstr("<li>sample 20, up to")),
                          HasSubstr("and 5 more; the results name them all")));
}

TEST(SamplesSection, ShowsConvergenceOfTheWorstOutput) {
  const std::string text = sectionOf(example::sensitive(), "samples");
  EXPECT_EQ(count(text, "<figure class=\"kept convergence\">"), 2u);
  EXPECT_THAT(text, AllOf(HasSubstr("0.02 standard deviations with 4096 samples for \u201celbow angle\u201d"),
                          HasSubstr("0.95 with 4096 samples for \u201cshoulder angle\u201d")));
  EXPECT_EQ(count(text, "class=\"others\""), 2u);
  Results results = example::sensitive();
  for (double& x : results.stochastic.convergence.meanError) x = std::nan("");
  EXPECT_EQ(count(sectionOf(results, "samples"), "<figure class=\"kept convergence\">"), 1u);
}

TEST(SamplesSection, HasEveryStatisticWithItsInterval) {
  const std::string text = sectionOf(example::sensitive(), "samples");
  EXPECT_THAT(text, AllOf(HasSubstr("At 3 s, with 95 % confidence"), HasSubstr(" ± 0.0070</td>"),
                          HasSubstr(">95 % quantile</th>")));
}

/// Of the rarest no interval may be known: what is told of them is an estimate.
TEST(SamplesSection, SaysWhereAQuantileHasNoInterval) {
  Results results = example::sensitive();
  for (double& x : results.stochastic.quantileLower.front().data) x = std::nan("");
  EXPECT_THAT(sectionOf(results, "samples"), HasSubstr("<td>about "));
  EXPECT_THAT(sectionOf(example::sensitive(), "samples"), Not(HasSubstr("<td>about ")));
}

/// One figure more an output, folded beside its distribution function, or alone.
TEST(ProbabilitySection, DrawsMeanAndQuantilesWithTheirConfidence) {
  const std::string text = sectionOf(example::sensitive(), "probabilities");
  EXPECT_EQ(count(text, "<figure class=\"kept statistics\">"), 2u);
  EXPECT_THAT(text, AllOf(HasSubstr("quantiles from the samples&#39; order"), Not(HasSubstr("<details")),
                          HasSubstr("[\"95 % quantile (rad)\""), HasSubstr("[\"to (rad)\"")));
  Results results = example::sensitive();
  results.stochastic.plan = Placement::sobol;
  DistributionResult& d = results.distribution;
  d.present = true;
  d.time = {3};
  d.point = {0, 1};
  d.lower = d.upper = d.sampled = d.value = Grid({1, 2, 2}, {0, 1, 0, 1});
  d.gaps = d.excess = Grid({1, 2}, {0, 0});
  d.cpu = 4.9312;
  EXPECT_THAT(renderReport(results), AllOf(HasSubstr("4.93 s"), HasSubstr("at 1 time<"))) << "what they cost";
  const std::string folded = sectionOf(results, "probabilities");
  EXPECT_THAT(folded, Not(HasSubstr("order")));
  EXPECT_EQ(count(folded, "<details class=\"more\"><summary>Mean and quantiles over time"), 2u);
}

TEST(ProbabilitySection, SaysWhereNoIntervalHolds) {
  EXPECT_THAT(sectionOf(example::pendulum(), "probabilities"), HasSubstr("is not known."));
  EXPECT_THAT(sectionOf(example::sensitive(), "probabilities"), Not(HasSubstr("is not known.")));
}

}  // namespace
}  // namespace gamut
