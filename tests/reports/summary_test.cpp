// The JSON object holds what the results hold, and nothing that JSON cannot say.
#include "reports/summary.hpp"
#include "reports/json.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/description/units.hpp"
#include "reports/plain.hpp"
#include "reports/requirements.hpp"
#include "scalars/interval.hpp"
#include "tests/studies/sample_results.hpp"

namespace gamut {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

std::vector<std::string> keysOf(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

TEST(Summary, WritesIntervalsOfParametersAndEvidence) {
  Results results;
  results.uncertain = {{"q", "q", "m", 0, 1, 2, "normal", "triangular"},
                       {"e", "e", "m", 0, 1, 2, "evidence", "triangular"}};
  for (const auto& [name, value] : {std::pair("lower", 0.0), std::pair("upper", 2.0), std::pair("mean", 0.9),
                                    std::pair("mean, at most", 1.1), std::pair("deviation", 0.1)})
    results.shapes.push_back({"q", ShapeKind::distribution, name, value, "m"});
  for (const auto& [name, value] :
       {std::pair("lower", 0.0), std::pair("upper", 2.0), std::pair("lower 1", 0.0), std::pair("upper 1", 1.5),
        std::pair("mass 1", 2.0), std::pair("lower 2", 0.5), std::pair("upper 2", 2.0), std::pair("mass 2", 1.0)})
    results.shapes.push_back({"e", ShapeKind::distribution, name, value, "m"});
  EXPECT_EQ(shapeText(results, results.uncertain[0], ShapeKind::distribution),
            "normal (mean 0.9 to 1.1, deviation 0.1)");
  EXPECT_EQ(shapeText(results, results.uncertain[1], ShapeKind::distribution),
            "evidence ([0, 1.5] mass 2, [0.5, 2] mass 1)");
}

TEST(Summary, TellsACoreAsTheStudyStatesIt) {
  Results results;
  results.uncertain = {{"q", "q", "m", 0, 1, 2, "uniform", "trapezoidal"}};
  for (const auto& [name, value] :
       {std::pair("lower", 0.0), std::pair("left", 0.9), std::pair("right", 1.1), std::pair("upper", 2.0)})
    results.shapes.push_back({"q", ShapeKind::membership, name, value, "m"});
  EXPECT_EQ(shapeText(results, results.uncertain[0], ShapeKind::membership), "trapezoidal (core 0.9 to 1.1)");
}

TEST(JsonSummary, TellsEveryPositionInTheOrderOfItsCoordinates) {
  const Json json = Json::parse(jsonSummary(sampleResults(), findVerdict(sampleResults())));
  EXPECT_EQ(json["postures"]["lower"], Json::parse("[[-1.0, 0.0], [0.0, 0.5]]"));
  EXPECT_EQ(json["postures"]["upper"], Json::parse("[[-0.5, 0.0], [0.25, 0.75]]"));
  EXPECT_EQ(json["postures"]["always"], Json::parse("[1, 0]"));
  EXPECT_EQ(json["equilibria"]["lower"], Json::parse("[[-1.0, 0.0], [0.0, 0.5], [1.0, 0.25]]"));
  EXPECT_EQ(json["equilibria"]["stability"], Json::parse("[1, -1, 0]"));
  EXPECT_THAT(keysOf(json["postures"]), ElementsAre("always", "complete", "coordinates", "cpu", "goal", "lower", "open",
                                                    "outputs", "reached", "upper", "why"));
}

TEST(JsonSummary, TellsShapesOfModes) {
  const Json json = Json::parse(jsonSummary(sampleResults(), findVerdict(sampleResults())))["modes"];
  EXPECT_THAT(keysOf(json), ElementsAre("coordinates", "cpu", "first", "frequency_lower", "frequency_upper",
                                        "imaginary_lower", "imaginary_upper", "last", "lower", "mode", "outputs",
                                        "reached", "reference", "upper", "why"));
  EXPECT_EQ(json["lower"], Json::parse("[[-0.5, 1.0], [1.0, 0.0]]"));
  EXPECT_EQ(json["imaginary_upper"], Json::parse("[[0.25, 0.0], [0.0, 0.0]]"));
  EXPECT_EQ(json["reference"], Json::parse("[2, 1]"));
  EXPECT_THAT(textSummary(sampleResults()),
              HasSubstr("mode 1, [0.5, 0.75] Hz: hinge.angle [-0.5, -0.25] + [0.125, 0.25] i, slide.displacement 1"));
  EXPECT_THAT(textSummary(sampleResults()),
              HasSubstr("mode 3 of 2 to 3, which are not told apart, [2, 2] Hz: hinge.angle 1, slide.displacement 0"));
}

TEST(JsonSummary, HasTheDocumentedKeys) {
  const std::string text = jsonSummary(sampleResults(), findVerdict(sampleResults()), {"run.h5", "run.html", 0.0625});
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const Json json = Json::parse(text);
  EXPECT_THAT(keysOf(json),
              ElementsAre("advice", "alpha_cuts", "approaches", "assembly", "assumptions", "cost", "dependence",
                          "derivatives", "distribution", "enclosure", "envelope", "equilibria", "excursion", "files",
                          "horizon", "integrated", "limits", "modes", "outputs", "overestimation", "postures",
                          "reached", "requirements", "samples", "sensitivity", "shortfall", "statistics", "stopped",
                          "tightness", "verdict", "version", "why", "witness", "workspace"));
  EXPECT_THAT(keysOf(json["overestimation"]), ElementsAre("max", "median", "outputs"));
  EXPECT_THAT(keysOf(json["cost"]), ElementsAre("advice", "derivatives", "distribution", "equations", "equilibria",
                                                "fuzzy", "interval", "memory", "modes", "postures", "report",
                                                "requirements", "stochastic", "total", "witness", "workspace"));
  EXPECT_THAT(keysOf(json["limits"]),
              ElementsAre("enclosure_memory", "enclosure_time", "memory", "sample_time", "time"));
  EXPECT_EQ(json["verdict"], wordOf(findVerdict(sampleResults()).word));
  EXPECT_EQ(json["horizon"], 0.02);
  EXPECT_EQ(json["reached"], 0.01);
  EXPECT_EQ(json["samples"], 4096);
  EXPECT_EQ(json["tightness"], 1.25);
  EXPECT_EQ(json["shortfall"], "at 0.01 s tip may be 1.25 times as wide as necessary: bisection is switched off");
  EXPECT_EQ(json["advice"], "interval.split = true");
  EXPECT_EQ(json["integrated"], 1000);
  EXPECT_EQ(json["why"], "the enclosure became wider than 1e6; the run was interrupted");
  EXPECT_EQ(json["stopped"], "the run was interrupted");
  EXPECT_EQ(json["cost"]["total"], 2.25);
  EXPECT_EQ(json["cost"]["memory"], 1.5e9);
  EXPECT_EQ(json["limits"]["sample_time"], 18);
  EXPECT_EQ(json["requirements"][0]["estimate"], nullptr);
  EXPECT_EQ(json["requirements"][1]["estimate"], Json({{"samples", 1024},
                                                       {"met", 640},
                                                       {"violated", 380},
                                                       {"confidence", Json::array({0.59, 0.66})},
                                                       {"first_order", 0.625}}));
  EXPECT_EQ(json["alpha_cuts"]["method"], "extended");
  EXPECT_EQ(json["alpha_cuts"]["points"], 12);
  EXPECT_EQ(json["alpha_cuts"]["stepped"], Json::array());
  EXPECT_EQ(json["alpha_cuts"]["gaps"]["energy"]["0.5"], Json({{"gap", 0.3}, {"time", 0}}));
  EXPECT_FALSE(json["alpha_cuts"]["gaps"]["tip height"].contains("1"));
  EXPECT_EQ(json["version"], "9.8.7");
  EXPECT_EQ(json["files"]["results"], "run.h5");
  EXPECT_EQ(json["files"]["report"], "run.html");
  EXPECT_EQ(json["cost"]["interval"], 0.25);
  EXPECT_EQ(json["cost"]["report"], 0.0625);
}

TEST(JsonSummary, SaysWhatIsKnownOfARequirement) {
  Results results = sampleResults();
  RequirementResult& requirement = results.requirements[0];
  requirement.word = Decision::partly;
  requirement.isViolatedInSimulation = true;
  requirement.worstSample = 17;
  requirement.worstMargin = -0.25;
  const Json json = Json::parse(jsonSummary(results, findVerdict(results)))["requirements"][0];
  EXPECT_EQ(json["guaranteed"], "partly");
  EXPECT_EQ(json["simulated_violation"]["sample"], 17);
  EXPECT_EQ(json["simulated_violation"]["margin"], -0.25);
}

TEST(JsonSummary, KeysTimesByTheirShortestDecimalAndKeepsEveryBit) {
  Results results = sampleResults();
  results.interval.at.lower(1, 0) = 0.1 + 0.2;
  const Json json = Json::parse(jsonSummary(results, findVerdict(results)));
  EXPECT_THAT(keysOf(json["enclosure"]["tip height"]), ElementsAre("0", "0.01"));  // 0.02 was not reached
  EXPECT_THAT(keysOf(json["envelope"]["energy"]), ElementsAre("0", "0.01", "0.02"));
  EXPECT_EQ(json["enclosure"]["tip height"]["0.01"][0].get<double>(), 0.1 + 0.2);
  EXPECT_EQ(json["enclosure"]["tip height"]["0.01"][1].get<double>(), results.interval.at.upper(1, 0));
}

TEST(JsonSummary, SaysNullWhereThereIsNoNumber) {
  Results results = sampleResults();
  results.comparison.present = false;
  results.comparison.maximum = std::numeric_limits<double>::infinity();
  const Json json = Json::parse(jsonSummary(results, findVerdict(results)));
  EXPECT_TRUE(json["overestimation"]["max"].is_null());
  EXPECT_TRUE(json["overestimation"]["outputs"]["energy"].is_null());
  EXPECT_EQ(json["overestimation"]["outputs"]["tip height"], 12);
  EXPECT_TRUE(json["files"]["results"].is_null());
  EXPECT_TRUE(json["verdict"].is_null());
}

TEST(TextSummary, ShowsTheLastRowReachedRoundedOutward) {
  Results results = sampleResults();
  results.interval.at.lower(1, 0) = 1.00006;
  results.interval.at.upper(1, 0) = 2.99994;
  const std::string text = textSummary(results);
  EXPECT_THAT(text, HasSubstr("at 0.01 s"));
  EXPECT_THAT(text, HasSubstr("tip height (m)"));
  EXPECT_THAT(text, HasSubstr("[1.000, 3.000]"));
  EXPECT_THAT(text, HasSubstr("1000 of 4132 samples 1.50 s"));
  EXPECT_THAT(text, HasSubstr("; in all 2.25 of 1800 s, 1.50 of 8 GB\n"));
  results.stochastic.integrated = results.stochastic.planned();
  EXPECT_THAT(textSummary(results), HasSubstr(" 4096 samples 1.50 s"));
}

TEST(TextSummary, SaysHowFarSamplesFillTheCuts) {
  Results results = sampleResults();
  TransformationResult& t = results.fuzzy.transformation;
  t.present = true;
  t.method = "reduced";
  t.gap = t.gapTime = Grid({results.fuzzy.alpha.size(), results.outputs.size()});
  std::ranges::fill(t.gap.data, 0.0123);
  std::ranges::fill(t.gapTime.data, 0.01);
  EXPECT_THAT(textSummary(results), HasSubstr("; they leave 1.3 % of the widest proved cut at most (tip height, "));
  std::ranges::fill(t.gap.data, 2.8e-14);
  EXPECT_THAT(textSummary(results), HasSubstr("; they reach the ends of every proved cut\n"));
}

/// Without requirements, whose margins the outputs are; every distribution is known to this gap at one time.
Results boundedResults(double gap) {
  Results results = sampleResults();
  results.requirements.clear();
  DistributionResult& d = results.distribution;
  d = {};
  d.present = true;
  d.wanted = 0.005;
  d.gap = gap;
  d.time = {0.01};
  d.gaps = Grid({1, results.outputs.size()}, std::vector(results.outputs.size(), gap));
  return results;
}

TEST(TextSummary, SaysHowCloseBoundsOfProbabilitiesAre) {
  Results results = boundedResults(0.0389);
  DistributionResult& d = results.distribution;
  EXPECT_THAT(textSummary(results), HasSubstr("  probabilities: bounds 0.039 apart at most, at 1 time\n"));
  d.why = "the work that limits.probabilities allows is done";
  EXPECT_THAT(textSummary(results),
              HasSubstr(" at 1 time (0.005 is aimed at: the work that limits.probabilities allows "
                        "is done)\n"));
  d.gaps = Grid({1, 2}, {0.00195, 0.0389});
  results.outputs.resize(2, results.outputs.front());
  results.outputs[1].name = "tip at its peak";
  EXPECT_THAT(
      textSummary(results),
      HasSubstr("bounds 0.039 apart at most (tip at its peak at 0.01 s; half of them within 0.002), at 1 time ("));
}

/// At a time of their window margins are told as such; at any other they say nothing.
TEST(TextSummary, TellsMarginsWhereTheirRequirementAsksForThem) {
  Results results = sampleResults();
  ASSERT_FALSE(results.requirements.empty());
  RequirementResult& r = results.requirements.front();
  const std::string name = "margin of " + results.outputs[static_cast<std::size_t>(r.margin)].name;
  r.from = 0;
  r.until = results.horizon;
  EXPECT_THAT(textSummary(results), HasSubstr(name));
  r.until = 0;
  EXPECT_THAT(textSummary(results), Not(HasSubstr(name)));
}

/// Bounds from 0 to 1 are none.
TEST(TextSummary, SaysOfHowManyDistributionsNothingIsKnown) {
  Results results = boundedResults(0.0389);
  DistributionResult& d = results.distribution;
  d.gaps(0, 0) = 1;
  d.gap = 1;
  d.why = "the enclosure is not tight enough";
  EXPECT_THAT(
      textSummary(results),
      HasSubstr(fmt::format("  probabilities: nothing is known of 1 of {} distributions; of the others bounds 0.039 "
                            "apart at most, at 1 time (0.005 is aimed at: the enclosure is not tight enough)\n",
                            results.outputs.size())));
  d.gaps = Grid({1, results.outputs.size()});
  EXPECT_THAT(textSummary(results),
              HasSubstr("  probabilities: nothing is known of them: the enclosure is not tight enough\n"));
}

/// What belongs to no answer is told beside these, so that parts and limits add up.
TEST(TextSummary, ListsWhatRequirementsAndAdviceCost) {
  Results results = sampleResults();
  results.costs.clear();
  addCost(results, "advice", 6);
  addCost(results, "advice", 0.25);
  results.requirements.cpu = 3.5;
  EXPECT_THAT(textSummary(results), HasSubstr("requirements 3.50 s"));
  EXPECT_THAT(textSummary(results), HasSubstr("advice 6.25 s"));
  const Json cost = Json::parse(jsonSummary(results, findVerdict(results), {}))["cost"];
  EXPECT_EQ(cost["requirements"], 3.5);
  EXPECT_EQ(cost["advice"], 6.25);
  EXPECT_EQ(cost["equations"], 0);
}

TEST(JsonSummary, HasTheCostOfEveryPart) {
  Results results = sampleResults();
  results.distribution.cpu = 4;
  for (std::size_t i = 0; i < results.further.size(); ++i) results.further[i]->cpu = 6 + static_cast<double>(i);
  const Json cost = Json::parse(jsonSummary(results, findVerdict(results), {}))["cost"];
  EXPECT_EQ(cost["distribution"], 4);
  for (std::size_t i = 0; i < results.further.size(); ++i)
    EXPECT_EQ(cost[std::string(results.further[i]->key())], 6 + static_cast<double>(i));
}

/// In files that were written before the part was kept, and that may have been extended since.
TEST(JsonSummary, FindsWhatRequirementsCostAmongTheOthers) {
  Results results = sampleResults();
  results.costs = {{"requirements", 2.5}};
  for (const bool isExtended : {false, true}) {
    results.requirements.present = isExtended;
    const Json cost = Json::parse(jsonSummary(results, findVerdict(results), {}))["cost"];
    EXPECT_EQ(cost["requirements"], isExtended ? 3 : 2.5);
  }
}

/// Files that were written before these were kept hold none at all.
TEST(JsonSummary, KnowsNoCostThatTheFileDoesNotHold) {
  Results results = sampleResults();
  results.requirements.present = false;
  results.costs.clear();
  const Json cost = Json::parse(jsonSummary(results, findVerdict(results), {}))["cost"];
  for (const char* what : {"equations", "requirements", "advice"}) EXPECT_TRUE(cost[what].is_null()) << what;
  EXPECT_EQ(cost["interval"], 0.25);
}

TEST(TextSummary, LeadsWithTheLeastAndTheGreatestOfTheWholeMotion) {
  Results results = sampleResults();
  results.requirements.clear();  // whose margins they are
  results.interval.over = results.interval.at;
  for (std::size_t i = 0; i < 2; ++i) {
    results.interval.at.lower(i, 0) = results.interval.over.lower(i, 0) = 1;
    results.interval.at.upper(i, 0) = results.interval.over.upper(i, 0) = 2;
  }
  results.interval.over.upper(1, 0) = 3.5;  // between both times
  const std::string text = textSummary(results);
  EXPECT_THAT(text, HasSubstr("guaranteed from 0 s to 0.01 s"));
  EXPECT_THAT(text, HasSubstr("1.000"));
  EXPECT_THAT(text, HasSubstr("3.500  between 0 s and 0.01 s"));
  EXPECT_LT(text.find("guaranteed from"), text.find("at 0.01 s  "));
  const Json json = Json::parse(jsonSummary(results, findVerdict(results)))["outputs"]["tip height"];
  EXPECT_EQ(json["unit"], "m");
  EXPECT_EQ(json["guaranteed"]["greatest"], Json({{"value", 3.5}, {"from", 0}, {"until", 0.01}}));
  EXPECT_EQ(json["guaranteed"]["least"], Json({{"value", 1}, {"from", 0}, {"until", 0}}));
  EXPECT_EQ(json["guaranteed"]["until"], 0.01);
}

/// Whether the decimals that the table shows for the first output lie outside these bounds, or on them, exactly.
bool showsOutward(double lower, double upper) {
  Results results = sampleResults();
  results.interval.at.lower(1, 0) = lower;
  results.interval.at.upper(1, 0) = upper;
  const std::string text = textSummary(results);
  const auto start = text.find('[', text.find("tip height")) + 1, comma = text.find(',', start);
  const Interval below(text.substr(start, comma - start));  // between the doubles next to the decimal
  const Interval above(text.substr(comma + 1, text.find(']', comma) - comma - 1));
  return below.upper() <= lower && above.lower() >= upper;
}

TEST(TextSummary, RoundsEveryBoundOutward) {
  EXPECT_TRUE(showsOutward(1.00006, 2.99994));
  EXPECT_TRUE(showsOutward(1.0 / 3, 1.0 / 3));                         // more digits than the decimals shown
  EXPECT_TRUE(showsOutward(2.0 / 3, std::nextafter(2.0 / 3, 1)));      // as wide as an ulp
  EXPECT_TRUE(showsOutward(-2.0 / 3, -1.0 / 3 * (1 - 1e-14)));         // both below 0
  EXPECT_TRUE(showsOutward(123456789.0 / 7, 123456789.0 / 7 + 1e-7));  // scaled, no longer exact in doubles
  EXPECT_TRUE(showsOutward(-1e300 / 3, 1e300 / 7));                    // beyond any scale
}

TEST(TextSummary, ShowsTheWidestAlphaCutOfAStudyWithoutEnclosure) {
  Results results = sampleResults();
  results.requirements.clear();  // whose margins they are
  results.interval = {};
  results.fuzzy.outer.front().lower(2, 0) = 1.25;
  results.fuzzy.outer.front().upper(2, 0) = 1.75;
  const std::string text = textSummary(results);
  EXPECT_THAT(text, HasSubstr("widest alpha-cut"));
  EXPECT_THAT(text, HasSubstr("[1.2500, 1.7500]"));
}

TEST(InfoText, SpeaksOfNoTimeInKinematicsAndOfOneAsOne) {
  Results results = sampleResults();
  results.horizon = 0;
  results.interval.pieces = 1;
  results.uncertain.front().nominal = 0.1 + 0.2;
  const std::string text = infoText(results);
  EXPECT_THAT(text, Not(HasSubstr("up to")));
  EXPECT_THAT(text, Not(HasSubstr("output times")));
  EXPECT_THAT(text, HasSubstr(" 1 piece,"));
  EXPECT_THAT(text, HasSubstr("nominal 0.3,"));
  EXPECT_THAT(text, HasSubstr(", tolerances 1e-10 relative"));
  results.stochastic.relativeTolerance = 0;  // nothing is integrated
  EXPECT_THAT(infoText(results), Not(HasSubstr("tolerances")));
}

TEST(ContentText, ListsEveryFieldThatIsThere) {
  const Results results = sampleResults();
  const std::string text = contentText(results);
  for (const Group& group : describe(results)) EXPECT_THAT(text, HasSubstr("  " + std::string(group.path)));
  EXPECT_THAT(text, HasSubstr("  outer    3 x 3 x 2  proved alpha-cuts\n"));
  EXPECT_THAT(text, HasSubstr("  pieces     4 "));
  EXPECT_THAT(text, HasSubstr("  2 of number, time, output,"));
  EXPECT_THAT(text, Not(HasSubstr("    direct ")));
}

TEST(InfoText, RoundsTheIntervalOfAQuantityOutwardOrSaysTheDecimalsOfTheStudy) {
  Results results = sampleResults();
  results.uncertain[0].lower = Interval("0.9").lower();
  results.uncertain[0].upper = Interval("1.1").upper();
  EXPECT_THAT(infoText(results), HasSubstr(" in [0.9, 1.1] rad,"));
  results.uncertain[0].lower = 1.0 / 3 * (1 - 1e-15);
  results.uncertain[0].upper = 2.0 / 3;
  EXPECT_THAT(infoText(results), HasSubstr(" in [0.333333333333, 0.666666666667] rad,"));
  results.uncertain[0].upper = 4.0 / 3;
  EXPECT_THAT(infoText(results), HasSubstr(", 1.33333333334] rad,"));
}

TEST(InfoText, HasNoZerosOfWhatTookHardlyAnyTime) {
  Results results = sampleResults();
  results.interval.cpu = 0.0001;
  results.interval.pieces = 1;
  results.interval.steps = 0;  // where no time passes
  EXPECT_THAT(infoText(results), HasSubstr("less than 0.01 s CPU; 1 piece\n"));
  EXPECT_THAT(textSummary(results), Not(HasSubstr("CPU: enclosure")));
}

/// What is zero but for rounding has neither digits nor a time.
TEST(TextSummary, TellsPeaksThatRoundingsMoveAsAbout) {
  Results results = sampleResults();
  results.requirements.clear();
  for (Bounds* bounds : {&results.interval.at, &results.interval.over})
    for (std::size_t i = 0; i < bounds->lower.times; ++i) {
      bounds->lower(i, 0) = i == 1 ? -1e-13 : 0;
      bounds->upper(i, 0) = i == 1 ? 0.05 + 1e-13 : 0.01;
    }
  const std::string text = textSummary(results);
  EXPECT_THAT(text, HasSubstr("about 0 "));
  EXPECT_THAT(text, HasSubstr("about 0.05 "));
}

TEST(InfoText, TellsQuantitiesInTheUnitsThatTheStudyStates) {
  Results results = sampleResults();
  UncertainInfo& quantity = results.uncertain[0];
  const Interval range = enclose(parseAmount("135 deg")) * Interval("[0.99, 1.01]");
  quantity.lower = range.lower();
  quantity.nominal = nearest(parseAmount("135 deg"));
  quantity.upper = range.upper();
  quantity.told = "deg";
  quantity.distribution = "normal";
  results.shapes = {{"first angle", ShapeKind::distribution, "lower", quantity.lower, "rad"},
                    {"first angle", ShapeKind::distribution, "upper", nearest(parseAmount("136 deg")), "rad"},
                    {"first angle", ShapeKind::distribution, "mean", quantity.nominal, "rad"},
                    {"first angle", ShapeKind::distribution, "deviation", nearest(parseAmount("0.5 deg")), "rad"}};
  EXPECT_THAT(infoText(results), HasSubstr(" in [133.65, 136.35] deg, nominal 135, normal (on [133.65, 136], mean 135, "
                                           "deviation 0.5), triangular\n"));
  quantity.unit = "kg";
  quantity.told = "g";
  quantity.distribution = "lognormal";
  results.shapes = {{"first angle", ShapeKind::distribution, "log_mean", -2, "1"},
                    {"first angle", ShapeKind::distribution, "log_deviation", 0.1, "1"}};
  EXPECT_EQ(shapeText(results, quantity, ShapeKind::distribution),
            "lognormal (log_mean (of the number in kg) -2, log_deviation 0.1)");
}

TEST(InfoText, TellsTheNumbersOfDistributionsAndMembershipFunctions) {
  Results results = sampleResults();
  results.uncertain[0].distribution = "normal";
  results.shapes = {{"first angle", ShapeKind::distribution, "lower", results.uncertain[0].lower, "rad"},
                    {"first angle", ShapeKind::distribution, "upper", results.uncertain[0].upper, "rad"},
                    {"first angle", ShapeKind::distribution, "mean", 1.0, "rad"},
                    {"first angle", ShapeKind::distribution, "deviation", 0.05, "rad"},
                    {"first angle", ShapeKind::distribution, "cut_off", 0.00766076, "1"},
                    {"first angle", ShapeKind::membership, "lower", 0.95, "rad"},
                    {"first angle", ShapeKind::membership, "apex", 1.0, "rad"}};
  EXPECT_THAT(infoText(results),
              HasSubstr(", normal (mean 1, deviation 0.05, 0.766 % cut off), triangular (on [0.95, 1.1], apex 1)\n"));
}

TEST(InfoText, SaysOnceHowAQuantityVaries) {
  Results results = sampleResults();
  results.uncertain[0].distribution = results.uncertain[0].membership = "varies freely";
  results.shapes.clear();
  const std::string text = infoText(results);
  EXPECT_THAT(text, HasSubstr(", varies freely\n"));
  EXPECT_EQ(text.find("varies"), text.rfind("varies"));
}

TEST(KeptSamples, SayOfHowMany) {
  KeptSamples kept;
  EXPECT_EQ(kept.text(), "values of all, motions of all");
  kept.motionsEvery = 18;
  EXPECT_EQ(kept.text(), "values of all, motions of one in 18");
  kept.valuesEvery = kept.motionsEvery = 0;
  EXPECT_EQ(kept.text(), "values of none, motions of none");
}

// ---- The summary of a run -------------------------------------------------------------------------------------------

std::size_t rowsOf(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// As if no sample had left what is guaranteed.
std::string ranSummary(const Results& results, const SummaryStyle& style = {}) {
  Verdict verdict = judge(results);
  verdict.word = Agreement::incomplete;
  return runSummary(results, verdict, "Lead.", style);
}

/// So many requirements, each violated but the last.
Results withRequirements(std::size_t count) {
  Results results = sampleResults();
  results.requirements.resize(count, results.requirements.front());
  for (std::size_t r = 0; r < count; ++r) {
    results.requirements[r].name = "requirement " + std::to_string(r);
    results.requirements[r].word = r + 1 < count ? Decision::partly : Decision::met;
    results.requirements[r].isViolatedInSimulation = false;
  }
  return results;
}

TEST(RunSummary, HasTwentyRowsAtMostAndSaysHowManyThereAre) {
  const Results results = withRequirements(30);
  SummaryStyle style;
  const std::string text = ranSummary(results, style);
  EXPECT_EQ(rowsOf(text), 20U) << text;
  style.isVerbose = true;
  const std::size_t all = rowsOf(ranSummary(results, style));
  EXPECT_GT(all, 100U);
  EXPECT_THAT(text, ::testing::EndsWith(fmt::format("\n  {} more lines: --verbose\n", all - 19)));
  for (style = {}; style.rows > 2; --style.rows) EXPECT_EQ(rowsOf(ranSummary(results, style)), style.rows);
}

TEST(RunSummary, SaysOnceWhyTheRunStopped) {
  const Results results = sampleResults();
  Verdict verdict = judge(results);
  verdict.sentence = "Nothing could be compared: the run was interrupted.";
  verdict.notes = {"3 of 8 samples were taken: the run was interrupted."};
  SummaryStyle verbose;
  verbose.isVerbose = true;
  const auto told = [&](const std::string& lead) { return runSummary(results, verdict, lead, verbose); };
  const std::string once = told("The computation is incomplete: the run was interrupted.");
  EXPECT_THAT(once, AllOf(HasSubstr("is incomplete: the run was interrupted.\n"),
                          HasSubstr("Nothing could be compared.\n  3 of 8 samples were taken.\n")));
  EXPECT_EQ(once.find(": the run was interrupted"), once.rfind(": the run was interrupted"));
  EXPECT_THAT(told("Lead."), HasSubstr("  3 of 8 samples were taken: the run was interrupted.\n"));
}

TEST(RunSummary, SaysAllWhereThereIsRoom) {
  const Results results = sampleResults();
  SummaryStyle verbose, roomy;
  verbose.isVerbose = true;
  roomy.rows = 1000;
  EXPECT_THAT(ranSummary(results, roomy), Not(HasSubstr("--verbose")));
  roomy.rows = rowsOf(ranSummary(results, roomy));
  EXPECT_THAT(ranSummary(results, roomy), Not(HasSubstr("--verbose")));
  --roomy.rows;
  EXPECT_THAT(
      ranSummary(results, roomy),
      HasSubstr(fmt::format("  {} more lines: --verbose\n", rowsOf(ranSummary(results, verbose)) - roomy.rows + 1)));
  for (const char* answer : {"    demanded    ", "    guaranteed  ", "    probable    ", "    possible    "}) {
    EXPECT_THAT(ranSummary(results, verbose), HasSubstr(answer));
    EXPECT_THAT(ranSummary(results), Not(HasSubstr(answer)));
  }
}

TEST(RunSummary, BeginsWithTheLeadAndTheWorstRequirementAndKeepsTheVerdict) {
  Results results = withRequirements(12);
  const std::string sentence = judge(results).sentence;
  std::swap(results.requirements.front(), results.requirements.back());
  const std::string text = ranSummary(results);
  EXPECT_THAT(text, ::testing::StartsWith("Lead.\n  violated  requirement "));
  EXPECT_THAT(text, HasSubstr("\n" + sentence + "\n"));
  EXPECT_LT(text.find("  violated  requirement 1: "), text.find(sentence));
}

TEST(RunSummary, SaysOfEachRequirementWhatItsCardDoes) {
  const Results results = withRequirements(2);
  const std::vector<std::string> sentences = plainRequirements(results);
  const std::string text = ranSummary(results);
  EXPECT_THAT(
      text, HasSubstr("\n  violated  requirement 0: " + sentences[0] + shrinkSentence(results.requirements[0]) + "\n"));
  EXPECT_THAT(text, HasSubstr("\n  met       requirement 1: " + sentences[1] + "\n"));
}

TEST(RunSummary, LeavesNoHeadingAlone) {
  const Results results = sampleResults();
  for (SummaryStyle style; style.rows > 2; --style.rows) {
    const std::string text = ranSummary(results, style);
    const std::size_t cut = text.find(" more line");
    if (cut == std::string::npos) continue;
    const std::size_t before = text.rfind('\n', cut), last = text.rfind('\n', before - 1);
    EXPECT_EQ(text.substr(last, before - last).find("overestimation"), std::string::npos) << text;
  }
}

TEST(RunSummary, WrapsSentencesOnATerminal) {
  const Results results = withRequirements(5);
  for (const std::size_t columns : {40U, 80U, 200U}) {
    SummaryStyle style;
    style.columns = columns;
    const std::string text = verdictSummary(results, judge(results), "Lead.", style);
    EXPECT_LE(rowsOf(text), 20U) << text;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(line.size(), columns + 12) << line;  // “ and ” are bytes
  }
}

TEST(RunSummary, OfContradictingResultsTrustsNoRequirement) {
  Results results = withRequirements(2);
  Verdict verdict = judge(results);
  verdict.word = Agreement::outside;
  const std::string text = runSummary(results, verdict, "", {});
  EXPECT_THAT(text, HasSubstr("  contradicted  requirement 0\n"));
  EXPECT_THAT(text, Not(HasSubstr("In some cases")));
}

TEST(ShortInfo, SaysHowMuchMoreThereIs) {
  const Results results = sampleResults();
  SummaryStyle style;
  const std::string text = shortInfo(results, "Verdict.", style);
  EXPECT_EQ(rowsOf(text), 20U);
  EXPECT_THAT(text, ::testing::StartsWith(results.title + "\n"));
  EXPECT_THAT(text, HasSubstr("\n  Verdict.\n"));
  style.isVerbose = true;
  EXPECT_EQ(shortInfo(results, "Verdict.", style), infoText(results) + "  Verdict.\n" + contentText(results));
}

}  // namespace
}  // namespace gamut
