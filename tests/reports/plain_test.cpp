// What leads the page is true in every state of the results, and says no more than is known.
#include "reports/plain.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "reports/requirements.hpp"
#include "reports/verdict.hpp"
#include "tests/reports/example_results.hpp"

namespace gamut {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

MarginInfo above(const std::string& what, const std::string& limit, const std::string& unit = "") {
  return {0, what, true, limit, unit, true, 0, 0, true};
}

MarginInfo below(const std::string& what, const std::string& limit, const std::string& unit = "") {
  MarginInfo margin = above(what, limit, unit);
  margin.isAbove = false;
  return margin;
}

/// Its margins are outputs from the first on.
Results withRequirement(std::vector<MarginInfo> margins, Decision word, bool isAlways = true) {
  Results results = example::pendulum();
  RequirementResult& requirement = results.requirements.emplace_back();
  requirement.name = "clearance";
  requirement.statement = "as it was written";
  requirement.isAlways = isAlways;
  requirement.until = results.horizon;
  requirement.word = word;
  requirement.violation.assign(results.uncertain.size(), std::nan(""));
  requirement.margins = static_cast<std::int64_t>(margins.size());
  for (std::size_t k = 0; k < margins.size(); ++k) margins[k].output = k;
  results.margins = std::move(margins);
  return results;
}

std::string sentenceOf(const Results& results) { return plainRequirements(results).front(); }

std::string summaryOf(const Results& results) { return plainSummary(results, judge(results), 0); }

TEST(PlainRequirement, SaysWhatStaysWhere) {
  EXPECT_EQ(sentenceOf(withRequirement({above("tip.z", "0.2 m")}, Decision::met)),
            "\u201ctip.z\u201d stays above 0.2 m in every case.");
  EXPECT_EQ(sentenceOf(withRequirement({below("'tip height'", "0.2 m")}, Decision::met)),
            "\u201ctip height\u201d stays below 0.2 m in every case.");
  EXPECT_EQ(sentenceOf(withRequirement({above("a", "-5 deg"), below("a", "6 deg")}, Decision::met)),
            "\u201ca\u201d stays between -5 deg and 6 deg in every case.");
  EXPECT_EQ(sentenceOf(withRequirement({below("a", "6 deg"), above("a", "-5 deg")}, Decision::met)),
            "\u201ca\u201d stays between -5 deg and 6 deg in every case.");
  EXPECT_EQ(sentenceOf(withRequirement({above("abs(a)", "6 deg")}, Decision::met)),
            "\u201cabs(a)\u201d stays above 6 deg in every case.");
  EXPECT_EQ(sentenceOf(withRequirement({below("a", "1")}, Decision::met, false)),
            "\u201ca\u201d falls below 1, at least once, in every case.");
}

TEST(PlainRequirement, IsNamedWhereItsFormulaSaysMore) {
  MarginInfo ofTwo = above("a", "b");
  ofTwo.isNumber = false;
  EXPECT_EQ(sentenceOf(withRequirement({ofTwo}, Decision::met)), "\u201cclearance\u201d is kept in every case.");
  EXPECT_EQ(sentenceOf(withRequirement({}, Decision::met)), "\u201cclearance\u201d is kept in every case.");
  EXPECT_EQ(sentenceOf(withRequirement({above("'a > 1'", "2")}, Decision::met)),
            "\u201ca > 1\u201d stays above 2 in every case.");
}

TEST(PlainRequirement, NamesTheCaseThatViolatesIt) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::partly);
  EXPECT_EQ(sentenceOf(results), "In some cases, \u201ca\u201d does not stay above 1 m.");
  RequirementResult& requirement = results.requirements.front();
  requirement.violation.front() = 2.3;
  EXPECT_EQ(sentenceOf(results), "In some cases, \u201ca\u201d does not stay above 1 m.");  // nothing to add
  requirement.violationSample = 17;
  requirement.violationTime = 0.5;
  requirement.violationLower = requirement.violationUpper = -0.25;
  requirement.samples = 4096;
  requirement.violating = 3;
  EXPECT_THAT(
      sentenceOf(results),
      EndsWith(" In one simulated case (sample 17) it misses the limit by 0.25 rad at 0.5 s. 3 of 4096 simulated "
               "cases miss it at the output times."));
  requirement.violationSample = 4096;
  requirement.isViolatedBetween = true;
  EXPECT_THAT(sentenceOf(results),
              HasSubstr("In an extreme combination of the tolerances (corner 0) it misses the limit "
                        "for an instant."));
  results.stochastic.alphaPoints = 3;
  requirement.violationSample = results.stochastic.centre() + 2;
  EXPECT_THAT(sentenceOf(results),
              HasSubstr("In a combination within the tolerances (point 1 of the alpha-cuts) it misses"));
  for (std::size_t q = 0; q < requirement.violation.size(); ++q)
    requirement.violation[q] = results.uncertain[q].upper;  // whatever it was sampled as
  EXPECT_THAT(sentenceOf(results),
              HasSubstr("In an extreme combination of the tolerances (point 1 of the alpha-cuts) it misses"));
}

TEST(ViolationFacts, AreWhatTheSentenceSays) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::met);
  EXPECT_FALSE(violationFacts(results).front());
  results.requirements.front().word = Decision::open;
  EXPECT_FALSE(violationFacts(results).front());
  RequirementResult& requirement = results.requirements.front();
  requirement.word = Decision::partly;
  EXPECT_EQ(violationFacts(results).front()->what, "in some cases, \u201ca\u201d does not stay above 1 m");
  EXPECT_EQ(violationFacts(results).front()->likely, "");
  EXPECT_EQ(violationFacts(results).front()->missed, "");
  requirement.probabilityLower = 0.9227;
  requirement.probabilityUpper = 0.9306;
  requirement.samples = 4096;
  requirement.violating = 307;
  requirement.violation.front() = 2.3;
  requirement.violationSample = 17;
  requirement.violationTime = 0.5;
  requirement.violationLower = requirement.violationUpper = -0.25;
  EXPECT_EQ(violationFacts(results).front()->likely,
            "6.94 to 7.74 % of all cases, proved; 307 of 4096 simulated cases at the output times");
  requirement.shareLower = 0.9163;
  requirement.shareUpper = 0.9331;
  EXPECT_THAT(
      violationFacts(results).front()->likely,
      EndsWith("; 307 of 4096 simulated cases at the output times, so 6.6 to 8.4 % of all with 95 % confidence"));
  requirement.shareLower = requirement.shareUpper = RequirementResult::unknown;
  EXPECT_EQ(violationFacts(results).front()->missed, "the limit by 0.25 rad at 0.5 s, in one simulated case");
  requirement.probabilityUpper = 1;
  EXPECT_THAT(violationFacts(results).front()->likely, StartsWith("7.74 % at most of all cases, proved"));
  requirement.probabilityLower = 0;  // nothing is known
  EXPECT_EQ(violationFacts(results).front()->likely, "307 of 4096 simulated cases at the output times");
  requirement.probabilityUpper = 0.004;
  EXPECT_THAT(violationFacts(results).front()->likely,
              StartsWith("in all cases but for a probability of 0.0041 at most"));
  requirement.word = Decision::violated;
  requirement.violating = 4096;
  EXPECT_EQ(violationFacts(results).front()->likely, "always; 4096 of 4096 simulated cases at the output times");
}

/// Outward: a share of all cases that is told holds what is proved of it.
TEST(ViolationFacts, RoundSharesOutward) {
  RequirementResult requirement;
  for (const double share : {1e-9, 3e-5, 0.0001, 0.0123, 0.07, 0.1, 0.3333, 0.5, 0.77, 0.9999})
    for (const double gap : {0.0, 1e-7, 0.0005, 0.01}) {
      requirement.probabilityLower = std::max(0.0, 1 - share - gap);
      requirement.probabilityUpper = 1 - share;
      const std::string text = violationShare(requirement);
      const double from = std::stod(text), to = std::stod(text.substr(text.find(" to ") + 4));
      if (text.find(" to ") == std::string::npos) continue;
      EXPECT_LE(from, 100 * (1 - requirement.probabilityUpper)) << text;
      EXPECT_GE(to, 100 * (1 - requirement.probabilityLower)) << text;
    }
}

TEST(PlainRequirement, TellsAMissInTheMarginsUnitAndInThatOfTheLimit) {
  const auto sentence = [](std::vector<MarginInfo> margins, const char* unit = "rad") {
    Results results = withRequirement(std::move(margins), Decision::partly);
    results.outputs[results.requirements.front().margin].unit = unit;
    RequirementResult& requirement = results.requirements.front();
    requirement.violation.front() = 2.3;
    requirement.violationTime = 0.5;
    requirement.violationLower = requirement.violationUpper = -0.25;
    return sentenceOf(results);
  };
  EXPECT_THAT(sentence({below("a", "45 deg", "deg")}),
              EndsWith(" it misses the limit by 0.25 rad (14.3 deg) at 0.5 s."));
  EXPECT_THAT(sentence({below("a", "250mrad", "mrad")}),
              EndsWith(" it misses the limit by 0.25 rad (250 mrad) at 0.5 s."));
  EXPECT_THAT(sentence({above("a", "-1e1 deg", "deg"), below("a", "1e1 deg", "deg")}),
              EndsWith(" by 0.25 rad (14.3 deg) at 0.5 s."));
  EXPECT_THAT(sentence({below("a", "45 deg", "deg")}, "deg"), EndsWith(" it misses the limit by 0.25 deg at 0.5 s."));
  EXPECT_THAT(sentence({below("a", "45°", "°")}, "deg"), EndsWith(" it misses the limit by 0.25 deg at 0.5 s."));
  EXPECT_THAT(sentence({below("a", "1 rad", "rad")}, "deg"), EndsWith(" by 0.25 deg (0.00436 rad) at 0.5 s."));
  EXPECT_THAT(sentence({below("a", "1.3 kN", "kN")}, "N"),
              EndsWith(" it misses the limit by 0.25 N (0.00025 kN) at 0.5 s."));
  for (const char* unit : {"", "mm", "rad"})
    EXPECT_THAT(sentence({below("a", "2", unit)}), EndsWith(" it misses the limit by 0.25 rad at 0.5 s.")) << unit;
}

/// What is violated nearly always must not sound as if that were an exception.
TEST(PlainRequirement, SaysHowProbableAViolationIsWhereThatIsProved) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::partly);
  RequirementResult& requirement = results.requirements.front();
  requirement.probabilityLower = 0.59371;
  requirement.probabilityUpper = 0.59789;
  EXPECT_EQ(
      sentenceOf(results),
      "In some cases, \u201ca\u201d does not stay above 1 m. The proved probability of that is 0.4021 to 0.4063.");
  EXPECT_EQ(summaryOf(results), "The requirement can be violated within the stated tolerances.");
  requirement.probabilityUpper = 1;
  EXPECT_THAT(sentenceOf(results), EndsWith("The proved probability of that is 0.4063 at most."));
  requirement.probabilityLower = 0;
  EXPECT_THAT(sentenceOf(results), EndsWith("does not stay above 1 m."));
  requirement.probabilityUpper = 9.9e-7;
  EXPECT_EQ(sentenceOf(results), "But for a probability of 1e-06 at most, \u201ca\u201d does not stay above 1 m.");
  EXPECT_EQ(summaryOf(results), "The requirement is violated, but for a probability of 1e-06 at most.");
  requirement.probabilityUpper = 0;
  EXPECT_EQ(summaryOf(results), "The requirement is violated, but for single values without any probability.");
  results.requirements.push_back(requirement);
  results.requirements.back().word = Decision::met;
  EXPECT_EQ(summaryOf(results), "1 of 2 requirements is violated but for a tiny probability; 1 is met in every case.");
  results.interval = {};  // then nothing is proved
  results.fuzzy = {};
  results.comparison = {};
  EXPECT_THAT(sentenceOf(results), StartsWith("In some cases, "));
}

TEST(PlainRequirement, ClaimsNothingThatIsOpen) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::open);
  results.requirements.front().why = "the run was interrupted";
  results.requirements.front().samples = 10;
  EXPECT_EQ(
      sentenceOf(results),
      "It is not decided whether \u201ca\u201d stays above 1 m in every case: the run was interrupted. None of 10 "
      "simulated cases was seen to miss it at the output times.");
}

TEST(PlainRequirement, SaysWhatIsSimulatedAndNotProved) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::open);
  RequirementResult& requirement = results.requirements.front();
  requirement.margin = 0;
  requirement.isViolatedInSimulation = true;
  requirement.worstSample = 17;
  requirement.worstMargin = -0.25;
  requirement.worstTime = 1.5;
  requirement.samples = 4096;
  requirement.violating = 1400;
  EXPECT_EQ(
      sentenceOf(results),
      "In simulation, \u201ca\u201d does not stay above 1 m: sample 17 misses the limit by 0.25 rad at 1.5 s. That is "
      "not proved. 1400 of 4096 simulated cases miss it at the output times.");
  EXPECT_EQ(summaryOf(results), "The requirement is violated in simulated cases, which is not proved.");
  results.requirements.push_back(requirement);
  results.requirements.back().isViolatedInSimulation = false;
  EXPECT_EQ(summaryOf(results), "1 of 2 requirements is violated in simulation, not proved; 1 is not decided.");
  const RequirementWords words = wordsOfRequirements(results).front();
  EXPECT_EQ(words.verdict, "violated in simulation, not proved");
  EXPECT_EQ(wordOfRequirements(results), Decision::open);
}

TEST(PlainRequirement, SaysHowFarItIsDecidedAndWhatMayHelp) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::open);
  RequirementResult& requirement = results.requirements.front();
  requirement.why = "all 2000 pieces that are allowed are used";
  requirement.advice = "interval.max_pieces = 8000";
  requirement.metUntil = 2.25;
  EXPECT_EQ(
      sentenceOf(results),
      "It is not decided whether \u201ca\u201d stays above 1 m in every case: all 2000 pieces that are allowed are "
      "used. It is until 2.25 s. What may help: interval.max_pieces = 8000.");
  const RequirementWords words = wordsOfRequirements(results).front();
  EXPECT_EQ(
      words.guaranteed,
      "neither proved nor refuted: all 2000 pieces that are allowed are used (what may help: interval.max_pieces = "
      "8000); met until 2.25 s of 3 s");
  EXPECT_EQ(words.probable, "nothing is proved of the probability");
  EXPECT_EQ(words.possible, "nothing is proved of the possibility");
  results.requirements[0].probabilityUpper = 0.99997;  // would be told as 1
  results.requirements[0].violationLeast = 1e-5;
  EXPECT_EQ(wordsOfRequirements(results)[0].probable, "nothing is proved of the probability");
  EXPECT_EQ(wordsOfRequirements(results)[0].possible, "nothing is proved of the possibility");
}

TEST(PlainRequirement, IsEstimatedWhereTheProofEnds) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::open);
  results.interval.present = true;
  results.interval.reached = 0.447;
  RequirementResult& requirement = results.requirements.front();
  requirement.metUntil = 0.44;
  requirement.estimate = {4096, 4096, 0, 0.99909984, 1, 1};
  const RequirementWords words = wordsOfRequirements(results).front();
  EXPECT_EQ(words.verdict, "not proved behind 0.44 s");
  EXPECT_EQ(words.estimated,
            "of 4096 independent samples 4096 meet it at the output times: a probability of at least 0.99909 with 95 % "
            "confidence (sampled, not proved); to first order more than 0.9999");
  EXPECT_THAT(sentenceOf(results), HasSubstr("By simulated cases alone, which prove nothing, it is met with a "
                                             "probability of at least 0.99909 (95 % confidence)."));
  requirement.estimate = {1024, 640, 380, 0.59001, 0.66001, 0.625};
  EXPECT_EQ(
      wordsOfRequirements(results).front().estimated,
      "of 1024 independent samples 640 meet it at the output times, 4 did not arrive: a probability of 0.59001 to "
      "0.66001 with 95 % confidence (sampled, not proved); to first order 0.625");
  requirement.metUntil = std::nan("");
  EXPECT_EQ(wordsOfRequirements(results).front().verdict, "not proved");
  requirement.until = 0.4;
  EXPECT_EQ(wordsOfRequirements(results).front().verdict, "open");
  requirement.word = Decision::met;
  EXPECT_EQ(wordsOfRequirements(results).front().estimated, "");
}

/// What ended the run says nothing against what is proved.
TEST(PlainRequirement, GluesNoReasonToAViolationThatIsProved) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::partly);
  results.requirements.front().why = "the time limit of 1 s CPU for the whole run was reached";
  EXPECT_EQ(wordsOfRequirements(results).front().guaranteed, "violated for some values");
  EXPECT_EQ(wordsOfRequirements(results).front().probable,
            "nothing is proved of the probability: the time limit of 1 s CPU for the whole run was reached");
}

TEST(RequirementWords, SpeakOfInstantsWhereTimePasses) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::met);
  EXPECT_EQ(wordsOfRequirements(results).front().guaranteed, "met for every value, at every instant");
  results.horizon = 0;
  EXPECT_EQ(wordsOfRequirements(results).front().guaranteed, "met for every value");
}

TEST(RequirementWords, SayOfTheirCardWhatItIs) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::partly);
  const auto state = [&] { return stateOf(results.requirements.front()); };
  EXPECT_EQ(state(), "violated");
  results.requirements.front().word = Decision::violated;
  EXPECT_EQ(state(), "violated");
  results.requirements.front().word = Decision::open;
  EXPECT_EQ(state(), "open");
  results.requirements.front().isViolatedInSimulation = true;
  results.requirements.front().worstSample = 3;
  EXPECT_EQ(state(), "violated in simulation");
}

TEST(RequirementWords, SayWithWhichTolerancesItHolds) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::partly);
  RequirementResult& requirement = results.requirements.front();
  requirement.factor = 0;
  EXPECT_EQ(shrinkSentence(requirement), "");
  requirement.factor = 0.58399;
  EXPECT_EQ(shrinkSentence(requirement),
            " It is met in every case if all tolerances shrink to 58.3 % of what is stated.");
  requirement.word = Decision::met;
  EXPECT_EQ(shrinkSentence(requirement), "");
}

TEST(RequirementWords, TellANarrowerToleranceAsItIsStated) {
  UncertainInfo quantity{"damper", "c", "N s/m", 1350, 1500, 1650, "uniform", "triangular"};
  EXPECT_EQ(narrowedText(quantity, 1), "± 10 %");
  EXPECT_EQ(narrowedText(quantity, 0.12345), "± 1.23 %");  // rounded down
  quantity.stated = "± 10 %";
  EXPECT_EQ(narrowedText(quantity, 0.5), "± 5 %");
  quantity.stated = "± 150 N s/m";
  EXPECT_EQ(narrowedText(quantity, 0.5), "± 75 N s/m");
  quantity.stated = "[1350 N s/m, 1650 N s/m]";
  EXPECT_EQ(narrowedText(quantity, 0.5), "[1425, 1575] N s/m");
  EXPECT_EQ(narrowedText(quantity, 0.01285), "[1498.08, 1501.92] N s/m");
  quantity.upper = 1560;
  quantity.stated = "+ 4 / - 10 %";
  EXPECT_EQ(narrowedText(quantity, 0.5), "[1425, 1530] N s/m");
  UncertainInfo angle{"start", "q", "rad", -0.0174532925199433, 0, 0.0174532925199433, "uniform", "triangular"};
  angle.told = "deg";
  angle.stated = "± 1 deg";
  EXPECT_EQ(narrowedText(angle, 0.3001), "± 0.3 deg");
  angle.stated.clear();
  EXPECT_EQ(narrowedText(angle, 0.3001), "± 0.3 deg");
}

TEST(RequirementWords, SayWhichToleranceWouldDoAlone) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::partly);
  RequirementResult& requirement = results.requirements.front();
  results.uncertain.assign(4, {"spring", "k", "N/m", 96, 100, 104, "uniform", "triangular"});
  results.uncertain[1].name = "damper";
  results.uncertain[1].stated = "+/- 4 %";
  EXPECT_EQ(aloneSentence(results, requirement), "");  // of an older file
  requirement.aloneLower.assign(4, 0);
  requirement.aloneUpper.assign(4, 1);
  EXPECT_EQ(aloneSentence(results, requirement), "");  // nothing is known
  requirement.aloneUpper.assign(4, 0);
  EXPECT_EQ(aloneSentence(results, requirement), " No tolerance would do alone, however tight.");
  EXPECT_EQ(holdsText(results, requirement), "by no tolerance alone, however tight");
  requirement.factor = 0.58399;
  EXPECT_EQ(holdsText(results, requirement),
            "if all tolerances shrink to 58.3 % of what is stated; by none alone, however tight");
  requirement.aloneLower = {0.25, 0.5, 0, 0};
  requirement.aloneUpper = {0.25, 0.75, 0, 1};
  EXPECT_EQ(aloneSentence(results, requirement),
            " One tolerance alone would do: damper at ± 2 % instead of +/- 4 %, or spring at ± 1 % instead of ± 4 %.");
  EXPECT_EQ(holdsText(results, requirement),
            "if all tolerances shrink to 58.3 % of what is stated, or damper alone shrinks from +/- 4 % to ± 2 %, or "
            "spring alone shrinks "
            "from ± 4 % to ± 1 %");
  requirement.factor = 0;
  EXPECT_THAT(holdsText(results, requirement), StartsWith("if damper alone shrinks from"));
  requirement.word = Decision::met;
  EXPECT_EQ(aloneSentence(results, requirement), "");
  EXPECT_EQ(holdsText(results, requirement), "");
}

TEST(PlainSummary, CountsRequirements) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::met);
  EXPECT_EQ(summaryOf(results), "The requirement is met in every case that the stated tolerances allow.");
  results.requirements.push_back(results.requirements.front());
  EXPECT_EQ(summaryOf(results), "Both requirements are met in every case that the stated tolerances allow.");
  results.requirements.back().word = Decision::partly;
  EXPECT_EQ(summaryOf(results),
            "1 of 2 requirements can be violated within the stated tolerances; 1 is met in every case.");
  results.requirements.front().word = Decision::open;
  EXPECT_EQ(summaryOf(results), "1 of 2 requirements can be violated within the stated tolerances; 1 is not decided.");
}

TEST(PlainSummary, WithoutRequirementsSaysWhereAnOutputStays) {
  Results results = example::pendulum();
  EXPECT_THAT(summaryOf(results), StartsWith("\u201cshoulder angle\u201d stays between -"));
  EXPECT_THAT(summaryOf(results),
              HasSubstr("from 0 s to 3 s in every case that the stated tolerances allow. It is least between 1.5 s and "
                        "1.55 s, greatest between 0 s and 0.05 s. At any"));
  results.interval = {};
  EXPECT_THAT(summaryOf(results), StartsWith("In 4099 simulated cases, \u201cshoulder"));
  EXPECT_THAT(summaryOf(results), HasSubstr("; nothing is proved of other cases."));
  results.stochastic = {};
  EXPECT_THAT(summaryOf(results), HasSubstr("in every case that is held possible"));
  results.fuzzy = {};
  EXPECT_THAT(summaryOf(results), StartsWith("Nothing certain is known"));
  EXPECT_THAT(plainSummary(Results{}, judge(Results{}), 0), StartsWith("Nothing was computed."));
  EXPECT_THAT(plainSummary(example::kinematics(), judge(example::kinematics()), 0), HasSubstr("lies between"));
}

TEST(PlainSummary, SaysThatARunEndedEarly) {
  Results results = example::pendulum();
  results.interval.reached = 1.5;
  results.interval.why = "the run was interrupted";
  for (std::size_t i = 31; i < 61; ++i)
    for (std::size_t k = 0; k < results.outputs.size(); ++k)
      for (Bounds* bounds : {&results.interval.at, &results.interval.over})
        bounds->lower(i, k) = bounds->upper(i, k) = std::nan("");
  EXPECT_THAT(summaryOf(results), HasSubstr("from 0 s to 1.5 s in every case"));
  EXPECT_THAT(summaryOf(results),
              EndsWith("The computation is incomplete, and what it says of all cases ends at 1.5 s of 3 s: "
                       "the run was interrupted."));
  results.interval = example::pendulum().interval;
  results.stopped = "the run goes on";
  EXPECT_THAT(summaryOf(results), EndsWith(" The computation is incomplete: the run goes on."));
}

TEST(PlainSummary, TellsNobodyToRelyOnWhatWasRefuted) {
  Results results = withRequirement({above("a", "1 m", "m")}, Decision::met);
  results.stochastic.envelope.upper(40, 1) = results.interval.at.upper(40, 1) + 1;
  EXPECT_THAT(summaryOf(results), EndsWith("Do not rely on them."));
  EXPECT_THAT(summaryOf(results), Not(HasSubstr("is met")));
}

}  // namespace
}  // namespace gamut
