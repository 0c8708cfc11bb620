// Sweeps: what is put where in a study, what each point finds, and that no interruption changes a bit of it.
#include "studies/sweeps/sweep.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "studies/reading/swept_study.hpp"
#include "studies/results/results_file.hpp"
#include "studies/running/run.hpp"
#include "studies/sweeps/sweep_file.hpp"
#include "tests/studies/damage.hpp"
#include "tests/studies/four_bar_text.hpp"
#include "tests/studies/sample_study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut::sweep_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string demanding = sampleStudy + R"([[requirement]]
name = "slow"
always = "abs(hinge.rate) < 1.7 rad/s"
)";

std::string refusalOf(const std::string& text) {
  try {
    parseSweepAxis(text);
  } catch (const Refusal& refused) {
    return refused.what();
  }
  return "it was read";
}

TEST(SweepAxis, HasTheDoublesNearestToWhatIsMeant) {
  const SweepAxis axis = parseSweepAxis("rod.length=0.9:1.1:21");
  EXPECT_EQ(axis.name, "rod.length");
  EXPECT_EQ(axis.unit, "");
  ASSERT_EQ(axis.values.size(), 21U);
  for (int i = 0; i < 21; ++i) {
    EXPECT_EQ(axis.values[i], (90.0 + i) / 100);  // of whole numbers a quotient is rounded once
    EXPECT_EQ(axis.stated(i), fmt::format("{}", (90.0 + i) / 100));
  }
  EXPECT_THAT(parseSweepAxis("x = 1:2:4").values, ElementsAre(1, 4.0 / 3, 5.0 / 3, 2));
  EXPECT_THAT(parseSweepAxis("x=3:3:1").values, ElementsAre(3));
}

TEST(SweepAxis, TakesUnitsAsStudiesDo) {
  const SweepAxis axis = parseSweepAxis("hinge.angle=10 deg:80 deg:8");
  EXPECT_EQ(axis.unit, "deg");
  EXPECT_THAT(axis.values, ElementsAre(10, 20, 30, 40, 50, 60, 70, 80));
  EXPECT_EQ(axis.stated(1), "\"20 deg\"");
  EXPECT_EQ(parseSweepAxis("hinge.angle=10:80 deg:8").values, axis.values);
  EXPECT_THAT(parseSweepAxis("a=90 cm:1.1 m:3").values, ElementsAre(90, 100, 110));
  EXPECT_THAT(parseSweepAxis("a=1, 5, 2 m/s").values, ElementsAre(1, 2, 5));
  EXPECT_EQ(parseSweepAxis("a=1, 5, 2 m/s").unit, "m/s");
  EXPECT_THAT(parseSweepAxis("a=0:1/2 pi:2").values, ElementsAre(0, std::numbers::pi / 2));
}

TEST(SweepAxis, RefusesWhatIsNone) {
  EXPECT_THAT(refusalOf("rod.length"), HasSubstr("'rod.length' says not what is swept; expected NAME=FROM:TO:COUNT"));
  EXPECT_THAT(refusalOf("a=1:2"), HasSubstr("'a': '1:2' is no range"));
  EXPECT_THAT(refusalOf("a=1:2:0"), HasSubstr("'0' is no number of values; expected a whole number from 1 to 100000"));
  EXPECT_THAT(refusalOf("a=1:2:2.5"), HasSubstr("'2.5' is no number of values"));
  EXPECT_THAT(refusalOf("a=1 m:2:3"), HasSubstr("'a': 2 has no unit, what stands before it has one; expected \"2 m\""));
  EXPECT_THAT(refusalOf("a=1 m:2 kg:3"), HasSubstr("'a': m and kg are of different kinds"));
  EXPECT_THAT(refusalOf("a=1 %:2 %:3"), HasSubstr("is a share of something"));
  EXPECT_THAT(refusalOf("a="), HasSubstr("expected"));
  const auto faultOf = [](const SweepPlan& plan) {
    try {
      check(plan);
    } catch (const Refusal& refused) {
      return std::string(refused.what());
    }
    return std::string();
  };
  const SweepAxis a{"a", "", {1, 2}}, b{"b", "", {1, 2, 3}};
  EXPECT_EQ(faultOf({true, {a, b}}), "");
  EXPECT_THAT(faultOf({true, {a, a}}), HasSubstr("'a' is swept twice"));
  EXPECT_THAT(faultOf({false, {a, b}}), HasSubstr("'b' has 3 values, 'a' has 2"));
  EXPECT_THAT(faultOf({true, {SweepAxis{"a", "", {1, 1}}}}), HasSubstr("'a' has a value twice"));
  EXPECT_THAT(faultOf({true, {SweepAxis{"a", "", std::vector<double>(400)}, SweepAxis{"b", "", {}}}}),
              HasSubstr("has a value twice"));
  EXPECT_THAT(faultOf({true, {}}), HasSubstr("nothing is swept"));
}

TEST(SweepPlan, LetsTheLastAxisRunFastest) {
  const SweepPlan grid{true, {SweepAxis{"a", "m", {1, 2}}, SweepAxis{"b", "", {3, 4, 5}}}};
  ASSERT_EQ(grid.points(), 6U);
  EXPECT_EQ(grid.told(0), "a = 1 m, b = 3");
  EXPECT_EQ(grid.told(2), "a = 1 m, b = 5");
  EXPECT_EQ(grid.told(3), "a = 2 m, b = 3");
  const SweepPlan list{false, {SweepAxis{"a", "", {1, 2}}, SweepAxis{"b", "", {4, 3}}}};
  ASSERT_EQ(list.points(), 2U);
  EXPECT_EQ(list.told(1), "a = 2, b = 3");
}

// ---- What a study is at a point -------------------------------------------------------------------------------------

std::string faultOf(const std::string& text, const std::string& axis) {
  try {
    SweptStudy(text, "s.toml").check({true, {parseSweepAxis(axis)}});
  } catch (const Refusal& refused) {
    return refused.what();
  }
  return "";
}

Study studyAt(const std::string& text, const std::string& axis, std::size_t point = 0) {
  const SweptStudy swept(text, "s.toml");
  const SweepPlan plan{true, {parseSweepAxis(axis)}};
  swept.check(plan);
  return readStudyText(swept.at(plan, point), "s.toml");
}

TEST(SweptStudy, PutsANumberInThePlaceOfAnother) {
  const SweptStudy swept(sampleStudy, "s.toml");
  const SweepPlan plan{true, {parseSweepAxis("rod.length=60 cm"), parseSweepAxis("bob.mass=1:2:2")}};
  swept.check(plan);
  std::string expected = sampleStudyWith("length = 0.5 ", "length = \"60 cm\" ");
  expected.replace(expected.find("\"250 g\""), 7, "2");
  EXPECT_EQ(swept.at(plan, 1), expected);
  EXPECT_TRUE(isEqual(studyAt(sampleStudy, "rod.length=60 cm").mechanism.nominal("rod.length"), Interval("0.6")));
}

TEST(SweptStudy, MovesAToleranceAsItIsStated) {
  const auto rangeAt = [](const std::string& interval) {
    const std::string text = sampleStudyWith("interval = \"± 1 %\"", "interval = " + interval);
    return studyAt(text, "start=60 deg").uncertain[0].uncertain.range;
  };
  const Interval relative = rangeAt("\"± 1 %\""), absolute = rangeAt("\"± 1 deg\"");
  const double degree = std::numbers::pi / 180;
  EXPECT_NEAR(relative.lower(), 59.4 * degree, 1e-12);
  EXPECT_NEAR(relative.upper(), 60.6 * degree, 1e-12);
  EXPECT_NEAR(absolute.lower(), 59 * degree, 1e-12);
  EXPECT_NEAR(absolute.upper(), 61 * degree, 1e-12);
  EXPECT_THROW(rangeAt("[\"29 deg\", \"31 deg\"]"), StudyError);  // the stated interval stays where it is
}

TEST(SweptStudy, FindsNumbersOfAllKinds) {
  EXPECT_EQ(studyAt(sampleStudy, "horizon=0.7").horizon, 0.7);
  EXPECT_EQ(studyAt(sampleStudy, "study.horizon=0.7").horizon, 0.7);
  EXPECT_EQ(studyAt(sampleStudy, "stochastic.samples=8:32:4", 3).ensemble.samples, 32U);
  EXPECT_TRUE(isEqual(studyAt(sampleStudy, "gravity.z=-1.62").mechanism.nominal("gravity.z"), Interval("-1.62")));
  EXPECT_TRUE(isEqual(studyAt(sampleStudy, "hinge.rate=1 rad/s").mechanism.nominal("hinge.rate"), Interval(1)));
  const std::string spread = sampleStudyWith("vector = [0, 0, \"-rod.length\"]", "vector = [ 0, # μ\n 0, '-1 m' ]");
  EXPECT_TRUE(isEqual(studyAt(spread, "rod.vector.z=-3").mechanism.nominal("rod.vector.z"), Interval(-3)));
}

TEST(SweptStudy, RefusesWhatIsNoNumberOfItsOwn) {
  EXPECT_EQ(faultOf(sampleStudy, "rod.lenght=1"), "unknown number 'rod.lenght'; expected 'rod.length'");
  EXPECT_EQ(faultOf(sampleStudy, "rod.vector.z=1"),
            "'rod.vector.z' follows from a formula; expected one of the quantities in it: rod.length");
  EXPECT_EQ(faultOf(sampleStudy, "rod.length=1 kg"), "'rod.length' is in m, not in kg; expected numbers in m");
  EXPECT_THAT(faultOf(sampleStudy, "interval.degree=2"),
              HasSubstr("the study does not state the number 'interval.degree'; expected a line 'degree = ...' in "
                        "[interval]"));
  EXPECT_THAT(faultOf(sampleStudyWith("angle = \"30 deg\", rate = 0.5", "angle = \"30 deg\""), "hinge.rate=1"),
              HasSubstr("the study does not state the number 'hinge.rate'"));
  EXPECT_THAT(faultOf(sampleStudy, "stochastic.samples=1 m"), HasSubstr("numbers without a unit"));
  EXPECT_THAT(faultOf(sampleStudy, "study.title=1"), HasSubstr("unknown number"));
  EXPECT_THAT(faultOf(sampleStudy, "bob=1"), HasSubstr("unknown number 'bob'"));
  try {
    SweptStudy(sampleStudy, "s.toml").check({true, {parseSweepAxis("start=1"), parseSweepAxis("hinge.angle=1")}});
    FAIL() << "one number twice";
  } catch (const Refusal& refused) {
    EXPECT_THAT(refused.what(), HasSubstr("are one number"));
  }
}

TEST(SweptStudy, StatesItsSweepInTables) {
  const std::string text = sampleStudy +
                           "[[sweep]]\nquantity = \"rod.length\"\nfrom = 0.4\nto = \"60 cm\"\ncount = 3\n"
                           "[[sweep]]\nquantity = \"start\"\nvalues = [\"20 deg\", \"40 deg\"]\n";
  const SweepPlan plan = sweepStatedIn(text, "s.toml");
  ASSERT_EQ(plan.axes.size(), 2U);
  EXPECT_EQ(plan.axes[0].unit, "cm");
  EXPECT_THAT(plan.axes[0].values, ElementsAre(40, 50, 60));
  EXPECT_THAT(plan.axes[1].values, ElementsAre(20, 40));
  EXPECT_EQ(readStudyText(text, "s.toml").horizon, 0.5);  // and a study with it is one
  EXPECT_TRUE(sweepStatedIn(sampleStudy, "s.toml").axes.empty());
  const auto said = [](const std::string& table) { return messageOf(sampleStudy + "[[sweep]]\n" + table); };
  EXPECT_THAT(said("values = [1]"), HasSubstr("'sweep.quantity' is missing"));
  EXPECT_THAT(said("quantity = \"rod.lenght\"\nvalues = [1]"), HasSubstr("s.toml:44:12: unknown number 'rod.lenght'"));
  EXPECT_THAT(said("quantity = \"rod.length\""), HasSubstr("has either sweep.values or sweep.from"));
  EXPECT_THAT(said("quantity = \"rod.length\"\nvalues = [1]\ncount = 2"), HasSubstr("has either sweep.values"));
  EXPECT_THAT(said("quantity = \"rod.length\"\nfrom = 1\ncount = 2"), HasSubstr("'sweep.to' is missing"));
  EXPECT_THAT(said("quantity = \"rod.length\"\nvalues = [\"1 kg\"]"), HasSubstr("'rod.length' is in m, not in kg"));
  EXPECT_THAT(said("quantity = \"rod.length\"\nwhat = 1"), HasSubstr("unknown key 'what' in [sweep]"));
}

TEST(SweepPoints, AreRowsOfATable) {
  const SweepPlan plan = sweepPoints("rod.length [cm], start (deg)\n60,10\n# not this one\n40,20\n60,10\n", "p.csv");
  EXPECT_FALSE(plan.isGrid);
  ASSERT_EQ(plan.axes.size(), 2U);
  EXPECT_EQ(plan.axes[0].name, "rod.length");
  EXPECT_EQ(plan.axes[0].unit, "cm");
  EXPECT_THAT(plan.axes[0].values, ElementsAre(60, 40, 60));
  EXPECT_EQ(plan.axes[1].unit, "deg");
  EXPECT_THAT(plan.axes[1].values, ElementsAre(10, 20, 10));
  EXPECT_THROW(sweepPoints("a\n", "p.csv"), std::invalid_argument);
  EXPECT_THROW(sweepPoints("a,b\n1\n", "p.csv"), StudyError);
  EXPECT_THROW(sweepPoints("a [apples]\n1\n", "p.csv"), StudyError);
}

// ---- Runs -----------------------------------------------------------------------------------------------------------

SweepPlan smallPlan() {
  return {true, {parseSweepAxis("rod.length=0.4:0.6:3"), parseSweepAxis("start=20 deg:40 deg:2")}};
}

SweepResults sweptAnew(const std::string& text, const SweepPlan& plan, const SweepOptions& options) {
  SweepResults sweep = plannedSweep(text, "s.toml", plan, options);
  runSweep(sweep, options);
  return sweep;
}

bool isSameBit(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

/// But for what it cost.
void expectSame(const SweepResults& one, const SweepResults& other) {
  ASSERT_EQ(one.points.size(), other.points.size());
  for (std::size_t p = 0; p < one.points.size(); ++p) {
    EXPECT_EQ(one.points[p].state, other.points[p].state) << p;
    EXPECT_EQ(one.points[p].why, other.points[p].why) << p;
    EXPECT_EQ(one.points[p].verdict, other.points[p].verdict) << p;
    EXPECT_TRUE(isSameBit(one.points[p].reached, other.points[p].reached)) << p;
  }
  const auto expectSameGrids = [](const std::vector<Grid>& some, const std::vector<Grid>& others) {
    ASSERT_EQ(some.size(), others.size());
    for (std::size_t g = 0; g < some.size(); ++g) {
      EXPECT_EQ(some[g].extents, others[g].extents);
      EXPECT_TRUE(std::ranges::equal(some[g].data, others[g].data, isSameBit)) << g;
    }
  };
  expectSameGrids(one.ofRequirements, other.ofRequirements);
  expectSameGrids(one.ofOutputs, other.ofOutputs);
}

TEST(Sweep, FindsAtEachPointWhatARunOfThatStudyFinds) {
  const SweepResults sweep = sweptAnew(demanding, smallPlan(), {.jobs = 2});
  ASSERT_EQ(sweep.count(PointState::done), 6U);
  ASSERT_EQ(sweep.outputs.size(), 2U);
  ASSERT_EQ(sweep.requirements.size(), 1U);
  std::set<double> words;
  for (std::size_t p = 0; p < 6; ++p) {
    SCOPED_TRACE(sweep.plan.told(p));
    const Results alone = run(readStudyText(studyTextAt(sweep, p), "s.toml"));
    EXPECT_EQ(sweep.points[p].verdict, "inside");
    EXPECT_EQ(sweep.points[p].why, "");
    EXPECT_EQ(sweep.points[p].reached, 0.5);
    EXPECT_GT(sweep.points[p].cpu, 0);
    const RequirementResult& slow = alone.requirements[0];
    words.insert(sweep.at(OfRequirement::word, p, 0));
    EXPECT_EQ(sweep.at(OfRequirement::word, p, 0), static_cast<double>(slow.word));
    EXPECT_EQ(sweep.at(OfRequirement::probabilityLower, p, 0), slow.probabilityLower);
    EXPECT_EQ(sweep.at(OfRequirement::possibilityUpper, p, 0), slow.violationMost);
    EXPECT_EQ(sweep.at(OfRequirement::violating, p, 0), static_cast<double>(slow.violating));
    for (std::size_t o = 0; o < 2; ++o) {
      EXPECT_EQ(sweep.at(OfOutput::lastLower, p, o), alone.interval.at.lower(5, o));
      EXPECT_EQ(sweep.at(OfOutput::lastMean, p, o), alone.stochastic.mean(5, o));
      double least = INFINITY, greatest = -INFINITY;
      for (std::size_t t = 0; t < 6; ++t) {
        least = std::min(least, alone.interval.over.lower(t, o));
        greatest = std::max(greatest, alone.interval.over.upper(t, o));
      }
      EXPECT_EQ(sweep.at(OfOutput::least, p, o), least);
      EXPECT_EQ(sweep.at(OfOutput::greatest, p, o), greatest);
      EXPECT_LE(sweep.at(OfOutput::least, p, o), sweep.at(OfOutput::sampledLeast, p, o));
    }
  }
  EXPECT_GT(words.size(), 1U) << "the sweep is to cross the limit";
}

TEST(Sweep, TakesSeedAndSamplesOfItsOptions) {
  const SweepPlan plan{true, {parseSweepAxis("rod.length=0.5")}};
  const SweepResults sweep = sweptAnew(demanding, plan, {.seed = 11, .samples = 24});
  RunOptions options;
  options.seed = 11;
  options.samples = 24;
  const Results alone = run(readStudyText(demanding, "s.toml"), options);
  EXPECT_EQ(sweep.at(OfRequirement::samples, 0, 0), 24);
  EXPECT_EQ(sweep.at(OfOutput::lastMean, 0, 0), alone.stochastic.mean(5, 0));
}

TEST(Sweep, IsTheSameForAnyJobsAndInterruptions) {
  const SweepResults whole = sweptAnew(demanding, smallPlan(), {.jobs = 1});
  expectSame(sweptAnew(demanding, smallPlan(), {.jobs = 3}), whole);

  std::atomic<bool> cancelled{false};
  SweepOptions options{.jobs = 2, .betweenKeeps = 0, .cancelled = &cancelled};
  SweepResults sweep = plannedSweep(demanding, "s.toml", smallPlan(), options);
  int interruptions = 0;
  options.progress = [&](double) { cancelled = true; };
  for (; sweep.count(PointState::open) > 0 && interruptions < 10; ++interruptions) {
    cancelled = false;
    const std::size_t before = sweep.count(PointState::open);
    runSweep(sweep, options);
    EXPECT_LT(sweep.count(PointState::open), before);
  }
  EXPECT_GT(interruptions, 2);
  expectSame(sweep, whole);
}

TEST(Sweep, KeepsOnTheWayWhatAnotherRunGoesOnWith) {
  const TemporaryFolder folder;
  const std::string path = folder.path("s.h5");
  SweepOptions options{.jobs = 1, .betweenKeeps = 0};
  std::size_t kept = 0;
  std::vector<SweepResults> states;
  options.keep = [&](const SweepResults& sweep) {
    OutputFile file(path, OutputFile::Existing::isReplaced);
    writeSweep(sweep, file);
    states.push_back(readSweep(path));
    ++kept;
  };
  const SweepResults whole = sweptAnew(demanding, smallPlan(), options);
  EXPECT_GE(kept, 2U);  // on the way, and at the end
  expectSame(states.back(), whole);
  for (SweepResults& state : states) {
    EXPECT_TRUE(asksTheSame(state, whole));
    runSweep(state, {.jobs = 2});
    expectSame(state, whole);
  }
}

/// Two lengths of a crank with which no four-bar closes, one after whose start it comes to a dead point.
TEST(Sweep, SaysOfEachPointWhyItCannotBeRun) {
  const std::string text = gamut::testing::fourBarText("0.02", gamut::testing::uncertain({"a"}, "± 0.1 %"));
  const SweepResults sweep = sweptAnew(text, {true, {parseSweepAxis("a=0.3, 0.31, 5 m")}}, {.jobs = 2});
  EXPECT_EQ(sweep.points[0].state, PointState::done) << sweep.points[0].why;
  EXPECT_EQ(sweep.points[1].state, PointState::done) << sweep.points[1].why;
  EXPECT_EQ(sweep.points[2].state, PointState::refused);
  EXPECT_NE(sweep.points[2].why, "");
  EXPECT_TRUE(std::isnan(sweep.at(OfOutput::least, 2, 0)));
  EXPECT_FALSE(std::isnan(sweep.at(OfOutput::least, 1, 0)));
}

TEST(Sweep, SaysWhereAnAnalysisEndedEarly) {
  const SweepPlan plan{true, {parseSweepAxis("rod.length=0.5, 0.6")}};
  const SweepResults sweep = sweptAnew(demanding, plan, {.timeLimit = 1e-6});
  for (const SweepPoint& point : sweep.points) {
    EXPECT_EQ(point.state, PointState::early);
    EXPECT_THAT(point.why, HasSubstr("limit"));
  }
}

TEST(Sweep, IsRefusedWhereNoPointCanBeRead) {
  const std::string fixed = sampleStudyWith("interval = \"± 1 %\"", "interval = [\"29 deg\", \"31 deg\"]");
  EXPECT_THROW(plannedSweep(fixed, "s.toml", {true, {parseSweepAxis("start=50 deg:60 deg:3")}}, {}), StudyError);
  const SweepResults sweep = sweptAnew(fixed, {true, {parseSweepAxis("start=30 deg:60 deg:2")}}, {.jobs = 2});
  EXPECT_EQ(sweep.points[0].state, PointState::done);
  EXPECT_EQ(sweep.points[1].state, PointState::refused);
}

// ---- The file -------------------------------------------------------------------------------------------------------

SweepResults invented(bool isGrid) {
  SweepResults sweep;
  sweep.plan = {isGrid, {SweepAxis{"rod.length", "cm", {10, 20}}, SweepAxis{"a/b", "", {-1, 3}}}};
  sweep.studyText = sampleStudy;
  sweep.studyFile = "s.toml";
  sweep.title = "Pendulum";
  sweep.outputs = {{"angle", "hinge.angle", "rad"}, {"height", "tip.position.z", "m"}};
  sweep.requirements = {{"slow", "always abs(hinge.rate) < 1"}};
  prepare(sweep);
  const std::size_t count = requirementColumns().size() + 2 * outputColumns().size();
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(0.125 * static_cast<double>(i));
  SweepPoint point;
  point.number = 1;
  point.state = PointState::early;
  point.why = "for no reason";
  point.reached = 0.25;
  put(sweep, point, numbers);
  return sweep;
}

TEST(SweepFile, HoldsWhatWasWritten) {
  const TemporaryFolder folder;
  for (const bool isGrid : {true, false}) {
    const SweepResults sweep = invented(isGrid);
    OutputFile file(folder.path("s.h5"), OutputFile::Existing::isReplaced);
    writeSweep(sweep, file);
    EXPECT_TRUE(isSweepFile(folder.path("s.h5")));
    const SweepResults read = readSweep(folder.path("s.h5"));
    EXPECT_TRUE(asksTheSame(read, sweep));
    expectSame(read, sweep);
    EXPECT_EQ(read.outputs[1].unit, "m");
    EXPECT_EQ(read.requirements[0].statement, "always abs(hinge.rate) < 1");
    EXPECT_EQ(read.points[1].why, "for no reason");
    EXPECT_EQ(read.plan.axes[1].name, "a/b");
  }
}

TEST(SweepFile, IsToldApartFromResults) {
  const TemporaryFolder folder;
  OutputFile file(folder.path("s.h5"), OutputFile::Existing::isReplaced);
  writeSweep(invented(true), file);
  const auto said = [](const auto& read) {
    try {
      read();
    } catch (const ResultsFileError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(said([&] { readResults(folder.path("s.h5")); }),
            folder.path("s.h5") + ": holds a sweep; expected a results file written by gamut run");
  writeResults(run(readStudyText(sampleStudy, "s.toml")), folder.path("r.h5"));
  EXPECT_EQ(said([&] { readSweep(folder.path("r.h5")); }),
            folder.path("r.h5") + ": holds results; expected a file written by gamut sweep");
  EXPECT_FALSE(isSweepFile(folder.path("r.h5")));
  EXPECT_FALSE(isSweepFile(folder.path("none.h5")));
}

TEST(SweepFile, IsRefusedIfItIsDamaged) {
  const TemporaryFolder folder;
  {
    OutputFile file(folder.path("s.h5"), OutputFile::Existing::isReplaced);
    writeSweep(invented(true), file);
  }
  const std::string bytes = folder.read("s.h5");
  std::mt19937_64 random(5);
  for (int i = 0; i < 50; ++i) {
    const std::string other = damaged(bytes, random);
    if (other == bytes) continue;
    folder.write("d.h5", other);
    EXPECT_THROW(readSweep(folder.path("d.h5")), ResultsFileError);
  }
}

TEST(SweepFile, IsDescribedInTheGuide) {
  std::ifstream file(GAMUT_SOURCE_DIR "/docs/sweeps.md");
  const std::string guide{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(guide, HasSubstr(guideToSweepFile())) << guideToSweepFile();
}

}  // namespace gamut::sweep_test
