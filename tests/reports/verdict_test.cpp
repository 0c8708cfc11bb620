// The verdict from stored numbers: what counts as outside, what is in doubt, what is missing, and what people are told.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "reports/json.hpp"
#include "reports/plain.hpp"
#include "reports/report.hpp"
#include "reports/verdict.hpp"
#include "studies/analyses/derivatives.hpp"
#include "studies/analyses/witness.hpp"
#include "studies/results/extremes.hpp"
#include "studies/words.hpp"
#include "tests/reports/example_results.hpp"

namespace gamut {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Case {
  std::string name;
  std::function<void(Results&)> change;
  Agreement word;
};

void PrintTo(const Case& c, std::ostream* stream) { *stream << c.name; }

class VerdictOf : public ::testing::TestWithParam<Case> {};

TEST_P(VerdictOf, IsTheWordExpected) {
  Results results = example::pendulum();
  GetParam().change(results);
  const Verdict verdict = judge(results);
  EXPECT_EQ(verdict.word, GetParam().word) << verdict.sentence;
  EXPECT_THAT(verdict.sentence, Not(IsEmpty()));
  EXPECT_EQ(verdict.excursion.distance > 0,
            verdict.word == Agreement::outside || verdict.word == Agreement::unresolved);
}

/// Raises the envelope at one point to lie this far above the enclosure.
void leave(Results& results, double distance) {
  results.stochastic.envelope.upper(40, 1) = results.interval.at.upper(40, 1) + distance;
}

/// Adds a sample that was disputed at that point.
DisputedSample& dispute(Results& results, double distance, Decider decided) {
  DisputedSample& sample = results.comparison.disputed.emplace_back();
  sample.number = 17;
  sample.time = 40;
  sample.output = 1;
  sample.lower = results.interval.at.lower(40, 1);
  sample.upper = results.interval.at.upper(40, 1);
  sample.value = sample.upper + distance;
  sample.distance = distance;
  sample.error = distance;
  sample.decided = decided;
  sample.farthest.assign(results.outputs.size(), 0.0);
  sample.farthest[1] = distance;
  return sample;
}

const Case cases[] = {
    {"AllInside", [](Results&) {}, Agreement::inside},
    {"TouchingTheBoundIsInside", [](Results& r) { leave(r, 0); }, Agreement::inside},
    {"ExcursionBeyondTheError", [](Results& r) { leave(r, 1e-6); }, Agreement::outside},
    {"ExcursionWithinTheError", [](Results& r) { leave(r, 0.5e-11); }, Agreement::outside},
    {"ExcursionByOneUlpAbove",
     [](Results& r) {
       r.stochastic.envelope.upper(40, 1) =
           std::nextafter(r.interval.at.upper(40, 1), std::numeric_limits<double>::infinity());
     },
     Agreement::outside},
    {"ExcursionByOneUlpBelow",
     [](Results& r) {
       r.stochastic.envelope.lower(40, 1) =
           std::nextafter(r.interval.at.lower(40, 1), -std::numeric_limits<double>::infinity());
     },
     Agreement::outside},
    {"ExcursionFromAnAlphaCutByOneUlp",
     [](Results& r) {
       r.fuzzy.inner[2].upper(40, 1) =
           std::nextafter(r.fuzzy.outer[2].upper(40, 1), std::numeric_limits<double>::infinity());
     },
     Agreement::outside},
    {"InfiniteBound", [](Results& r) { r.interval.at.upper(40, 1) = std::numeric_limits<double>::infinity(); },
     Agreement::incomplete},
    {"InfiniteBoundBetweenTimes",
     [](Results& r) { r.interval.over.lower(40, 1) = -std::numeric_limits<double>::infinity(); },
     Agreement::incomplete},
    {"InfiniteAlphaCut", [](Results& r) { r.fuzzy.outer[2].upper(40, 1) = std::numeric_limits<double>::infinity(); },
     Agreement::incomplete},
    {"InfinitePlainIntervals",
     [](Results& r) {
       r.interval.direct = r.interval.at;
       r.interval.direct.upper(40, 1) = std::numeric_limits<double>::infinity();
     },
     Agreement::inside},
    {"ExcursionAtTheFirstTime", [](Results& r) { r.stochastic.envelope.lower(0, 0) -= 1; }, Agreement::outside},
    {"ExcursionAtTheLastTime", [](Results& r) { r.stochastic.envelope.lower(60, 1) -= 1; }, Agreement::outside},
    {"InfiniteSample", [](Results& r) { r.stochastic.envelope.upper(3, 0) = std::numeric_limits<double>::infinity(); },
     Agreement::outside},
    {"ExcursionFromTheTubeAlone", [](Results& r) { r.interval.over.upper(41, 1) = -10; }, Agreement::outside},
    {"ExcursionFromAnAlphaCutAlone", [](Results& r) { r.fuzzy.inner[5].upper(40, 1) += 0.1; }, Agreement::outside},
    {"ExcursionAfterTheEnclosureEnded",
     [](Results& r) {
       r.interval.reached = 1;
       leave(r, 1);
     },
     Agreement::incomplete},
    {"DisputedAndOutside", [](Results& r) { dispute(r, 1e-6, Decider::inDoubles).outside = true; }, Agreement::outside},
    {"DisputedAndUnresolved",
     [](Results& r) {
       leave(r, 1e-6);
       dispute(r, 1e-6, Decider::unresolved);
     },
     Agreement::unresolved},
    {"DisputedAndSettledInside", [](Results& r) { dispute(r, 0, Decider::inDoubles); }, Agreement::inside},
    {"DisputedAndSettledInsideButStoredOutside",
     [](Results& r) {
       leave(r, 1e-6);
       dispute(r, 1e-6, Decider::inDoubles);
     },
     Agreement::outside},
    {"DisputedAndInterrupted",
     [](Results& r) {
       leave(r, 1e-6);
       dispute(r, 1e-6, Decider::interrupted);
     },
     Agreement::incomplete},
    {"OutsideByRounding",
     [](Results& r) {
       leave(r, 1e-6);
       dispute(r, 1e-6, Decider::rounding);
     },
     Agreement::inside},
    {"RoundingExcusesNoMore",
     [](Results& r) {
       leave(r, 2e-6);
       dispute(r, 1e-6, Decider::rounding);
     },
     Agreement::outside},
    {"AnUnresolvedSampleExcusesNoOtherOutput",
     [](Results& r) {
       r.stochastic.envelope.upper(40, 0) = r.interval.at.upper(40, 0) + 1e-6;
       dispute(r, 1e-3, Decider::unresolved);
     },
     Agreement::outside},
    {"AnInterruptedSampleExcusesNoOtherOutput",
     [](Results& r) {
       r.stochastic.envelope.upper(40, 0) = r.interval.at.upper(40, 0) + 1e-6;
       dispute(r, 1e-3, Decider::interrupted);
     },
     Agreement::outside},
    {"AnInterruptedSampleMayLieOutsideInEveryOutput",
     [](Results& r) {
       leave(r, 1e-6);
       r.stochastic.envelope.upper(41, 0) = r.interval.at.upper(41, 0) + 2e-6;
       dispute(r, 1e-6, Decider::interrupted).farthest = {2e-6, 1e-6};
     },
     Agreement::incomplete},
    {"AnUnresolvedSampleMayLieOutsideInEveryOutput",
     [](Results& r) {
       leave(r, 1e-6);
       r.stochastic.envelope.upper(41, 0) = r.interval.at.upper(41, 0) + 2e-6;
       dispute(r, 1e-6, Decider::unresolved).farthest = {2e-6, 1e-6};
     },
     Agreement::unresolved},
    {"AnInterruptedSampleExcusesNoMoreThanItsDistance",
     [](Results& r) {
       leave(r, 1e-6);
       dispute(r, 0.9e-6, Decider::interrupted);
     },
     Agreement::outside},
    {"AnUnresolvedSampleExcusesNoMoreThanItsDistance",
     [](Results& r) {
       leave(r, 1e-6);
       dispute(r, 0.9e-6, Decider::unresolved);
     },
     Agreement::outside},
    {"InterruptedBeforeAnAlphaCut",
     [](Results& r) {
       r.fuzzy.inner[2].upper(40, 1) = r.fuzzy.outer[2].upper(40, 1) + 1e-9;
       dispute(r, 1.1e-9, Decider::interrupted).level = 2;
     },
     Agreement::incomplete},
    {"InterruptedBeforeAnotherAlphaCut",
     [](Results& r) {
       r.fuzzy.inner[2].upper(40, 1) = r.fuzzy.outer[2].upper(40, 1) + 1e-9;
       dispute(r, 1.1e-9, Decider::interrupted).level = 3;
     },
     Agreement::outside},
    {"SamplingStopped",
     [](Results& r) {
       r.stochastic.integrated = 100;
       r.stochastic.stopped = "the run was interrupted";
     },
     Agreement::incomplete},
    {"EnclosureEndsEarly", [](Results& r) { r.interval.reached = 2.3; }, Agreement::incomplete},
    {"SamplesEndEarly", [](Results& r) { r.stochastic.reached = 2.3; }, Agreement::incomplete},
    {"AlphaCutsEndEarly", [](Results& r) { r.fuzzy.reached = 2.3; }, Agreement::incomplete},
    {"NumberMissingBeforeTheEnd", [](Results& r) { r.interval.at.lower(7, 0) = none; }, Agreement::incomplete},
    {"NoInterval", [](Results& r) { r.interval = {}; }, Agreement::inside},
    {"NoFuzzy", [](Results& r) { r.fuzzy = {}; }, Agreement::inside},
    {"NoComparison", [](Results& r) { r.comparison = {}; }, Agreement::inside},
    {"NoStochastic",
     [](Results& r) {
       r.stochastic = {};
       r.fuzzy.inner.clear();
     },
     Agreement::incomplete},
    {"OnlySamples", [](Results& r) { r.interval = {}, r.fuzzy = {}; }, Agreement::incomplete},
    {"NothingAtAll", [](Results& r) { r = {}; }, Agreement::incomplete},
    {"Kinematics", [](Results& r) { r = example::kinematics(); }, Agreement::inside},
    {"KinematicsOutsidePlainIntervals",
     [](Results& r) {
       r = example::kinematics();
       r.interval.direct.lower(0, 1) = r.interval.direct.upper(0, 1);
     },
     Agreement::outside},
};

INSTANTIATE_TEST_SUITE_P(Verdict, VerdictOf, ::testing::ValuesIn(cases),
                         [](const auto& tested) { return tested.param.name; });

TEST(Verdict, SaysHowManyMotionsStayedInsideHowLongAndHowTight) {
  const Verdict verdict = judge(example::pendulum());
  EXPECT_EQ(verdict.sentence,
            "All 4099 sampled motions stay inside the guaranteed enclosure from 0 s to 3 s; at the output times the "
            "guarantee is at most 1.004 times as wide as the sampled extremes.");
  EXPECT_THAT(verdict.notes, IsEmpty());
  EXPECT_EQ(verdict.reached, 3);
  Results worst = example::pendulum();
  worst.stochastic.switching.present = true;
  EXPECT_THAT(judge(worst).sentence,
              ::testing::EndsWith(" at most 1.004 times as wide as the sampled extremes, worst courses included."));
  Results tight = example::pendulum();
  for (double& ratio : tight.comparison.overestimation.data) ratio = 1 + 2e-12;
  EXPECT_THAT(judge(tight).sentence,
              ::testing::EndsWith("; at the output times the guarantee is no wider than the sampled extremes."));
  for (double& ratio : tight.comparison.overestimation.data) ratio = 1;
  EXPECT_THAT(judge(tight).sentence,
              ::testing::EndsWith("; at the output times the guarantee is no wider than the sampled extremes."));
}

/// Of what no sample is compared with.
TEST(Verdict, SaysHowMuchWiderTheGuaranteeIsBetweenOutputTimes) {
  Results results = example::pendulum();
  ASSERT_FALSE(results.interval.over.empty());
  const std::optional<MotionRange> range = motionRange(results, 0, MotionRange::Source::ofProof);
  ASSERT_TRUE(range);
  results.interval.over.upper(2, 0) = range->least.value + 1.5 * range->widthAtTimes;
  EXPECT_THAT(judge(results).notes,
              ElementsAre("Between output times " + results.outputs[0].name +
                          " is guaranteed within a range 1.5 times as wide as at them; no sample looks there, and "
                          "more output times (study.output_step) tell it more closely."));
  results.interval.over.upper(2, 0) = range->least.value + 1.04 * range->widthAtTimes;
  EXPECT_THAT(judge(results).notes, IsEmpty());
}

/// Shares of 4096 independent samples beside proved bounds of their probability.
Results withShares(double excess) {
  Results results = example::pendulum();
  results.stochastic.samples = 4096;
  DistributionResult& d = results.distribution;
  d.present = true;
  d.band = 0.0212;
  d.time = {results.time[20]};
  d.point = {0, 1};
  d.value = Grid({1, 2, 2}, {0, 1, 0, 1});
  d.lower = d.sampled = d.upper = d.value;
  d.gaps = Grid({1, 2}, {0, 0});
  d.excess = Grid({1, 2}, {0, excess});
  return results;
}

TEST(Verdict, CountsSharesOfSamplesWhereBadLuckCannotBe) {
  EXPECT_EQ(judge(withShares(0.02)).word, Agreement::inside);
  EXPECT_THAT(judge(withShares(0.02)).notes, Not(Contains(HasSubstr("shares"))));
  const Verdict lucky = judge(withShares(0.03));  // √(ln(4/0.05)/8192) = 0.023
  EXPECT_EQ(lucky.word, Agreement::inside);
  EXPECT_THAT(lucky.notes, Contains(HasSubstr("leave the proved bounds of probability by up to 0.03 in")));
  const Verdict wrong = judge(withShares(0.06));  // √(ln(4e9)/8192) = 0.052
  EXPECT_EQ(wrong.word, Agreement::outside);
  EXPECT_THAT(wrong.sentence, HasSubstr("up to 0.06 outside the proved bounds of its probability in"));
  Results dependent = withShares(0.06);
  dependent.distribution.band = 0;
  EXPECT_EQ(judge(dependent).word, Agreement::inside);
}

TEST(Verdict, SaysWhereAGuaranteeSaysLittle) {
  Results results = example::pendulum();
  results.comparison.overestimation.data.back() = 1234.5;
  EXPECT_THAT(
      judge(results).sentence,
      HasSubstr(
          ", but at the output times the guarantee says little: for some output it is at most 1235 times as wide"));
}

TEST(Verdict, SpeaksOfPositionsWhereNothingMoves) {
  EXPECT_THAT(
      judge(example::kinematics()).sentence,
      AllOf(HasSubstr("All 4099 sampled positions stay inside the guaranteed enclosure;"), Not(HasSubstr(" s to "))));
}

TEST(Verdict, SaysNoUnitOfPlainNumbers) {
  Results results = example::pendulum(61, 2);
  results.outputs[1].unit = "1";
  leave(results, 1e-6);
  EXPECT_THAT(judge(results).sentence, Not(HasSubstr(" 1 outside")));
  EXPECT_THAT(renderReport(results), Not(HasSubstr(results.outputs[1].name + " (1)")));
}

TEST(Verdict, NamesTheOutputOfWhichNothingFiniteIsGuaranteed) {
  Results results = example::pendulum(61, 2);
  results.interval.at.upper(40, 1) = results.interval.at.upper(41, 1) = std::numeric_limits<double>::infinity();
  results.comparison.overestimation(40, 1) = std::numeric_limits<double>::infinity();
  const Verdict verdict = judge(results);
  EXPECT_EQ(verdict.word, Agreement::incomplete);
  EXPECT_TRUE(std::isfinite(verdict.overestimation));
  EXPECT_THAT(verdict.sentence, HasSubstr("Not every output is bounded."));
  EXPECT_THAT(verdict.notes, Contains(AllOf(HasSubstr("Nothing finite is guaranteed of " + results.outputs[1].name),
                                            HasSubstr("infinite or undefined for some values"))));
  EXPECT_EQ(whyIncomplete(results, verdict), unboundedText(results, verdict));
  EXPECT_THAT(jsonSummary(results, verdict, {}), HasSubstr("\"why\":\"nothing finite is guaranteed of "));
}

TEST(Verdict, SaysBetweenWhichTimesNothingFiniteIsGuaranteed) {
  Results results = example::pendulum(61, 2);
  results.interval.over.lower(40, 1) = -std::numeric_limits<double>::infinity();
  EXPECT_THAT(whyIncomplete(results, judge(results)), HasSubstr(" between " + timeText(results.time[39]) + " and " +
                                                                timeText(results.time[40]) + ": it may be"));
}

TEST(Verdict, OfPositionsWhoseEnclosureWasEndedIsIncompleteAndSaysWhy) {
  Results results = example::kinematics();
  results.interval.why = "the run was interrupted";
  const Verdict verdict = judge(results);
  EXPECT_EQ(verdict.word, Agreement::incomplete);
  EXPECT_THAT(verdict.sentence, HasSubstr("An analysis ended early."));
  EXPECT_THAT(verdict.notes, Contains("The enclosure ended early: the run was interrupted."));
}

TEST(Verdict, NamesOutputTimeAndDistanceOfTheFarthestExcursion) {
  Results results = example::pendulum();
  leave(results, 0.25);
  const Verdict verdict = judge(results);
  EXPECT_GE(verdict.excursion.distance, 0.25 - 1e-9);
  EXPECT_LE(verdict.excursion.distance, 0.25 + 1e-9);
  EXPECT_THAT(verdict.sentence, AllOf(HasSubstr("outside the enclosure"), HasSubstr("elbow angle at 2 s")));
}

TEST(Verdict, NamesTheBoundThatADisputedSampleLeft) {
  Results results = example::pendulum();
  DisputedSample& sample = dispute(results, 1e-6, Decider::inDoubles);
  sample.outside = true;
  EXPECT_THAT(judge(results).sentence, HasSubstr("outside the enclosure"));
  sample.level = 2;
  EXPECT_THAT(judge(results).sentence, HasSubstr("outside its alpha-cut"));
}

TEST(Verdict, SaysSoWhereTheStoredWordDisagreesAndTheFindingWins) {
  Results results = example::pendulum();
  leave(results, 1e-3);
  const Verdict verdict = judge(results);
  EXPECT_EQ(verdict.word, Agreement::outside);
  EXPECT_THAT(verdict.sentence, HasSubstr("stored as \"inside\"; their own numbers say \"outside\""));

  Results better = example::pendulum();
  better.comparison.verdict = Agreement::outside;
  EXPECT_EQ(judge(better).word, Agreement::inside);
  EXPECT_THAT(judge(better).sentence, HasSubstr("stored as \"outside\"; their own numbers say \"inside\""));
}

TEST(Verdict, NamesEveryUnresolvedSample) {
  Results results = example::pendulum();
  dispute(results, 1e-6, Decider::unresolved);
  EXPECT_THAT(judge(results).notes,
              Contains(AllOf(HasSubstr("Sample 17 (elbow angle at 2 s)"), HasSubstr("1e-06 rad"))));
}

TEST(Verdict, NamesCornersAndTheCentreAsSuch) {
  Results results = example::pendulum();
  results.stochastic.alphaCorners = 18;
  results.stochastic.integrated = results.stochastic.planned();
  for (const std::int64_t number : {4095, 4096, 4098, 4115, 4116})
    dispute(results, 1e-6, Decider::interrupted).number = number;
  EXPECT_THAT(
      judge(results).notes,
      ElementsAre(StartsWith("Sample 4095 ("), StartsWith("Corner 0 ("), StartsWith("Corner 0 of the alpha-cuts ("),
                  StartsWith("Corner 17 of the alpha-cuts ("), StartsWith("The centre (")));
  results.comparison.disputed.clear();
  EXPECT_THAT(judge(results).sentence, StartsWith("All 4117 sampled motions stay inside"));
}

TEST(Verdict, OfAFirstBlockOfSamplesIsIncompleteThoughTheyAllReachTheHorizon) {
  Results results = example::pendulum();
  results.stochastic.integrated = 259;
  results.stochastic.stopped = "interrupted";
  results.comparison.verdict = Agreement::incomplete;
  const Verdict verdict = judge(results);
  EXPECT_EQ(verdict.word, Agreement::incomplete);
  EXPECT_THAT(verdict.sentence, StartsWith("All 259 motions that were sampled stay inside the guaranteed enclosure"));
  EXPECT_THAT(verdict.notes, ElementsAre("259 of 4099 samples were taken: interrupted."));
}

TEST(Verdict, OfARunThatEndedWhileItBoundedProbabilitiesIsIncomplete) {
  Results results = example::pendulum();
  results.distribution.present = true;
  results.distribution.stopped = "the run was interrupted";
  results.comparison.verdict = Agreement::incomplete;
  const Verdict verdict = judge(results);
  EXPECT_EQ(verdict.word, Agreement::incomplete);
  EXPECT_THAT(verdict.sentence, EndsWith("Their probabilities were not bounded to the end."));
  EXPECT_THAT(verdict.notes, ElementsAre("Probabilities were not bounded to the end: the run was interrupted."));
  results.distribution.present = false;
  EXPECT_EQ(judge(results).word, Agreement::inside);
}

TEST(Verdict, OfARunThatEndedWhileItEnclosedDerivativesIsIncomplete) {
  Results results = example::pendulum();
  results.of<DerivativeResult>().present = true;
  results.of<DerivativeResult>().why =
      "the work that limits.derivatives allows is done";  // their own: that is no early end of the run
  EXPECT_EQ(judge(results).word, Agreement::inside);
  results.of<DerivativeResult>().why = results.of<DerivativeResult>().stopped = "the run was interrupted";
  results.comparison.verdict = Agreement::incomplete;
  const Verdict verdict = judge(results);
  EXPECT_EQ(verdict.word, Agreement::incomplete);
  EXPECT_THAT(verdict.sentence, EndsWith("Their derivatives were not enclosed to the end."));
  EXPECT_THAT(verdict.notes, ElementsAre("Derivatives were not enclosed to the end: the run was interrupted."));
}

TEST(Verdict, OfSamplesThatOtherEquationsContradictIsIncomplete) {
  Results results = example::pendulum();
  WitnessResult& witness = results.of<WitnessResult>();
  witness.present = true;
  witness.number = {0};
  witness.apart = Grid({1, results.outputs.size()}, std::vector<double>(results.outputs.size(), 1e-9));
  witness.error = Grid({1, results.outputs.size()}, std::vector<double>(results.outputs.size(), 1e-8));
  witness.size.assign(results.outputs.size(), 1.0);
  EXPECT_EQ(judge(results).word, Agreement::inside);
  witness.apart.data.back() = 1e-7;
  witness.why = "sample 0 differs by 1e-07 of 'x' from itself in balance, which errors of 1e-08 do not explain";
  results.comparison.verdict = Agreement::incomplete;
  const Verdict verdict = judge(results);
  EXPECT_EQ(verdict.word, Agreement::incomplete);
  EXPECT_THAT(verdict.sentence, EndsWith("Their differences from themselves in balance are more than errors explain."));
  EXPECT_THAT(verdict.notes,
              ElementsAre("Differences from themselves in balance are more than errors explain: " + witness.why + "."));
  EXPECT_THAT(plainSummary(results, verdict, 0), EndsWith("The computation is incomplete: " + witness.why + "."));
}

TEST(Verdict, OfARunThatWasStoppedIsIncompleteWhateverIsMissing) {
  Results results = example::pendulum();
  results.stopped = "the run was interrupted";
  results.comparison.verdict = Agreement::incomplete;
  const Verdict verdict = judge(results);
  EXPECT_EQ(verdict.word, Agreement::incomplete);
  EXPECT_THAT(verdict.sentence, EndsWith("Not all was done: the run was interrupted."));
}

/// Where nothing was enclosed but the start, no sample seemed outside of anything.
TEST(Verdict, OfARunThatEndedAtTheStartNamesNoSamples) {
  Results results = example::pendulum();
  results.interval.reached = 0;
  results.interval.why = "the run was interrupted";
  dispute(results, 1e-6, Decider::interrupted);
  results.comparison.verdict = Agreement::incomplete;
  const Verdict verdict = judge(results);
  EXPECT_THAT(verdict.sentence,
              StartsWith("Nothing could be compared: an analysis ended before the first output time"));
  EXPECT_THAT(verdict.notes, ::testing::Not(::testing::Contains(HasSubstr("seemed outside"))));
  results.interval.reached = 1.5;
  EXPECT_THAT(judge(results).notes, ::testing::Contains(HasSubstr("seemed outside")));
}

TEST(Verdict, SaysOnceThatNoSampleWasTaken) {
  Results results = example::pendulum();
  results.stochastic.integrated = 0;
  results.stochastic.reached = 0;
  results.stochastic.stopped = "the run was interrupted";
  results.comparison.verdict = Agreement::incomplete;
  EXPECT_THAT(judge(results).notes, ElementsAre("0 of 4099 samples were taken: the run was interrupted."));
}

TEST(Verdict, AsksForUnitsWhereALimitLetHardlyAnyMotionThrough) {
  Results results = example::pendulum();
  results.interval.reached = 1e-5;
  results.interval.why = "the time limit of 10 s CPU for the enclosure was reached";
  results.interval.advice = "a greater limits.enclosure_time";
  EXPECT_THAT(judge(results).notes, ::testing::Contains("The enclosure came through 0.00033 % of the horizon: is that "
                                                        "meant to be 3 s, and are the units meant as they are?"));
  results.interval.reached = 1.5;
  EXPECT_THAT(judge(results).notes, ::testing::Not(::testing::Contains(HasSubstr("% of the horizon"))));
}

TEST(Verdict, CountsTheSettledSamplesInOneLineAndNamesTheNearestBesides) {
  Results results = example::pendulum();
  for (int i = 0; i < 200; ++i) {  // of two bounds each
    DisputedSample& sample = dispute(results, 0, Decider::inDoubles);
    sample.number = i / 2;
    sample.value = sample.upper - (i == 187 ? 1e-6 : 2e-6);
  }
  dispute(results, 1e-6, Decider::unresolved);
  const Verdict verdict = judge(results);
  ASSERT_EQ(verdict.notes.size(), 2U);
  EXPECT_THAT(verdict.notes.front(), HasSubstr("could not be decided"));
  EXPECT_EQ(verdict.notes.back(),
            "100 samples on the boundary were integrated again, more accurately: all lie inside.");
  EXPECT_EQ(verdict.settledNote, 1);
  EXPECT_THAT(
      verdict.settled,
      ElementsAre(
          "Sample 93 (elbow angle at 2 s): inside by 1e-06 rad, decided by a Taylor series in double precision.",
          "Sample 0 and 98 more (elbow angle at 2 s): inside by 2e-06 rad, decided by a Taylor series in double "
          "precision.",
          "The results name them all, in /comparison/disputed."));
  Results different = example::pendulum();
  for (int i = 0; i < 30; ++i) {
    DisputedSample& sample = dispute(different, 0, Decider::inDoubles);
    sample.number = i;
    sample.value = sample.upper - 1e-6 * (i + 1);
  }
  EXPECT_EQ(judge(different).settled.size(), 21U);
  Results other = example::pendulum();
  dispute(other, 1e-6, Decider::inDoubles);
  EXPECT_THAT(judge(other).notes,
              ElementsAre("1 sample on the boundary was integrated again, more accurately: it lies inside."));
  EXPECT_EQ(judge(other).settled.size(), 1U);
  dispute(other, 1e-9, Decider::rounding).number = 18;
  EXPECT_THAT(judge(other).notes, ElementsAre(HasSubstr("it lies inside; 1 more outside by no more than rounding.")));
}

TEST(Verdict, NamesTheWorstOfManyThatLieOutsideOrCouldNotBeDecidedAndCountsTheOthers) {
  Results results = example::pendulum();
  for (int i = 0; i < 300; ++i) {
    DisputedSample& sample =
        dispute(results, i == 200 ? 4e-6 : 2e-6, i < 150 ? Decider::inDoubles : Decider::unresolved);
    sample.number = i;
    sample.error = i == 100 ? 1e-9 : 1e-8;
    sample.outside = i < 150;
  }
  for (int i = 0; i < 300; ++i) {  // each leaves two bounds
    DisputedSample again = results.comparison.disputed[static_cast<std::size_t>(i)];
    again.distance *= 0.5;
    results.comparison.disputed.push_back(again);
  }
  const std::vector<std::string> notes = judge(results).notes;
  ASSERT_EQ(notes.size(), 12U);
  EXPECT_THAT(notes[0], StartsWith("Sample 100 (elbow angle at 2 s) lies outside by 2e-06 rad"));
  EXPECT_THAT(notes[1], StartsWith("Sample 0 ("));
  EXPECT_THAT(notes[5], StartsWith("145 more are outside; the results name them all"));
  EXPECT_THAT(notes[6], StartsWith("Sample 200 (elbow angle at 2 s) could not be decided: it lies outside by 4e-06"));
  EXPECT_THAT(notes[11], StartsWith("145 more could not be decided; the results name them all"));
}

TEST(Verdict, SaysHowWideTheGuaranteeIsWhereSamplesCoincide) {
  Results results = example::pendulum();
  EXPECT_THAT(judge(results).notes, Not(Contains(HasSubstr("no ratio is told"))));
  results.comparison.overestimation(2, 0) = none;
  EXPECT_THAT(judge(results).notes, Contains(HasSubstr("no ratio is told: of shoulder angle at 0.1 s")));
}

TEST(Verdict, ClaimsNothingOfMotionsThatEndedAtTheStart) {
  Results results = example::pendulum();
  results.stochastic.reached = 0;
  results.stochastic.why = "interrupted";
  for (double& number : results.stochastic.envelope.lower.data) number = none;
  for (double& number : results.stochastic.envelope.upper.data) number = none;
  const Verdict verdict = judge(results);
  EXPECT_EQ(verdict.word, Agreement::incomplete);
  EXPECT_THAT(verdict.sentence,
              StartsWith("Nothing could be compared: an analysis ended before the first output time. The 3 s asked"));
  EXPECT_THAT(verdict.notes, ElementsAre("The 4096 samples ended at 0 s of the 3 s asked for: interrupted."));
}

TEST(Verdict, ClaimsNothingOfTheStartAloneAndNamesATimeOnce) {
  Results results = example::pendulum();
  results.interval.reached = 0.25 * results.time[1];
  results.interval.why = "at 0.0125 s first angle grows without bound; one start: at 1.5e-2 s it does too";
  const Verdict verdict = judge(results);
  EXPECT_EQ(verdict.word, Agreement::incomplete);
  EXPECT_THAT(verdict.sentence,
              StartsWith("Nothing could be compared: an analysis ended before the first output time"));
  EXPECT_TRUE(std::isnan(verdict.overestimation));
  ASSERT_FALSE(verdict.notes.empty());
  EXPECT_THAT(verdict.notes.front(), AllOf(HasSubstr("asked for: first angle grows without bound; one start: at 1.5e"),
                                           Not(HasSubstr("at 0.0125 s first"))));
}

TEST(Verdict, CountsOnlyTheSamplesThatWereTaken) {
  Results results = example::pendulum();
  results.stochastic.integrated = 100;
  results.stochastic.stopped = "the time limit of 1800 s CPU for the whole run was reached";
  Verdict verdict = judge(results);
  EXPECT_THAT(verdict.sentence, StartsWith("All 100 motions that were sampled stay inside the guaranteed enclosure"));
  EXPECT_THAT(
      verdict.notes,
      ElementsAre("100 of 4099 samples were taken: the time limit of 1800 s CPU for the whole run was reached."));
  results.stochastic.integrated = 0;
  verdict = judge(results);
  EXPECT_EQ(verdict.sentence.find("Nothing could be compared: no sample was taken."), 0U);
}

TEST(Verdict, SaysWhyADisputeWasNotDecided) {
  Results results = example::pendulum();
  dispute(results, 1e-6, Decider::interrupted);
  results.comparison.why = "the time limit of 9 s CPU for the whole run was reached";
  const Verdict verdict = judge(results);
  EXPECT_THAT(verdict.sentence,
              StartsWith("It was not decided whether every sample stays inside: the time limit of 9 s"));
  EXPECT_THAT(verdict.notes, Contains(HasSubstr("was not decided: the time limit of 9 s CPU for the whole run")));
}

TEST(Verdict, TellsWhyAnAnalysisEndedEarly) {
  Results results = example::pendulum();
  results.interval.reached = 2.3;
  results.interval.why = "the step became too small";
  const Verdict verdict = judge(results);
  EXPECT_EQ(verdict.reached, 2.3);
  EXPECT_THAT(verdict.sentence, AllOf(HasSubstr("from 0 s to 2.3 s"), HasSubstr("3 s asked for were not reached")));
  EXPECT_THAT(verdict.notes, Contains("The enclosure ended at 2.3 s of the 3 s asked for: the step became too small."));
}

TEST(Verdict, CountsOverestimationOnlyAsFarAsWasCompared) {
  Results results = example::pendulum();
  results.interval.reached = 1.5;
  EXPECT_LT(judge(results).overestimation, 1.0026);
}

TEST(Verdict, RefusesGridsWhoseShapeDoesNotFit) {
  Results results = example::pendulum();
  results.time.pop_back();
  EXPECT_THROW(judge(results), std::invalid_argument);
}

TEST(Verdict, RefusesADisputedSampleWithoutADistanceForEachOutput) {
  Results results = example::pendulum();
  dispute(results, 0, Decider::inDoubles).farthest.pop_back();
  EXPECT_THROW(judge(results), std::invalid_argument);
}

TEST(Verdict, RefusesADisputedSampleOfAnOutputThatIsNotThere) {
  Results results = example::pendulum();
  dispute(results, 0, Decider::inDoubles).output = results.outputs.size();
  EXPECT_THROW(judge(results), std::invalid_argument);
}

}  // namespace
}  // namespace gamut
