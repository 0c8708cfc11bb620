// A run puts every uncertain number where the programs expect it, and keeps what was found when it is stopped.
#include "studies/running/run.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

#include "studies/machine.hpp"
#include "studies/running/replay.hpp"
#include "studies/watch.hpp"
#include "tests/analyses/reference.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using ::testing::Each;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

constexpr const char* threeUncertain = R"([[uncertain]]
quantity = "rod.length"
interval = "± 1 %"
[[uncertain]]
quantity = "gravity.z"
interval = [-9.83, -9.79]
[[uncertain]])";

Study sampleWith(const std::string& old, const std::string& replacement) {
  return readStudyText(sampleStudyWith(old, replacement), "s.toml");
}

TEST(Machine, PutsStatesFirstAndFreeParametersBehindThem) {
  const Machine machine(sampleWith("[[uncertain]]", threeUncertain));
  EXPECT_EQ(machine.states, 2U);
  EXPECT_THAT(machine.freeParameters, ::testing::ElementsAre("rod.length", "gravity.z"));
  ASSERT_EQ(machine.box.size(), 4U);
  EXPECT_THAT(machine.motion.slot, ::testing::ElementsAre(2, 3, 0));
  EXPECT_TRUE(isSubset(Interval("[0.495, 0.505]"), machine.box[2]));
  EXPECT_TRUE(isSubset(Interval("[-9.83, -9.79]"), machine.box[3]));
  EXPECT_TRUE(isEqual(machine.box[1], Interval(0.5)));
  EXPECT_EQ(machine.motion.motion.f.parameters(), 2);
  EXPECT_EQ(machine.motion.nominal[2], 0.5);
}

/// I ω̇ = c - b ω: a motor of direct current, whose moment is of its own speed, comes to it as (c/b)(1 - e^(-b t/I)).
TEST(Run, EnclosesAMotorThatKnowsItsOwnSpeed) {
  const Study study = readStudyText(R"toml([study]
analysis = "dynamics"
horizon = 1
output_step = 0.125
[[mechanism.element]]
type = "revolute"
name = "shaft"
from = "inertial"
to = "rotor"
axis = "x"
[[mechanism.element]]
type = "mass"
name = "disc"
at = "rotor"
mass = 1
inertia = [0.25, 0.2, 0.2]
[[mechanism.element]]
type = "motor"
name = "motor"
joint = "shaft"
moment = "0.5 N m/ampere*(4 V - 0.5 V s/rad*motor.rate)/(2 Ohm)"
ratio = 2
[[uncertain]]
quantity = "disc.inertia.xx"
interval = "± 4 %"
[[output]]
quantity = "shaft.rate"
[[output]]
quantity = "motor.rate"
[stochastic]
samples = 64
)toml",
                                    "s.toml");
  const Results results = run(study);
  ASSERT_EQ(results.interval.reached, 1);
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  for (std::size_t i = 0; i < results.time.size(); ++i)
    for (const double inertia : {0.24, 0.25, 0.26}) {
      const Precise rate = 4 * (1 - exp(Precise(-0.5 * results.time[i]) / Precise(inertia)));
      EXPECT_LE(Precise(results.interval.at.lower(i, 0)), rate) << results.time[i];
      EXPECT_GE(Precise(results.interval.at.upper(i, 0)), rate) << results.time[i];
      EXPECT_LE(Precise(results.interval.at.lower(i, 1)), 2 * rate);
      EXPECT_GE(Precise(results.interval.at.upper(i, 1)), 2 * rate);
    }
  EXPECT_LT(results.interval.at.upper(4, 0) - results.interval.at.lower(4, 0), 0.13);
}

TEST(Machine, NestsTheLevelsFromTheSupportsToTheCores) {
  const Machine machine(sampleWith("[[uncertain]]", threeUncertain));
  ASSERT_EQ(machine.levels.size(), 11U);
  EXPECT_EQ(machine.alpha.front(), 0);
  EXPECT_EQ(machine.alpha.back(), 1);
  for (std::size_t j = 0; j < 11; ++j)
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_TRUE(isSubset(machine.levels[j][i], j == 0 ? machine.box[i] : machine.levels[j - 1][i]));
  EXPECT_TRUE(isThin(machine.levels[10][2]));
}

/// The same motion in other units: requirements are none of its business.
TEST(Run, TellsOutputsInTheUnitsThatAreWanted) {
  const std::string requirement = "[[requirement]]\nname = \"r\"\nalways = \"angle < 45 deg\"\n[stochastic]";
  std::string text = sampleStudyWith("[stochastic]", requirement);
  const Results si = run(readStudyText(text, "s.toml"));
  text.replace(text.find("quantity = \"hinge.angle\"\n[[output]]"), 24, "quantity = \"hinge.angle\"\nunit = \"deg\"");
  text.replace(text.find("quantity = \"tip.position.z\""), 27, "quantity = \"tip.position.z\"\nunit = \"mm\"");
  const Results told = run(readStudyText(text, "s.toml"));
  EXPECT_EQ(told.comparison.verdict, Agreement::inside);
  EXPECT_EQ(told.outputs[0].unit, "deg");
  EXPECT_EQ(told.outputs[1].unit, "mm");
  EXPECT_EQ(told.outputs[2].unit, "deg");  // of the margin: what it compares is told in these
  const std::size_t last = si.time.size() - 1;
  const double degree = 0.017453292519943295;
  EXPECT_NEAR(told.interval.at.upper(last, 0) * degree, si.interval.at.upper(last, 0), 1e-9);
  EXPECT_NEAR(told.interval.at.lower(last, 1) * 1e-3, si.interval.at.lower(last, 1), 1e-9);
  EXPECT_EQ(si.outputs[2].unit, "rad");  // its limit is in degrees
  EXPECT_NEAR(told.interval.at.lower(last, 2) * degree, si.interval.at.lower(last, 2), 1e-9);
  EXPECT_EQ(told.requirements[0].word, si.requirements[0].word);
  EXPECT_THROW(sampleWith("quantity = \"tip.position.z\"", "quantity = \"tip.position.z\"\nunit = \"deg\""),
               StudyError);
}

/// Parameters and formulas alone: a gap that is left between parts, by worst case, by probability and by membership.
TEST(Run, TakesAToleranceChainWithoutAnyElement) {
  const std::string chain = R"([study]
analysis = "kinematics"
[mechanism]
parameters = { housing = "50 mm", shaft = "30 mm", ring = "19.8 mm", room = "housing - shaft" }
[[uncertain]]
quantity = "housing"
interval = "± 0.1 mm"
[[uncertain]]
quantity = ["shaft", "ring"]
interval = "± 0.05 mm"
[[output]]
name = "gap"
quantity = "room - ring"
unit = "mm"
[[requirement]]
always = "gap > 0.05 mm"
)";
  const Results results = run(readStudyText(chain, "s.toml"));
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_NEAR(results.interval.at.lower(0, 0), 0, 1e-12);
  EXPECT_NEAR(results.interval.at.upper(0, 0), 0.4, 1e-12);
  EXPECT_NEAR(results.stochastic.mean(0, 0), 0.2, 1e-3);
  EXPECT_EQ(results.requirements[0].word, Decision::partly);
  constexpr double probability = 1 - 0.05 * 0.05 * 0.05 / 6 / (0.2 * 0.1 * 0.1);  // without a corner of the box
  EXPECT_LE(results.requirements[0].probabilityLower, probability);
  EXPECT_GE(results.requirements[0].probabilityUpper, probability);
  EXPECT_GT(results.requirements[0].probabilityLower, 0.97);
  std::string moving = chain;
  moving.replace(moving.find("\"kinematics\""), 12, "\"dynamics\"\nhorizon = 1\noutput_step = 1");
  EXPECT_THAT([&] { readStudyText(moving, "s.toml"); },
              ThrowsMessage<StudyError>(HasSubstr(
                  "s.toml:5:1: the mechanism has no joint and no state, so that nothing can move; expected a joint")));
  std::string empty = chain;
  empty.replace(empty.find("parameters = "), empty.find("[[uncertain]]") - empty.find("parameters = "), "");
  EXPECT_THAT([&] { readStudyText(empty, "s.toml"); },
              ThrowsMessage<StudyError>(HasSubstr("or in kinematics parameters alone")));
}

TEST(Run, LeavesOpenWhatAnInterruptKeepsFromBeingDecided) {
  std::atomic<bool> cancelled{false};
  RunOptions options;
  options.cancelled = &cancelled;
  options.progress = [&](const std::string& task, double fraction) {
    if (task == "enclosure" && fraction > 0.5) cancelled = true;
  };
  const Results results = run(readStudyText(sampleStudy, "s.toml"), options);
  const ComparisonResult& comparison = results.comparison;
  EXPECT_EQ(comparison.verdict, Agreement::incomplete);
  EXPECT_EQ(comparison.excursion, 0);
  EXPECT_THAT(comparison.disputed, Not(IsEmpty()));
  EXPECT_THAT(comparison.disputed, Each(Field(&DisputedSample::decided, Decider::interrupted)));
}

TEST(Run, ComparesAFirstBlockOfSamplesWithAnEnclosureThatIsInterrupted) {
  std::atomic<bool> cancelled{false};
  RunOptions options;
  options.samples = 5000;
  options.cancelled = &cancelled;
  options.progress = [&](const std::string& task, double) {
    if (task == "enclosure") cancelled = true;
  };
  const Results results = run(readStudyText(sampleStudy, "s.toml"), options);
  EXPECT_EQ(results.comparison.verdict, Agreement::incomplete);
  EXPECT_EQ(results.stochastic.integrated, 256 + 2 + results.stochastic.alphaCorners + 1);
  EXPECT_EQ(results.stochastic.stopped, "the run was interrupted");
  EXPECT_EQ(results.stochastic.reached, 0.5);
  EXPECT_FALSE(std::isnan(results.stochastic.quantiles[2](5, 0)));
  EXPECT_FALSE(std::isnan(results.fuzzy.inner[5].lower(5, 0)));
}

TEST(Run, QuantilesAreWithinTheirResolutionOfThoseOfTheSamplesThemselves) {
  const Study study = readStudyText(sampleStudy, "s.toml");
  RunOptions options;
  options.samples = 704;
  const StochasticResult found = run(study, options).stochastic;
  const Machine machine(study);
  EnsembleOptions ensemble = study.ensemble;
  ensemble.samples = 704;
  std::vector<std::vector<double>> trajectories;
  for (std::size_t i = 0; i < 704; ++i) trajectories.push_back(replaySample(machine.motion, ensemble, i).trajectory(0));
  for (std::size_t cell = 0; cell < trajectories[0].size(); ++cell) {
    std::vector<double> column;
    for (const std::vector<double>& trajectory : trajectories) column.push_back(trajectory[cell]);
    std::ranges::sort(column);
    const double resolution = found.resolution.data[cell];
    EXPECT_LE(resolution, 1.01 * (column.back() - column.front()) / 4096 + 1e-9);
    for (std::size_t q = 0; q < found.probabilities.size(); ++q) {
      const double position = found.probabilities[q] * 703, below = std::floor(position);
      const auto k = static_cast<std::size_t>(below);
      const double exact = column[k] + (position - below) * (column[k + 1] - column[k]);
      EXPECT_LE(std::abs(found.quantiles[q].data[cell] - exact), resolution) << cell << ' ' << q;
    }
  }
}

TEST(Run, KeepsValuesAndMotionsOfTheSamplesThemselves) {
  Study study = readStudyText(sampleStudy, "s.toml");
  study.ensemble.samples = 700;
  study.storage = 2e4;
  const Results results = run(study);
  const KeptSamples& kept = results.stochastic.kept;
  EXPECT_EQ(kept.storage, 2e4);
  EXPECT_GT(kept.motionsEvery, kept.valuesEvery);
  const Machine machine(study);
  EnsembleOptions ensemble = study.ensemble;
  ensemble.alpha = machine.alpha;
  Sampling sampling(ensemble.plan, 1, 700, ensemble.seed);
  EXPECT_EQ(kept.number.back(), results.stochastic.centre());
  EXPECT_EQ(kept.values.back(), study.uncertain[0].uncertain.nominal);
  for (std::size_t i = 0; kept.number[i] < 700; ++i)
    EXPECT_EQ(kept.values[i], sampling.values(static_cast<std::size_t>(kept.number[i]), machine.motion.uncertain)[0]);
  const std::size_t cells = results.time.size() * results.outputs.size();
  std::size_t asTheyWere = 0;
  for (std::size_t i = 0; i < kept.motionNumber.size(); ++i) {
    const auto begin = kept.motions.begin() + static_cast<std::ptrdiff_t>(i * cells);
    const std::vector<double> motion(begin, begin + static_cast<std::ptrdiff_t>(cells)),
        replayed = replaySample(machine.motion, ensemble, static_cast<std::size_t>(kept.motionNumber[i])).trajectory(0);
    const bool isDisputed = std::ranges::any_of(results.comparison.disputed, [&](const DisputedSample& sample) {
      return sample.number == kept.motionNumber[i];
    });
    EXPECT_TRUE(isDisputed || motion == replayed) << kept.motionNumber[i];
    asTheyWere += motion == replayed ? 1 : 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      EXPECT_GE(motion[cell], results.stochastic.envelope.lower.data[cell]);
      EXPECT_LE(motion[cell], results.stochastic.envelope.upper.data[cell]);
    }
  }
  EXPECT_GT(asTheyWere, 100U);
}

TEST(Run, KeepsTheNumbersOfDistributionsAndMembershipFunctions) {
  const Results results =
      run(sampleWith("distribution = { type = \"uniform\" }\nmembership = { type = \"triangular\" }",
                     "distribution = { type = \"normal\", deviation = \"0.1 deg\" }\n"
                     "membership = { type = \"table\", points = [[\"29.8 deg\", 0.5], [\"30 deg\", 1]] }"));
  std::vector<std::string> found;
  for (const ShapeInfo& s : results.shapes)
    found.push_back(s.quantity + " " + std::string(wordOf(s.shape)) + " " + s.name + " " + std::to_string(s.value) +
                    " " + s.unit);
  EXPECT_THAT(
      found, ::testing::ElementsAre("start distribution lower 0.518363 rad", "start distribution upper 0.528835 rad",
                                    "start distribution mean 0.523599 rad", "start distribution deviation 0.001745 rad",
                                    "start distribution cut_off 0.002700 1", "start membership lower 0.520108 rad",
                                    "start membership upper 0.523599 rad", "start membership value 1 0.520108 rad",
                                    "start membership membership 1 0.500000 1", "start membership value 2 0.523599 rad",
                                    "start membership membership 2 1.000000 1"));
}

TEST(Run, AlphaCutsOfSeveralQuantitiesAreReachedByTheirCorners) {
  std::string text = sampleStudyWith("[[uncertain]]", threeUncertain);
  const std::string more = R"([[uncertain]]
quantity = "hinge.rate"
interval = "± 1 %"
)";
  text.insert(text.find("[[uncertain]]"), more);
  const Results results = run(readStudyText(text, "s.toml"));
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_EQ(results.stochastic.alphaCorners, 9 * 16);
  const std::size_t last = results.time.size() - 1;
  for (std::size_t level = 0; level < 10; ++level) {
    const Bounds &inner = results.fuzzy.inner[level], &outer = results.fuzzy.outer[level];
    const double sampled = inner.upper(last, 0) - inner.lower(last, 0);
    EXPECT_GT(sampled, 0.95 * (outer.upper(last, 0) - outer.lower(last, 0))) << level;
  }
}

/// The height of a pendulum is lowest where it hangs, farthest down with the longest rod: no corner has both.
TEST(Run, ReachesExtremesInsideAlphaCutsByTheTransformationMethod) {
  std::vector<Results> found;
  for (const char* method : {"reduced", "extended", "general"}) {
    std::string text = sampleStudyWith("interval = \"± 1 %\"", "interval = [\"-20 deg\", \"30 deg\"]");
    text.replace(text.find("\"30 deg\", rate"), 8, "\"2 deg\"");
    text.insert(text.find("[[uncertain]]"), "[[uncertain]]\nquantity = \"rod.length\"\ninterval = \"± 5 %\"\n");
    found.push_back(run(readStudyText(text + "[fuzzy]\nmethod = \"" + method + "\"\n", "s.toml")));
    const Results& results = found.back();
    EXPECT_EQ(results.comparison.verdict, Agreement::inside);
    EXPECT_EQ(results.fuzzy.transformation.method, method);
    EXPECT_EQ(results.stochastic.integrated, results.stochastic.planned());
  }
  const auto lowest = [&](std::size_t of) { return found[of].fuzzy.inner[2].lower(0, 1); };
  const auto gap = [&](std::size_t of) { return found[of].fuzzy.transformation.gap(2, 1); };
  EXPECT_GT(lowest(0), lowest(2) + 1e-3);
  EXPECT_LE(lowest(1), lowest(2));  // with the lines that look for turns
  EXPECT_GT(gap(0), gap(1) + 0.05);
  EXPECT_EQ(found[0].stochastic.alphaPoints, 0);
  EXPECT_EQ(found[2].stochastic.alphaPoints, 506);
  EXPECT_EQ(found[1].stochastic.nameOf(found[1].stochastic.centre() + 3), "point 2 of the alpha-cuts");
  const std::vector<double>& turns = found[1].fuzzy.transformation.turns;
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_GT(*std::ranges::max_element(turns), 0.01);  // of the angle; the length does not turn
  EXPECT_LE(*std::ranges::min_element(turns), 0.01);
  // No statistic changes with them.
  EXPECT_EQ(found[0].stochastic.mean.data, found[2].stochastic.mean.data);
}

/// The same height, without alpha-cuts: samples are put where the enclosure tells that it is lowest.
TEST(Run, SamplesWhereTheEnclosureTellsThatOutputsAreExtreme) {
  std::string text = sampleStudyWith("interval = \"± 1 %\"", "interval = [\"-20 deg\", \"30 deg\"]");
  text.replace(text.find("\"30 deg\", rate"), 8, "\"2 deg\"");
  text.replace(text.find(", \"fuzzy\""), 9, "");
  text.insert(text.find("[[uncertain]]"), "[[uncertain]]\nquantity = \"rod.length\"\ninterval = \"± 5 %\"\n");
  const Results results = run(readStudyText(text, "s.toml"));
  const StochasticResult& stochastic = results.stochastic;
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_EQ(stochastic.samples + stochastic.corners, 16 + 4);
  EXPECT_EQ(stochastic.alphaPoints, 0);
  ASSERT_THAT(stochastic.extremes.number, Not(IsEmpty()));
  EXPECT_LT(stochastic.extremes.number.size(), 12U);  // those of one time serve others
  EXPECT_EQ(stochastic.extremes.number.front(), stochastic.centre() + 1);
  EXPECT_EQ(stochastic.extremes.values.size(), 2 * stochastic.extremes.number.size());
  EXPECT_EQ(stochastic.integrated, stochastic.planned());
  EXPECT_EQ(stochastic.nameOf(stochastic.planned() - 1),
            "extreme " + std::to_string(stochastic.extremes.number.size() - 1));
  const double lowest = -0.525;  // m, at the start: the longest rod hangs; of corners it is at -0.493
  EXPECT_LT(stochastic.envelope.lower(0, 1), lowest * 0.9999);
  EXPECT_LT(results.comparison.maximum, 1.001 * results.interval.tightness);
}

TEST(Run, KeepsSamplesInsideWithUncertainParametersAndInitialValues) {
  const Results results = run(sampleWith("[[uncertain]]", threeUncertain));
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_EQ(results.stochastic.corners, 8);
  EXPECT_EQ(results.stochastic.packWidth, 64);
  EXPECT_EQ(results.uncertain.size(), 3U);
  EXPECT_GE(results.comparison.maximum, 1);
  EXPECT_LT(results.comparison.maximum, 1.1);
}

TEST(Run, MakesTheNumberUncertainThatTheStudyNames) {
  // At the start the height is -length cos(30 deg), and the angle does not depend on the length.
  const Results length = run(sampleWith("quantity = \"hinge.angle\"\ninterval", "quantity = \"rod.length\"\ninterval"));
  EXPECT_EQ(length.comparison.verdict, Agreement::inside);
  const double height = 0.5 * std::cos(std::acos(-1.0) / 6);
  EXPECT_NEAR(length.interval.at.lower(0, 1), -1.01 * height, 1e-12);
  EXPECT_NEAR(length.interval.at.upper(0, 1), -0.99 * height, 1e-12);
  EXPECT_NEAR(length.interval.at.upper(0, 0) - length.interval.at.lower(0, 0), 0, 1e-12);
}

/// Gravity as something that sways: samples follow courses of it, the guarantee holds for all.
TEST(Run, HoldsWhatVariesInTime) {
  double before = 0;
  for (const char* course : {"rate = \"± 0.05 m/s^3\"", "varies = \"freely\""}) {
    const Study study = sampleWith("[[uncertain]]", std::string("[[uncertain]]\nquantity = \"gravity.z\"\ninterval = "
                                                                "[-10, -9.6]\n") +
                                                        course + "\n[[uncertain]]");
    const Machine machine(study);
    ASSERT_EQ(machine.varying.size(), 1U);
    EXPECT_EQ(machine.varying[0].parameter, 0);
    for (const Box& level : machine.levels) EXPECT_TRUE(isEqual(level[2], machine.box[2]));
    const Results results = run(study, {});
    EXPECT_EQ(results.comparison.verdict, Agreement::inside);
    EXPECT_LT(results.comparison.maximum, 1.5);
    EXPECT_EQ(results.stochastic.switching.present, !std::isfinite(study.uncertain[0].rate));
    EXPECT_EQ(results.uncertain[0].distribution,
              std::isfinite(study.uncertain[0].rate) ? "varies by 0.05 m/s^3 at most" : "varies freely");
    const std::size_t last = results.time.size() - 1;
    const double size = results.interval.at.upper(last, 0) - results.interval.at.lower(last, 0);
    EXPECT_GT(size, before);
    before = size;
    // Samples between the ends differ from those that stand still: the two ends do not span them.
    EXPECT_GT(results.stochastic.deviation(last, 0), 0);
  }
}

/// What drives an oscillator is unknown: all is linear, so worst courses fill the enclosure.
TEST(Run, SamplesWorstCoursesBesides) {
  const std::string text = R"([study]
analysis = "dynamics"
horizon = 4
output_step = 0.2
compare = ["interval", "stochastic", "fuzzy"]
[mechanism.parameters]
drive = "0 kN"
[[mechanism.element]]
type = "state"
name = "x"
initial = 0.1
rate = "v"
[[mechanism.element]]
type = "state"
name = "v"
initial = 0
rate = "drive/(1 N) - 9*x - 0.4*v"
[[uncertain]]
quantity = "drive"
interval = ["-1 N", "0.003 kN"]
varies = "freely"
[[output]]
quantity = "x"
[[requirement]]
name = "small"
always = "x < 0.9"
[stochastic]
samples = 64
[distribution]
times = 0
)";
  const Study study = readStudyText(text, "s.toml");
  const Results results = run(study);
  const StochasticResult& stochastic = results.stochastic;
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_LT(results.comparison.maximum, 1.04);
  EXPECT_EQ(stochastic.integrated, stochastic.planned());
  // The margin has the worst courses of its output; those of the first five times, half a turn, stand at an end.
  EXPECT_EQ(stochastic.extremes.number.size(), 2 * (results.time.size() - 1 - 5));
  ASSERT_TRUE(stochastic.switching.present);
  EXPECT_EQ(stochastic.switching.number.front(), stochastic.firstExtreme());
  EXPECT_EQ(stochastic.switching.number.back(), stochastic.planned() - 1);
  // They are no draws, but courses at every level.
  EXPECT_LT(stochastic.quantiles.back()(20, 0), 0.9 * stochastic.envelope.upper(20, 0));
  for (const Envelope& cut : results.fuzzy.inner) EXPECT_EQ(cut.upper(20, 0), stochastic.envelope.upper(20, 0));
  // Of samples only these come so far.
  const RequirementResult& small = results.requirements[0];
  EXPECT_EQ(small.word, Decision::partly);
  EXPECT_GE(small.violationSample, stochastic.firstExtreme());
  EXPECT_GT(small.violation[0], 3);
  const ReplayedSample violating = replayViolation(Machine(study), results, small),
                       same = replay(Machine(study), results, static_cast<std::size_t>(small.violationSample));
  EXPECT_EQ(violating.trajectory.data, same.trajectory.data);
  EXPECT_GT(*std::ranges::max_element(same.trajectory.data), 0.9);
  Results broken = results;
  broken.stochastic.switching.value[0] = 4;
  EXPECT_THROW(replay(Machine(study), broken, 0), std::invalid_argument);
}

TEST(Run, SeedAndNumberOfSamplesMayBeReplaced) {
  RunOptions options;
  options.seed = 99;
  options.samples = 5;
  const Results results = run(readStudyText(sampleStudy, "s.toml"), options);
  EXPECT_EQ(results.seed, 99U);
  EXPECT_EQ(results.stochastic.samples, 5);
  EXPECT_NE(run(readStudyText(sampleStudy, "s.toml")).stochastic.mean.data, results.stochastic.mean.data);
}

TEST(Run, ComparesAlphaCutsWithoutAnEnclosureOfTheWholeBox) {
  const Results results = run(sampleWith("\"interval\", ", ""));
  EXPECT_FALSE(results.interval.present);
  EXPECT_TRUE(results.fuzzy.present);
  EXPECT_EQ(results.fuzzy.inner.size(), 11U);
  EXPECT_TRUE(results.comparison.present);
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
}

TEST(Run, StopsWhenToldAndSaysSo) {
  const std::atomic<bool> cancelled{true};
  RunOptions options;
  options.cancelled = &cancelled;
  const Results results = run(readStudyText(sampleStudy, "s.toml"), options);
  EXPECT_EQ(results.comparison.verdict, Agreement::incomplete);
  EXPECT_LT(results.interval.reached, 0.5);
  EXPECT_EQ(results.interval.why, "the run was interrupted");
  EXPECT_EQ(results.stochastic.stopped, "the run was interrupted");
  EXPECT_EQ(results.stochastic.integrated, 0);
}

/// A pendulum near its upper rest, whose enclosure is bisected again and again.
Study unstableStudy() {
  std::string text = sampleStudyWith("angle = \"30 deg\"", "angle = \"170 deg\"");
  text.replace(text.find("± 1 %"), std::string("± 1 %").size(), "± 9 deg");
  text.replace(text.find("horizon = 0.5"), 13, "horizon = 20.0");
  return readStudyText(text, "s.toml");
}

/// As one that takes longer than the limit would.
void spend(double seconds) {
  for (const double end = processCpuSeconds() + seconds; processCpuSeconds() < end;) continue;
}

TEST(Run, EndsAnEnclosureThatTakesTooLongAndSamplesAllTheSame) {
  Study study = unstableStudy();
  study.limits.enclosureTime = 2;
  RunOptions options;
  std::atomic<bool> isSpent{false};
  options.progress = [&](const std::string& task, double fraction) {
    if (task == "enclosure" && fraction > 0 && !isSpent.exchange(true)) spend(2);
  };
  const Results results = run(study, options);
  EXPECT_EQ(results.interval.why, "the time limit of 2 s CPU for the enclosure was reached");
  EXPECT_EQ(results.fuzzy.why, results.interval.why);
  EXPECT_GT(results.interval.reached, 0);
  EXPECT_LT(results.interval.reached, 20);
  EXPECT_EQ(results.stochastic.stopped, "");
  EXPECT_EQ(results.stochastic.integrated, 16 + 2 + 18 + 1 + 77);
  EXPECT_EQ(results.comparison.verdict, Agreement::incomplete);
}

TEST(Run, EndsARunThatTakesTooLong) {
  const Study study = readStudyText(sampleStudy, "s.toml");
  RunOptions options;
  options.samples = 1000;
  const double limit = 8 * run(study, options).cpu;  // enough for the enclosure, not for a thousand times the samples
  options.timeLimit = limit;
  options.samples = 1000000;
  const Results results = run(study, options);
  EXPECT_EQ(results.interval.reached, 0.5);
  EXPECT_EQ(results.stochastic.stopped,
            fmt::format("the time limit of {:.6g} s CPU for the whole run was reached", limit));
  EXPECT_GT(results.stochastic.integrated, 0);
  EXPECT_LT(results.stochastic.integrated, results.stochastic.planned());
  EXPECT_EQ(results.stochastic.reached, 0.5);
  EXPECT_EQ(results.comparison.verdict, Agreement::incomplete);
  EXPECT_FALSE(std::isnan(results.stochastic.envelope.lower(5, 0)));
  EXPECT_EQ(results.limits.time, limit);
  EXPECT_GE(results.cpu, limit);
}

TEST(Run, LeavesTimeToTheEnclosureWhereTheFirstSamplesTakeLong) {
  std::string text = sampleStudyWith("samples = 16", "samples = 256");
  text.replace(text.find("horizon = 0.5"), 13, "horizon = 3000");
  text.replace(text.find("output_step = 0.1"), 17, "output_step = 10");
  RunOptions options;
  options.timeLimit = 4;
  std::atomic<bool> isSpent{false};
  options.progress = [&](const std::string& task, double) {
    if (task == "samples" && !isSpent.exchange(true)) spend(1);  // all that the first samples have
  };
  const Results results = run(readStudyText(text, "s.toml"), options);
  EXPECT_GT(results.interval.reached, 0);
  EXPECT_LT(results.stochastic.integrated, 257);
  EXPECT_THAT(results.stochastic.stopped, ::testing::StartsWith("the time limit of "));
  EXPECT_EQ(results.comparison.verdict, Agreement::incomplete);
}

TEST(Run, GoesOnWithTheFirstSamplesAfterAnEnclosureThatLeavesThemTime) {
  RunOptions options;
  options.samples = 256;
  std::atomic<int> calls{0};
  std::atomic<double> sampled{0}, sampledBefore{1};
  options.progress = [&](const std::string& task, double fraction) {
    if (task == "enclosure") sampledBefore = sampled.load();
    if (task != "samples") return;
    sampled = fraction;
    if (calls++ == 3) spend(2);  // more than the stage has
  };
  options.timeLimit = 5;
  const Results results = run(readStudyText(sampleStudy, "s.toml"), options);
  EXPECT_EQ(results.stochastic.stopped, "");
  EXPECT_EQ(results.stochastic.integrated, results.stochastic.planned());
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_GT(sampledBefore, 0);
  EXPECT_LT(sampledBefore, 0.9);
}

TEST(Run, SaysWhatStoppedIt) {
  std::atomic<bool> cancelled{true};
  RunOptions options;
  options.cancelled = &cancelled;
  const Study study = readStudyText(sampleStudy, "s.toml");
  EXPECT_EQ(run(study, options).stopped, "the run was interrupted");
  EXPECT_EQ(run(study).stopped, "");
  Study limited = study;
  limited.limits.enclosureTime = 1e-9;
  EXPECT_EQ(run(limited).stopped, "the time limit of 1e-09 s CPU for the enclosure was reached");
  limited = study;
  limited.limits.sampleTime = 1e-9;
  EXPECT_EQ(run(limited).stopped, "the time limit of 1e-09 s CPU for a sample was reached");
}

TEST(Run, AFailureBehindWhatWasProvedCostsNothingOfIt) {
  const Study study = readStudyText(sampleStudy, "s.toml");
  RunOptions options;
  options.progress = [](const std::string& task, double) {
    if (task == "probabilities") throw std::runtime_error("no\nmore");
  };
  const Results results = run(study, options);
  EXPECT_EQ(results.stopped, "an internal failure: no\\nmore");
  EXPECT_EQ(results.comparison.verdict, Agreement::incomplete);
  EXPECT_EQ(results.interval.reached, study.horizon);
  options.progress = [](const std::string& task, double) {
    if (task == "enclosure") throw std::runtime_error("nothing");
  };
  EXPECT_THROW(run(study, options), std::runtime_error);
}

TEST(Run, EndsSamplesThatTakeTooLongAndNamesThem) {
  Study study = readStudyText(sampleStudy, "s.toml");
  study.limits.sampleTime = 1e-9;
  const Results results = run(study);
  EXPECT_THAT(results.stochastic.why,
              ::testing::MatchesRegex("sample 0 failed at 0[.0-9]* s: the time limit of 1e-09 s "
                                      "CPU for a sample was reached.*"));
  EXPECT_LT(results.stochastic.reached, 0.5);
  EXPECT_EQ(results.comparison.verdict, Agreement::incomplete);
}

TEST(Run, EndsWhereThereIsNoMoreMemory) {
  RunOptions options;
  options.memoryLimit = 1e6;  // less than any process has
  const Results results = run(readStudyText(sampleStudy, "s.toml"), options);
  EXPECT_EQ(results.interval.why, "the memory limit of 0.000667 GB for the enclosure was reached");
  EXPECT_EQ(results.stochastic.stopped, "the memory limit of 0.001 GB for the whole run was reached");
  EXPECT_EQ(results.comparison.verdict, Agreement::incomplete);
  EXPECT_GT(results.memory, 1e6);
}

/// A pendulum whose rod consists of so many pieces of uncertain length.
std::string piecesOfARod(int count, const std::string& interval) {
  const std::string text = sampleStudyWith("seed = 7\n", interval);
  const auto mass = text.find("[[mechanism.element]]\ntype = \"mass\""), tip = text.find("\"tip\"", mass),
             output = text.find("[[output]]");
  std::string pieces, uncertain, end = "tip";
  for (int i = 0; i < count; ++i) {
    const std::string name = "piece" + std::to_string(i), next = "end" + std::to_string(i);
    pieces += "[[mechanism.element]]\ntype = \"link\"\nname = \"" + name + "\"\nfrom = \"" + end + "\"\nto = \"" +
              next + "\"\nvector = [0, 0, \"-" + name + ".length\"]\nparameters = { length = 0.1 }\n";
    uncertain += "[[uncertain]]\nquantity = \"" + name + ".length\"\ninterval = \"± 1 %\"\n";
    end = next;
  }
  return text.substr(0, mass) + pieces + text.substr(mass, tip - mass) + "\"" + end + "\"" +
         text.substr(tip + 5, output - tip - 5) + uncertain + text.substr(output);
}

TEST(Run, EnclosesManyUncertainQuantitiesWithoutBisectingThem) {
  std::string text = piecesOfARod(150, "");
  text.replace(text.find("sobol"), 5, "random");
  const Results results = run(readStudyText(text, "s.toml"));
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_EQ(results.interval.pieces, 1);
  EXPECT_LT(results.comparison.maximum, 1.5);
  EXPECT_LT(results.cpu, 60);
}

TEST(Run, RefusesPolynomialsOfTooManyTerms) {
  EXPECT_THROW(run(readStudyText(piecesOfARod(39, "[interval]\ndegree = 4\n"), "s.toml")), std::invalid_argument);
}

TEST(Run, ReportsTheProgressOfEveryAnalysis) {
  std::mutex mutex;
  std::map<std::string, double> greatest;
  RunOptions options;
  options.progress = [&](const std::string& task, double fraction) {
    const std::lock_guard lock(mutex);
    greatest[task] = std::max(greatest[task], fraction);
  };
  run(readStudyText(sampleStudy, "s.toml"), options);
  EXPECT_GT(greatest["enclosure"], 0);
  EXPECT_EQ(greatest["samples"], 1);
}

Study kinematicStudy() {
  std::string text = sampleStudyWith("[[uncertain]]", threeUncertain);
  text.replace(text.find("dynamics"), 8, "kinematics");
  text.erase(text.find("horizon = 0.5\n"), 14);
  text.erase(text.find("output_step = 0.1\n"), 18);
  return readStudyText(text, "s.toml");
}

TEST(Run, KeepsPlainIntervalsOfKinematicsThatIsInterrupted) {
  const std::atomic<bool> cancelled{true};
  RunOptions options;
  options.cancelled = &cancelled;
  const Study study = kinematicStudy();
  const Results results = run(study, options), whole = run(study);
  EXPECT_EQ(results.comparison.verdict, Agreement::incomplete);
  EXPECT_EQ(results.interval.why, "the run was interrupted");
  EXPECT_EQ(results.fuzzy.why, "the run was interrupted");
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_EQ(results.interval.at.lower(0, j), whole.interval.direct.lower(0, j));
    EXPECT_EQ(results.interval.at.upper(0, j), whole.interval.direct.upper(0, j));
    for (std::size_t level = 0; level < 11; ++level)
      EXPECT_LE(results.fuzzy.outer[level].lower(0, j), whole.fuzzy.outer[level].lower(0, j));
  }
}

TEST(Run, EndsKinematicsAtTheLimitOfTheEnclosure) {
  Study study = kinematicStudy();
  study.limits.enclosureTime = 1e-9;
  const Results results = run(study);
  EXPECT_EQ(results.interval.why, "the time limit of 1e-09 s CPU for the enclosure was reached");
  EXPECT_EQ(results.stochastic.stopped, "");
  EXPECT_EQ(results.stochastic.integrated, results.stochastic.planned());
  EXPECT_EQ(results.comparison.verdict, Agreement::incomplete);
}

TEST(Run, EnclosesKinematicsWithAnUncertainParameter) {
  const Results results = run(kinematicStudy());
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_EQ(results.time, std::vector<double>{0.0});
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_LE(results.interval.direct.lower(0, j), results.interval.at.lower(0, j));
    EXPECT_GE(results.interval.direct.upper(0, j), results.interval.at.upper(0, j));
    EXPECT_FALSE(std::isnan(results.stochastic.quantiles.front()(0, j)));
  }
}

TEST(Run, MovesAnArmWithoutMassesInKinematics) {
  std::string text = "[study]\ntitle = \"Arm\"\nanalysis = \"kinematics\"\ncompare = [\"interval\", \"stochastic\"]\n";
  for (const char number : {'1', '2', '3'}) {
    const std::string n(1, number),
        base = number == '1' ? "inertial" : "K" + std::string(1, static_cast<char>(number - 1));
    text += "[[mechanism.element]]\ntype = \"revolute\"\nname = \"joint" + n + "\"\nfrom = \"" + base + "\"\nto = \"J" +
            n + "\"\naxis = \"x\"\ninitial = { angle = \"30 deg\" }\n" +
            "[[mechanism.element]]\ntype = \"link\"\nname = \"arm" + n + "\"\nfrom = \"J" + n + "\"\nto = \"K" + n +
            "\"\nvector = [0, 0, -1]\n";
  }
  text +=
      "[[uncertain]]\nquantity = \"joint2.angle\"\ninterval = \"± 1 %\"\n[[output]]\nquantity = \"K3.position.z\"\n"
      "[stochastic]\nsamples = 16\n";
  const Results results = run(readStudyText(text, "s.toml"));
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_LE(results.interval.at.lower(0, 0), -1.3660254);  // -(cos 30° + cos 60° + cos 90°)
  EXPECT_GE(results.interval.at.upper(0, 0), -1.3660254);
}

}  // namespace
}  // namespace gamut
