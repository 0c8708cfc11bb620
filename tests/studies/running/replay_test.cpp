// A replay gives each sample as it went into the statistics, bit for bit, from the results alone.
#include "studies/running/replay.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <bit>
#include <map>
#include <stdexcept>

#include "studies/results/results_file.hpp"
#include "studies/running/run.hpp"
#include "tests/studies/sample_study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

/// Two links that stand still.
constexpr const char* kinematics = R"([study]
analysis = "kinematics"
compare = ["stochastic"]
[mechanism]
[[mechanism.element]]
type = "revolute"
name = "shoulder"
from = "inertial"
to = "K1"
axis = "x"
initial = { angle = "0.3 rad" }
[[mechanism.element]]
type = "link"
name = "upper"
from = "K1"
to = "K2"
vector = [0.1, 0.2, "-upper.length"]
parameters = { length = 0.5 }
[[mechanism.element]]
type = "revolute"
name = "elbow"
from = "K2"
to = "K3"
axis = [1, 2, 3]
initial = { angle = "0.7 rad" }
[[mechanism.element]]
type = "link"
name = "lower"
from = "K3"
to = "tip"
vector = [0.3, "upper.length", "-0.7 upper.length"]
[[uncertain]]
quantity = "shoulder.angle"
interval = "± 10 %"
[[uncertain]]
quantity = "upper.length"
interval = "± 5 mm"
[[uncertain]]
quantity = "elbow.angle"
interval = "± 20 %"
[[output]]
quantity = "tip.position.x"
[[output]]
quantity = "tip.position.y"
[[output]]
quantity = "tip.position.z"
[stochastic]
samples = 200
)";

std::vector<std::uint64_t> bitsOf(const std::vector<double>& values) {
  std::vector<std::uint64_t> bits;
  for (const double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

/// As the statistics do: sample by sample.
Envelope envelopeOfReplays(const Results& results) {
  const Machine machine(readStudyText(results.studyText, "again.toml"));
  const Study& study = machine.study;
  Envelope envelope(study.times.size(), study.outputs.size());
  for (std::int64_t number = 0; number < results.stochastic.planned(); ++number) {
    const ReplayedSample sample = replay(machine, results, static_cast<std::size_t>(number));
    EXPECT_EQ(sample.times, study.times.size());
    for (std::size_t i = 0; i < sample.times; ++i)
      for (std::size_t j = 0; j < study.outputs.size(); ++j) envelope.include(i, j, sample.trajectory(i, j));
  }
  return envelope;
}

/// The results as a file gives them back.
Results resultsOf(const std::string& text, const RunOptions& options = {}) {
  const TemporaryFolder folder;
  writeResults(run(readStudyText(text, "s.toml"), options), folder.path("r.h5"));
  return readResults(folder.path("r.h5"));
}

void expectTheEnvelope(const Results& results) {
  ASSERT_EQ(results.stochastic.integrated, results.stochastic.planned());
  const Envelope envelope = envelopeOfReplays(results);
  EXPECT_THAT(bitsOf(envelope.lower.data), ElementsAreArray(bitsOf(results.stochastic.envelope.lower.data)));
  EXPECT_THAT(bitsOf(envelope.upper.data), ElementsAreArray(bitsOf(results.stochastic.envelope.upper.data)));
}

TEST(Replay, OfAllSamplesGivesTheEnvelopeOfTheRun) { expectTheEnvelope(resultsOf(sampleStudy)); }

TEST(Replay, TakesSeedAndNumberOfSamplesFromTheRun) {
  RunOptions options;
  options.seed = 12345;
  options.samples = 150;  // two full packs and a part
  options.jobs = 2;
  const Results results = resultsOf(sampleStudy, options);
  expectTheEnvelope(results);
  const Machine machine(readStudyText(sampleStudy, "s.toml"));
  Results other = results;
  other.seed = 12346;
  EXPECT_NE(replay(machine, results, 77).values, replay(machine, other, 77).values);
}

TEST(Replay, HoldsForEveryPlanAndMethod) {
  for (const char* plan : {"random", "latin-hypercube", "halton", "grid"}) {
    SCOPED_TRACE(plan);
    expectTheEnvelope(resultsOf(sampleStudyWith("plan = \"sobol\"", "plan = \"" + std::string(plan) + "\"")));
  }
  expectTheEnvelope(resultsOf(sampleStudy + "method = \"bdf\"\n"));
}

TEST(Replay, HoldsForKinematics) {
  expectTheEnvelope(resultsOf(kinematics));
  std::string all = kinematics;
  const std::string alone = "compare = [\"stochastic\"]\n";
  expectTheEnvelope(resultsOf(all.erase(all.find(alone), alone.size())));
}

TEST(Replay, HoldsWithoutAnEnclosureAndWithoutAlphaCuts) {
  for (const char* compare : {R"(["stochastic"])", R"(["interval", "stochastic"])", R"(["stochastic", "fuzzy"])"}) {
    SCOPED_TRACE(compare);
    expectTheEnvelope(resultsOf(sampleStudyWith(R"(["interval", "stochastic", "fuzzy"])", compare)));
  }
}

/// sampleStudy from where the height is lowest inside the box, by a rod of uncertain length.
std::string studyWithExtremes() {
  std::string text = sampleStudyWith("interval = \"± 1 %\"", "interval = [\"-20 deg\", \"30 deg\"]");
  text.replace(text.find("\"30 deg\", rate"), 8, "\"2 deg\"");
  return text.insert(text.find("[[uncertain]]"), "[[uncertain]]\nquantity = \"rod.length\"\ninterval = \"± 5 %\"\n");
}

TEST(Replay, HoldsForExtremesWhateverPointsThereAreBesides) {
  for (const char* compare : {R"(["interval", "stochastic"])", R"(["interval", "stochastic", "fuzzy"])"}) {
    SCOPED_TRACE(compare);
    std::string text = studyWithExtremes();
    const std::string all = R"(["interval", "stochastic", "fuzzy"])";
    text.replace(text.find(all), all.size(), compare);
    const Results results = resultsOf(text);
    const ExtremeSamples& extremes = results.stochastic.extremes;
    ASSERT_THAT(extremes.number, Not(IsEmpty()));
    expectTheEnvelope(results);
    const Machine machine(readStudyText(results.studyText, "s.toml"));
    for (std::size_t i = 0; i < extremes.number.size(); ++i)
      EXPECT_THAT(replay(machine, results, static_cast<std::size_t>(extremes.number[i])).values,
                  ElementsAre(extremes.values[2 * i], extremes.values[2 * i + 1]));
  }
}

TEST(Replay, HoldsForWorstCourses) {
  std::string text = sampleStudy + "[distribution]\ntimes = 0\n";
  text.insert(text.find("[[uncertain]]"),
              "[[uncertain]]\nquantity = \"gravity.z\"\ninterval = [-10, -9.6]\nvaries = \"freely\"\n");
  const Results results = resultsOf(text);
  ASSERT_TRUE(results.stochastic.switching.present);
  expectTheEnvelope(results);
}

TEST(Replay, OfADisputedSampleGivesWhatSettledIt) {
  const Results results = resultsOf(sampleStudy);
  const Machine machine(readStudyText(results.studyText, "s.toml"));
  ASSERT_THAT(results.comparison.disputed, Not(IsEmpty()));
  std::map<std::int64_t, DisputedSample> last;  // what a sample became at last
  for (const DisputedSample& disputed : results.comparison.disputed) last[disputed.number] = disputed;
  for (const auto& [number, disputed] : last) {
    const ReplayedSample sample = replay(machine, results, static_cast<std::size_t>(number));
    EXPECT_EQ(sample.decided, wordOf(disputed.decided));
    EXPECT_EQ(sample.trajectory(disputed.time, disputed.output), disputed.value);
  }
}

TEST(Replay, OfAnInterruptedRunOrOneWithOtherLimitsIsThatOfAWholeOne) {
  std::atomic<bool> cancelled{false};
  RunOptions interruptedOptions;
  interruptedOptions.samples = 300;
  interruptedOptions.cancelled = &cancelled;
  interruptedOptions.progress = [&](const std::string& task, double) {
    if (task == "enclosure") cancelled = true;
  };
  const Results interruptedRun = resultsOf(sampleStudy, interruptedOptions);
  ASSERT_LT(interruptedRun.stochastic.integrated, interruptedRun.stochastic.planned());
  RunOptions whole;
  whole.samples = 300;
  whole.timeLimit = 1e6;
  const Results wholeRun = resultsOf(sampleStudy, whole);
  const Machine machine(readStudyText(sampleStudy, "s.toml"));
  for (const std::size_t number : {0U, 130U, 299U}) {
    const ReplayedSample one = replay(machine, interruptedRun, number), other = replay(machine, wholeRun, number);
    EXPECT_EQ(one.values, other.values);
    if (other.decided.empty()) {
      EXPECT_THAT(bitsOf(one.trajectory.data), ElementsAreArray(bitsOf(other.trajectory.data)));
    }
  }
}

TEST(Replay, OfCornersAndCentreHasTheValuesOfTheirPlaces) {
  const Results results = resultsOf(sampleStudy);
  const Machine machine(readStudyText(results.studyText, "s.toml"));
  const UncertainInfo& angle = results.uncertain.front();
  const auto first = static_cast<std::size_t>(results.stochastic.samples);
  EXPECT_EQ(replay(machine, results, first).values.front(), angle.lower);
  EXPECT_EQ(replay(machine, results, first + 1).values.front(), angle.upper);
  const auto centre = static_cast<std::size_t>(results.stochastic.centre());
  EXPECT_EQ(replay(machine, results, centre).values.front(), angle.nominal);
}

TEST(Replay, RefusesWhatIsNotThere) {
  const Results results = resultsOf(sampleStudy);
  const Machine machine(readStudyText(results.studyText, "s.toml"));
  const auto planned = static_cast<std::size_t>(results.stochastic.planned());
  EXPECT_NO_THROW(replay(machine, results, planned - 1));
  EXPECT_THAT([&] { replay(machine, results, planned); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("no sample has the number")));
  Results without = results;
  without.stochastic = {};
  EXPECT_THAT([&] { replay(machine, without, 0); },
              ThrowsMessage<std::invalid_argument>("the results hold no samples"));
}

}  // namespace
}  // namespace gamut
