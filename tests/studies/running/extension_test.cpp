// More samples for results that are there: they say what a run of as many says, and all that was proved stays.
#include "studies/running/extension.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "studies/results/results_file.hpp"
#include "studies/results/verdict.hpp"
#include "tests/studies/sample_study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

/// sampleStudy from a start whose lowest height neither corners nor centre have, with requirements of each kind.
const std::string study = [] {
  std::string text = sampleStudyWith("interval = \"± 1 %\"", "interval = [-0.11, 0.3]");
  text.replace(text.find("\"30 deg\""), 8, "0.1");
  return text + R"([[requirement]]
name = "low"
always = "tip.position.z < 0"
[[requirement]]
name = "slow"
always = "abs(hinge.rate) < 0.8 rad/s"
[[requirement]]
name = "far"
eventually = "hinge.angle > 0.25 rad"
[distribution]
times = 2
)";
}();

std::string with(const std::string& old, const std::string& replacement, std::string text = study) {
  return text.replace(text.find(old), old.size(), replacement);
}

Results stored(const Results& results) {
  const TemporaryFolder folder;
  writeResults(results, folder.path("r.h5"));
  return readResults(folder.path("r.h5"));
}

RunOptions samples(std::size_t count) {
  RunOptions options;
  options.samples = count;
  options.jobs = 2;
  return options;
}

/// The results as a file gives them back.
Results runOf(const std::string& text, const RunOptions& options) {
  return stored(run(readStudyText(text, "s.toml"), options));
}

Extension extended(const Results& results, const RunOptions& options) {
  return extend(Machine(readStudyText(results.studyText, "s.toml")), results, options);
}

/// Paths in which two results differ, but those that begin so.
std::vector<std::string> differencesBut(const Results& one, const Results& other,
                                        std::initializer_list<std::string_view> beginnings) {
  std::vector<std::string> paths = differences(one, other);
  std::erase_if(paths, [&](const std::string& path) {
    return std::ranges::any_of(beginnings, [&](std::string_view begin) { return path.starts_with(begin); });
  });
  return paths;
}

/// Extends `few` samples and compares with a run of `many`.
void expectTheSameOf(const std::string& text, std::size_t few = 256, std::size_t many = 1024) {
  const Results before = runOf(text, samples(few));
  const Extension extension = extended(before, samples(many));
  EXPECT_TRUE(extension.isMore);
  EXPECT_GT(extension.met, few / 2);
  EXPECT_EQ(extension.changed, 0U);
  const Results after = stored(extension.results);
  EXPECT_THAT(differencesBut(after, runOf(text, samples(many)),
                             {"/study/cpu", "/study/costs/cpu", "/study/date", "/study/memory", "/study/extensions",
                              "/interval/cpu", "/stochastic/cpu", "/fuzzy/cpu", "/distribution/cpu",
                              "/requirements/proof/cpu", "/requirements/violation"}),
              IsEmpty());
  EXPECT_THAT(
      differencesBut(after, before,
                     {"/study/cpu", "/study/costs/cpu", "/study/memory", "/study/extensions", "/interval/cpu",
                      "/stochastic", "/comparison", "/fuzzy/inner", "/fuzzy/influence", "/fuzzy/transformation/gap",
                      "/requirements/violation_sample", "/requirements/samples", "/requirements/violating",
                      "/requirements/proof/cpu", "/requirements/share", "/requirements/worst", "/distribution/sampled",
                      "/distribution/excess", "/distribution/band"}),
      IsEmpty());
  EXPECT_GT(after.stochastic.samples, before.stochastic.samples);
  ASSERT_EQ(after.extensions.size(), 1U);
  EXPECT_EQ(after.extensions[0].before, before.stochastic.samples);
}

TEST(Extension, SaysWhatARunOfAsManySamplesSays) {
  expectTheSameOf(study);
  expectTheSameOf(with("plan = \"sobol\"", "plan = \"random\""));
  expectTheSameOf(with("plan = \"sobol\"", "plan = \"halton\""), 100, 320);
}

TEST(Extension, HoldsForManyQuantities) {
  std::string names;
  for (int i = 0; i < 60; ++i) names += "gain" + std::to_string(i) + " = 1, ";
  std::string text = with(R"(["interval", "stochastic", "fuzzy"])", R"(["stochastic"])");
  text = with("[[mechanism.element]]", "parameters = { " + names + "none = 0 }\n[[mechanism.element]]", text);
  text = with("[[uncertain]]", "[[uncertain]]\nquantity = \"gain*\"\ninterval = \"± 1 %\"\n[[uncertain]]", text);
  expectTheSameOf(text, 64, 256);
}

TEST(Extension, HoldsForOtherMethodsAndAnswers) {
  expectTheSameOf(study.substr(0, study.find("[[requirement]]")) + "method = \"bdf\"\n", 64, 96);
  for (const char* compare : {R"(["stochastic"])", R"(["interval", "stochastic"])", R"(["stochastic", "fuzzy"])"}) {
    SCOPED_TRACE(compare);
    expectTheSameOf(with(R"(["interval", "stochastic", "fuzzy"])", compare), 64, 256);
  }
}

TEST(Extension, KeepsExtremesWhereTheyAre) {
  const std::string text =
      with("[[uncertain]]", "[[uncertain]]\nquantity = \"rod.length\"\ninterval = \"± 5 %\"\n[[uncertain]]");
  ASSERT_FALSE(runOf(text, samples(32)).stochastic.extremes.number.empty());
  expectTheSameOf(text, 64, 320);
}

TEST(Extension, HoldsForKinematics) {
  std::string text = study.substr(0, study.find("[[requirement]]"));
  text = with("horizon = 0.5\noutput_step = 0.1\n", "", with("\"dynamics\"", "\"kinematics\"", text));
  expectTheSameOf(text, 64, 320);
}

/// Without models of the outputs, which are as tight as there is time for.
TEST(Extension, HoldsForWhatVariesInTime) {
  const std::string text = study.substr(0, study.find("[[requirement]]")) + "[distribution]\ntimes = 0\n";
  expectTheSameOf(with("[[output]]\nname = \"angle\"", R"([[uncertain]]
name = "length"
quantity = "rod.length"
interval = "± 1 %"
varies = "freely"
[[output]]
name = "angle")",
                       text),
                  128, 256);
}

TEST(Extension, OfAnExtensionCountsAllOfThem) {
  const Results first = stored(extended(runOf(study, samples(32)), samples(64)).results);
  const Results second = stored(extended(first, samples(256)).results);
  ASSERT_EQ(second.extensions.size(), 2U);
  EXPECT_EQ(second.extensions[0].before, 32);
  EXPECT_EQ(second.extensions[1].before, 64);
  EXPECT_THAT(differencesBut(second, extended(runOf(study, samples(256)), samples(512)).results, {"/"}), IsEmpty());
}

/// Their last pack is not full: its samples share their steps with others then.
TEST(Extension, MeetsOnlySamplesThatShareTheirStepsWithTheSame) {
  const Results before = runOf(study, samples(80));
  const Extension extension = extended(before, samples(256));
  const auto beside = static_cast<std::size_t>(before.stochastic.planned() - before.stochastic.samples);
  EXPECT_LE(extension.met, 64 + beside);
  EXPECT_EQ(extension.changed, 0U);
}

TEST(Extension, RefusesWhatCannotBeExtended) {
  const Results before = runOf(study, samples(64));
  const auto refusal = [](const Results& results, std::size_t count) {
    return [&results, count] { extended(results, samples(count)); };
  };
  EXPECT_THAT(refusal(before, 64),
              ThrowsMessage<std::invalid_argument>("holds 64 samples, and would hold 64; expected more"));
  EXPECT_THAT(refusal(before, 17),
              ThrowsMessage<std::invalid_argument>("holds 64 samples, and would hold 17; expected more"));
  for (const char* plan : {"latin-hypercube", "grid"}) {
    const Results other = runOf(with("plan = \"sobol\"", "plan = \"" + std::string(plan) + "\""), samples(64));
    EXPECT_THAT(refusal(other, 1024),
                ThrowsMessage<std::invalid_argument>(
                    HasSubstr("of the plan " + std::string(plan) + ", by which more samples lie elsewhere")));
  }
  const Results without = runOf(with(R"(["interval", "stochastic", "fuzzy"])", R"(["interval"])"), {});
  EXPECT_THAT(refusal(without, 64), ThrowsMessage<std::invalid_argument>(HasSubstr("holds no samples")));
}

TEST(Extension, TellsWhetherSamplesAreTheSame) {
  const Results before = runOf(study, samples(64));
  Results other = before;
  other.stochastic.kept.motions[17] = std::nextafter(other.stochastic.kept.motions[17], 10);
  const Extension extension = extended(other, samples(256));
  EXPECT_EQ(extension.changed, 1U);
  EXPECT_GT(extension.met, 64U);
  other.stochastic.kept.motions[17] += 1e-3;
  EXPECT_THAT([&] { extended(other, samples(256)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("its motion is another one")));
  other = before;
  other.stochastic.kept.values[5] = 0.2;
  EXPECT_THAT([&] { extended(other, samples(256)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("sample 5 would have start = ")));
  other = before;
  other.time.back() = 0.6;
  EXPECT_THAT([&] { extended(other, samples(256)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("had read another study from the same text")));
}

/// At the start the height is least where the rod hangs straight: the more samples, the closer.
TEST(Extension, FindsABoundThatNewSamplesLeave) {
  const Results before = runOf(study, samples(64));
  const Results whole = extended(before, samples(1024)).results;
  EXPECT_EQ(whole.comparison.verdict, Agreement::inside);
  const double few = before.stochastic.envelope.lower(0, 1), many = whole.stochastic.envelope.lower(0, 1);
  ASSERT_LT(many, few);
  Results tampered = before;
  tampered.interval.at.lower(0, 1) = 0.5 * (few + many);
  EXPECT_EQ(findVerdict(tampered).word, Agreement::inside);
  const Results after = stored(extended(tampered, samples(1024)).results);
  EXPECT_EQ(after.comparison.verdict, Agreement::outside);
  EXPECT_EQ(findVerdict(after).word, Agreement::outside);
}

TEST(Extension, ThatIsEndedEarlyKeepsWhatItFoundIfThatIsMore) {
  const Results before = runOf(study, samples(256));
  const auto endedAt = [&](double end) {
    std::atomic<bool> cancelled{end == 0};
    RunOptions options = samples(65536);
    options.cancelled = &cancelled;
    options.progress = [&](const std::string& task, double fraction) {
      if (task == "samples" && fraction >= end) cancelled = true;
    };
    return extended(before, options);
  };
  EXPECT_FALSE(endedAt(0).isMore);
  const Extension extension = endedAt(0.1);
  EXPECT_TRUE(extension.isMore);
  const StochasticResult& stochastic = extension.results.stochastic;
  EXPECT_LT(stochastic.integrated, stochastic.planned());
  EXPECT_EQ(stochastic.stopped, "the run was interrupted");
  EXPECT_EQ(extension.results.comparison.verdict, Agreement::incomplete);
  // To the end, by as many samples as were planned.
  const Results whole = extended(stored(extension.results), samples(65536)).results;
  EXPECT_EQ(whole.stochastic.integrated, whole.stochastic.planned());
  EXPECT_EQ(whole.comparison.verdict, Agreement::inside);
}

TEST(Extension, ComparesAsFarAsAnEnclosureCame) {
  Study hard = readStudyText(study, "s.toml");
  hard.flow.split = false;
  hard.flow.maxWidth = 0.45;
  const Results before = stored(run(hard, samples(64)));
  ASSERT_LT(before.interval.reached, 0.5);
  const Results after = stored(extended(before, samples(256)).results);
  EXPECT_EQ(after.comparison.verdict, Agreement::incomplete);
  EXPECT_EQ(after.stochastic.reached, 0.5);
  EXPECT_EQ(after.interval.reached, before.interval.reached);
}

TEST(Extension, KnowsCornersByTheirNewNumbers) {
  Results before = runOf(study, samples(64));
  ASSERT_EQ(before.requirements.size(), 3U);
  before.requirements[0].violationSample = 63;
  before.requirements[1].violationSample = 65;
  const Results after = extended(before, samples(256)).results;
  EXPECT_EQ(after.requirements[0].violationSample, 63);
  EXPECT_EQ(after.requirements[1].violationSample, 257);
}

/// What nobody proved of a requirement may be refuted by a new sample, and is proved of it.
TEST(Extension, ProvesWhatANewSampleViolates) {
  Results before = runOf(study, samples(64));
  RequirementResult& slow = before.requirements[1];
  ASSERT_EQ(slow.word, Decision::partly);
  slow.word = Decision::open;
  slow.why = "the enclosure is not tight enough to tell";
  slow.violation = {RequirementResult::unknown};
  const RequirementResult& after = extended(before, samples(256)).results.requirements[1];
  EXPECT_EQ(after.word, Decision::partly);
  EXPECT_EQ(after.why, "");
  EXPECT_EQ(after.violationSample, after.worstSample);
  EXPECT_FALSE(std::isnan(after.violation[0]));
}

}  // namespace
}  // namespace gamut
