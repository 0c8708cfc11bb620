// Two results: what contradicts and is a proof of an error, what only says that the models differ, and what is worse.
#include <gmock/gmock.h>

#include <gmpxx.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <ostream>
#include <string>

#include "studies/comparing/common_units.hpp"
#include "studies/comparing/difference.hpp"
#include "studies/study.hpp"
#include "tests/studies/sample_results.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// ---- The same question ----------------------------------------------------------------------------------------------

/// sampleResults(), in which nothing is in doubt, and the first output is no margin of a requirement.
Results sound() {
  Results results = sampleResults();
  results.comparison.disputed.clear();
  results.requirements[1].margin = 1;
  results.distribution.gaps(0, 0) = 0.5;
  for (double& error : results.stochastic.error.data) error = 1e-12;
  return results;
}

struct Change {
  std::string name;
  std::function<void(Results&)> change;  // of the second
  std::string word;
};

void PrintTo(const Change& c, std::ostream* stream) { *stream << c.name; }

class DifferenceOf : public ::testing::TestWithParam<Change> {};

TEST_P(DifferenceOf, IsTheWordExpectedInBothOrders) {
  const Results first = sound();
  Results second = first;
  GetParam().change(second);
  EXPECT_EQ(wordOf(compareResults(first, second).word), GetParam().word);
  if (GetParam().word != "worse") {
    EXPECT_EQ(wordOf(compareResults(second, first).word), GetParam().word);
  }
}

/// The distribution function of output 1 at the only time: its last value's bounds.
void bound(Results& results, double lower, double upper) {
  results.distribution.lower(0, 1, 2) = lower;
  results.distribution.upper(0, 1, 2) = upper;
}

void move(Envelope& bounds, double by) {
  for (Table* table : {&bounds.lower, &bounds.upper})
    for (double& x : table->data) x += by;
}

/// Samples alone, one of which lies so far above the enclosure of the other results.
void leave(Results& results, double distance) {
  results.stochastic.envelope.upper(1, 0) = results.interval.at.upper(1, 0) + distance;
  results.interval = {};
}

INSTANTIATE_TEST_SUITE_P(
    Results, DifferenceOf,
    ::testing::Values(
        Change{"same", [](Results&) {}, "agree"},
        Change{"alpha-cuts that touch", [](Results& r) { r.fuzzy.outer[2].upper(1, 0) += 0.005; }, "agree"},
        Change{"alpha-cuts apart by one rounding",
               [](Results& r) {
                 double& upper = r.fuzzy.outer[2].upper(1, 0);
                 r.fuzzy.outer[2].lower(1, 0) = upper = std::nextafter(upper, 12.0);
               },
               "error"},
        Change{"enclosures apart", [](Results& r) { r.stochastic = {}, move(r.interval.at, 1.5); }, "error"},
        Change{"enclosures over time apart", [](Results& r) { move(r.interval.over, 1000); }, "error"},
        Change{"one enclosure is not known",
               [](Results& r) { r.interval.at.lower(1, 0) = r.interval.at.upper(1, 0) = none; }, "agree"},
        Change{"samples outside the other's enclosure", [](Results& r) { leave(r, 0.1); }, "error"},
        Change{"samples outside by less than ten errors", [](Results& r) { leave(r, 5e-12); }, "agree"},
        Change{"samples outside whose error is not known", [](Results& r) { leave(r, 0.1), r.stochastic.error = {}; },
               "agree"},
        Change{"distributions apart", [](Results& r) { bound(r, 0.9, 1); }, "error"},
        Change{"distributions that touch", [](Results& r) { bound(r, 0.875, 0.875); }, "agree"},
        Change{"means apart",
               [](Results& r) { r.sensitivity.mean.lower.data[0] = r.sensitivity.mean.upper.data[0] = 1.75; }, "error"},
        Change{"indices apart",
               [](Results& r) { r.sensitivity.first.lower.data[0] = r.sensitivity.first.upper.data[0] = 0.25; },
               "error"},
        Change{"total indices apart",
               [](Results& r) { r.sensitivity.total.lower.data[0] = r.sensitivity.total.upper.data[0] = 1; }, "error"},
        Change{"a requirement met and violated",
               [](Results& r) { r.requirements[0].word = Decision::violated, r.requirements[0].met = 0; }, "error"},
        Change{"a requirement met and violated for some",
               [](Results& r) { r.requirements[0].word = Decision::partly, r.requirements[0].met = 0; }, "error"},
        Change{"parts that are all of the box", [](Results& r) { r.requirements[1].met = 0.75; }, "agree"},
        Change{"parts that are more than the box by a rounding",
               [](Results& r) { r.requirements[1].met = std::nextafter(0.75, 1.0); }, "error"},
        Change{"probabilities of a requirement apart",
               [](Results& r) { r.requirements[1].probabilityLower = r.requirements[1].probabilityUpper = 0.75; },
               "error"},
        Change{"possibilities of a requirement apart",
               [](Results& r) { r.requirements[1].violationLeast = r.requirements[1].violationMost = 0.75; }, "error"},
        Change{"another demand",
               [](Results& r) { r.requirements[0].word = Decision::violated, r.requirements[0].until = 0.01; },
               "agree"},
        Change{"wider", [](Results& r) { r.interval.at.upper(1, 0) += 0.02; }, "worse"},
        Change{"a wider alpha-cut", [](Results& r) { r.fuzzy.outer[1].upper(1, 0) += 0.02; }, "worse"},
        Change{"an alpha-cut of nearly no width", [](Results& r) { r.fuzzy.outer[2].upper(1, 0) += 1e-3; }, "agree"},
        Change{"without bounds",
               [](Results& r) { r.interval.at.upper(1, 0) = std::numeric_limits<double>::infinity(); }, "worse"},
        Change{"a wider gap", [](Results& r) { r.distribution.gaps(0, 0) = 0.8; }, "worse"},
        Change{"shorter", [](Results& r) { r.interval.reached = 0.005; }, "worse"},
        Change{"a requirement not met any more",
               [](Results& r) {
                 r.requirements[0].word = Decision::open;
                 r.requirements[0].met = r.requirements[0].factor = r.requirements[0].probabilityLower = 0;
               },
               "worse"},
        Change{"a violation not known any more",
               [](Results& r) {
                 r.requirements[1].word = Decision::open;
                 r.requirements[1].met = r.requirements[1].violated = 0;
               },
               "worse"}));

TEST(Difference, NamesTheFarthestOfAllTimes) {
  const Results first = sound();
  Results second = first;
  second.stochastic = {};
  move(second.interval.at, 1.5);
  second.interval.at.lower(1, 1) += 1;
  second.interval.at.upper(1, 1) += 1;
  const Difference difference = compareResults(first, second);
  ASSERT_EQ(difference.contradictions.found.size(), 4U);  // enclosures of both outputs, and samples of the first
  const Contradiction& c = difference.contradictions.found[1];
  EXPECT_EQ(c.of, Contradiction::Of::enclosure);
  EXPECT_EQ(c.name, "energy");
  EXPECT_EQ(c.time, 0.01);
  EXPECT_THAT(c.times, ElementsAre(0, 0.01));
  EXPECT_DOUBLE_EQ(c.distance, 1.5);
  EXPECT_TRUE(c.isProof);
}

TEST(Difference, KeepsSamplesThatTheirOwnRunDoubtsFromBeingAProof) {
  const Results first = sound();
  Results second = first;
  leave(second, 0.1);
  second.comparison.disputed = {{17, 1, 0, 11.2, 10.1, 11.1, 0.1, 1e-9, Decider::unresolved, false, -1, {0.2, 0}}};
  const Difference difference = compareResults(first, second);
  EXPECT_THAT(difference.contradictions.found, IsEmpty());
  EXPECT_EQ(difference.contradictions.undecided.size(), 1U);
}

TEST(Difference, TellsWhatOnlyOneHas) {
  const Results first = sound();
  Results second = first;
  second.outputs[1].name = "work";
  second.time = {0, 0.01, 0.03};
  second.fuzzy = {};
  const Shared shared = sharedOf(first, second);
  EXPECT_EQ(shared.outputs.size(), 1U);
  EXPECT_THAT(shared.otherOutputs.first, ElementsAre("energy"));
  EXPECT_THAT(shared.otherOutputs.second, ElementsAre("work"));
  EXPECT_EQ(shared.times.size(), 2U);
  EXPECT_EQ(shared.otherTimes.second, 1U);
  EXPECT_THAT(shared.otherAnswers.first, ElementsAre("alpha-cuts"));
}

TEST(Difference, IsRefusedWhereNothingIsInBoth) {
  const auto refuses = [](const std::function<void(Results&)>& change) {
    Results second = sound();
    change(second);
    EXPECT_THROW(compareResults(sound(), second), NotComparable);
  };
  refuses([](Results& r) { r.outputs[0].name = "a", r.outputs[1].name = "b"; });
  refuses([](Results& r) { r.outputs[0].unit = "kg", r.outputs[1].unit = "kg"; });
  refuses([](Results& r) { r.time = {0.001, 0.002, 0.003}; });
}

/// Bounds go outward, so that no set that holds a number loses it: what 1000/3 mm is in m has no double.
TEST(Difference, IsTakenInUnitsOfOneKind) {
  Results first = sound(), second = first;
  first.outputs[0].unit = "m", second.outputs[0].unit = "mm";
  const double inMillimetres = 1000.0 / 3;
  for (std::vector<double>* list : {&second.interval.at.lower.data, &second.interval.at.upper.data})
    for (std::size_t i = 0; i < list->size(); i += 2) (*list)[i] = inMillimetres;
  const std::optional<Results> converted = inUnitsOf(first, second);
  ASSERT_TRUE(converted);
  EXPECT_EQ(converted->outputs[0].unit, "m");
  const Bounds &before = second.interval.at, &now = converted->interval.at;
  for (std::size_t i = 0; i < before.lower.times; ++i) {
    const mpq_class lower(now.lower(i, 0)), upper(now.upper(i, 0)), exact = mpq_class(inMillimetres) / 1000;
    EXPECT_TRUE(lower < exact);
    EXPECT_TRUE(upper > exact);
    EXPECT_LE(now.upper(i, 0) - now.lower(i, 0), 1e-15);
  }
  EXPECT_DOUBLE_EQ(converted->stochastic.mean(0, 0), second.stochastic.mean(0, 0) / 1000);
  EXPECT_TRUE(std::isnan(converted->distribution.value(0, 0, 0)));
  EXPECT_FALSE(inUnitsOf(first, first));
  const Difference difference = compareResults(first, second);
  ASSERT_EQ(difference.shared.converted.size(), 1U);
  EXPECT_EQ(difference.shared.converted[0].unit.second, "mm");
  EXPECT_EQ(difference.shared.outputs.size(), 2U);
  second.outputs[0].unit = "kg";
  EXPECT_FALSE(inUnitsOf(first, second));
  const Shared shared = sharedOf(first, second);
  EXPECT_EQ(shared.outputs.size(), 1U);
  ASSERT_EQ(shared.incomparable.size(), 1U);
  EXPECT_EQ(shared.incomparable[0].name, first.outputs[0].name);
}

TEST(Difference, CountsWhatTheTolerancesSay) {
  const Results first = sound();
  Results second = first;
  second.cpu = 5;
  second.comparison.maximumOf[0] = 13;
  second.interval.at.upper(1, 0) += 0.02;
  Tolerances tolerances;
  EXPECT_EQ(compareResults(first, second, tolerances).excesses.size(), 1U);
  tolerances.cpu = 2;
  tolerances.overestimation = 0.05;
  EXPECT_EQ(compareResults(first, second, tolerances).excesses.size(), 3U);
  tolerances.of["tip height"].wider = 0.05;
  EXPECT_EQ(compareResults(first, second, tolerances).excesses.size(), 1U);
}

// ---- Whether it is the same question --------------------------------------------------------------------------------

Results comparedResults(const std::string& text) {
  const Study study = readStudyText(text, "s.toml");
  Results results;
  results.studyText = text;
  results.studyFile = "s.toml";
  results.outputs.assign(study.outputs.begin(), study.outputs.end());
  results.time = study.times;
  for (const UncertainQuantity& of : study.uncertain)
    results.uncertain.push_back({of.uncertain.name, of.quantity, of.unit, of.uncertain.range.lower(),
                                 of.uncertain.nominal, of.uncertain.range.upper(), "uniform", "triangular"});
  return results;
}

Relation relationWith(const std::string& old, const std::string& replacement) {
  const Results first = comparedResults(sampleStudy), second = comparedResults(sampleStudyWith(old, replacement));
  return relationOf(first, second, sharedOf(first, second));
}

TEST(RelationOfStudies, IsTheSameQuestionWhateverTheWordsAndSettings) {
  for (const auto& [old, replacement] :
       {std::pair("samples = 16", "samples = 32"), std::pair("250 g", "0.25 kg"),
        std::pair("\"30 deg\"", "\"1/6 pi rad\""), std::pair("output_step = 0.1", "output_step = 0.05"),
        std::pair("name = \"start\"", "name = \"begin\"")}) {
    SCOPED_TRACE(replacement);
    const Relation relation = relationWith(old, replacement);
    EXPECT_FALSE(relation.isSameText);
    EXPECT_TRUE(relation.isSameQuestion()) << relation.why;
    EXPECT_TRUE(relation.hasSameMemberships);
    EXPECT_THAT(relation.isSameOutput, ElementsAre(1, 1));
  }
}

TEST(RelationOfStudies, KnowsWhichIntervalsHoldTheOthers) {
  const Relation wider = relationWith("± 1 %", "± 2 %");
  EXPECT_TRUE(wider.isSameMotion && wider.isFirstInSecond && wider.areShared);
  EXPECT_FALSE(wider.isSecondInFirst || wider.hasSameDistributions || wider.isSameQuestion());
  const Relation overlap = relationWith("± 1 %", "+2 / -0.5 %");
  EXPECT_TRUE(overlap.areShared);
  EXPECT_FALSE(overlap.isFirstInSecond || overlap.isSecondInFirst);
  const Relation apart = relationWith("angle = \"30 deg\"", "angle = \"40 deg\"");
  EXPECT_TRUE(apart.isSameMotion);
  EXPECT_FALSE(apart.areShared);
}

TEST(RelationOfStudies, KnowsHowQuantitiesDependOnEachOther) {
  const auto with = [](const std::string& dependence) {
    return comparedResults(sampleStudyWith(
        "[[output]]", "[[uncertain]]\nquantity = \"bob.mass\"\ninterval = \"± 1 g\"\n" + dependence + "[[output]]"));
  };
  const auto areAlike = [&](const std::string& one, const std::string& other) {
    const Results first = with(one), second = with(other);
    const Relation relation = relationOf(first, second, sharedOf(first, second));
    EXPECT_TRUE(relation.isSameQuestion()) << relation.why;
    return relation.hasSameDistributions;
  };
  const std::string head = "[[dependence]]\nquantities = [\"start\", \"bob.mass\"]\n",
                    turned = "[[dependence]]\nquantities = [\"bob.mass\", \"hinge.angle\"]\n";
  EXPECT_TRUE(areAlike(head + "rank_correlation = 0.5\n", turned + "rank_correlation = \"50 %\"\n"));
  EXPECT_TRUE(areAlike(head + "unknown = true\n", turned + "unknown = true\n"));
  EXPECT_FALSE(areAlike(head + "rank_correlation = 0.5\n", turned + "rank_correlation = 0.4\n"));
  EXPECT_FALSE(areAlike(head + "rank_correlation = 0.5\n", ""));
  EXPECT_FALSE(areAlike(head + "unknown = true\n", ""));
}

TEST(RelationOfStudies, KnowsAQuantityThatIsUncertainInOneAlone) {
  const Relation relation = relationWith(
      "[[output]]", "[[uncertain]]\nquantity = \"bob.mass\"\ninterval = [\"240 g\", \"260 g\"]\n[[output]]");
  EXPECT_TRUE(relation.isSameMotion && relation.isFirstInSecond && relation.areShared);
  EXPECT_FALSE(relation.isSecondInFirst || relation.hasSameDistributions);
}

TEST(RelationOfStudies, SaysInWhichNumbersMotionsDiffer) {
  const Relation relation = relationWith("-9.81", "-9.8");
  EXPECT_FALSE(relation.isSameMotion);
  EXPECT_THAT(relation.differences, ElementsAre("gravity.z is -9.81 m/s^2 in A, -9.8 m/s^2 in B"));
  const Relation start = relationWith("rate = 0.5", "rate = 0.25");
  EXPECT_FALSE(start.isSameMotion);
  EXPECT_THAT(start.differences, ElementsAre("hinge.rate is 0.5 rad/s in A, 0.25 rad/s in B"));
}

TEST(RelationOfStudies, TellsAnOutputThatIsAnotherFunctionOfTheSameMotion) {
  const Relation relation =
      relationWith("name = \"angle\"\nquantity = \"hinge.angle\"", "name = \"angle\"\nquantity = \"2*hinge.angle\"");
  EXPECT_TRUE(relation.isSameMotion);
  EXPECT_THAT(relation.isSameOutput, ElementsAre(0, 1));
}

TEST(RelationOfStudies, IsNotAssumedOfAStudyThatCannotBeRead) {
  const Results first = sound();
  Results second = first;
  second.studyText = "[study";
  const Relation relation = relationOf(first, second, sharedOf(first, second));
  EXPECT_FALSE(relation.isSameMotion || relation.areShared);
  EXPECT_NE(relation.why, "");
  move(second.interval.at, 100);
  EXPECT_EQ(compareResults(first, second).word, Difference::Word::incompatible);
}

}  // namespace
}  // namespace gamut
