// Where the proof ends before the study does: what is estimated there.
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "analyses/samples/binomial.hpp"
#include "studies/results/instants.hpp"
#include "studies/running/extension.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/studies/far_pendulum.hpp"

namespace gamut {
namespace {

Results found(const std::string& text) { return run(readStudyText(text, "s.toml")); }

TEST(BehindTheProof, RequirementsAreEstimatedByIndependentSamples) {
  const Results results = found(farPendulum("± 15 %", "[limits]\nadvice = 0\n"));
  ASSERT_LT(results.interval.reached, 2.7);
  EXPECT_EQ(endOfProof(results), results.interval.reached);
  const RequirementResult &late = results.requirements[0], &surely = results.requirements[1];
  for (const RequirementResult* each : {&late, &surely}) {
    EXPECT_EQ(each->estimate.samples, 512);
    EXPECT_EQ(each->estimate.met + each->estimate.violated, 512);
    EXPECT_EQ(each->estimate.lower, confidenceOfShare(each->estimate.met, 512).lower());
    EXPECT_EQ(each->estimate.upper, confidenceOfShare(each->estimate.met, 512).upper());
    // The plan's own samples, which are more evenly spread, say the same.
    EXPECT_GE(1 - static_cast<double>(each->violating) / 512, each->estimate.lower);
    EXPECT_LE(1 - static_cast<double>(each->violating) / 512, each->estimate.upper);
    EXPECT_TRUE(std::isnan(each->shareLower));
  }
  EXPECT_EQ(late.word, Decision::partly);  // a flow of one sample's values proves as much
  EXPECT_EQ(surely.word, Decision::open);
  EXPECT_GT(late.estimate.violated, 0);
  EXPECT_GT(late.estimate.met, 0);
  EXPECT_NEAR(late.estimate.firstOrder, 1 - static_cast<double>(late.violating) / 512, 0.15);
  EXPECT_EQ(surely.estimate.met, 512);
  EXPECT_GT(surely.estimate.firstOrder, 0.9);
  EXPECT_GE(surely.metUntil, 1.5);
  const RequirementEstimate& early = results.requirements[2].estimate;  // which is proved
  EXPECT_EQ(early.samples, 0);
  EXPECT_TRUE(std::isnan(early.lower) && std::isnan(early.firstOrder));
}

TEST(BehindTheProof, IndependentSamplesOfThePlanAreThose) {
  const Results results = found(farPendulum("± 15 %", "[limits]\nadvice = 0\n", "random"));
  const RequirementResult& late = results.requirements[0];
  EXPECT_EQ(late.estimate.samples, 512);
  EXPECT_EQ(late.estimate.violated, late.violating);
  EXPECT_EQ(late.estimate.lower, late.shareLower);
  EXPECT_EQ(late.estimate.upper, late.shareUpper);
}

TEST(BehindTheProof, NothingIsEstimatedOfWhatHasNoOneDistribution) {
  std::string text = farPendulum("± 15 %", "[limits]\nadvice = 0\n");
  const std::string uniform = "distribution = { type = \"uniform\" }";
  text.replace(text.find(uniform), uniform.size(), "distribution = { type = \"normal\", deviation = [0.05, 0.1] }");
  const Results results = found(text);
  ASSERT_TRUE(endOfProof(results));
  EXPECT_EQ(results.requirements[0].estimate.samples, 0);
}

TEST(BehindTheProof, NothingIsEstimatedWhereTheProofComesToTheEnd) {
  const Results results = found(farPendulum("± 0.1 %"));
  ASSERT_FALSE(endOfProof(results)) << results.interval.why;
  for (const RequirementResult& requirement : results.requirements) EXPECT_EQ(requirement.estimate.samples, 0);
  EXPECT_EQ(results.interval.advice, "");
}

TEST(BehindTheProof, MoreSamplesEstimateAnew) {
  const Study study = readStudyText(farPendulum("± 15 %", "[limits]\nadvice = 0\n"), "s.toml");
  RunOptions options;
  options.samples = 256;
  const Results few = run(study, options);
  EXPECT_EQ(few.requirements[0].estimate.samples, 256);
  options.samples = 512;
  const Results more = extend(Machine(study), few, options).results;
  const RequirementEstimate all = run(study, options).requirements[0].estimate,
                            extended = more.requirements[0].estimate;
  EXPECT_EQ(extended.samples, 512);
  EXPECT_EQ(extended.met, all.met);
  EXPECT_EQ(extended.firstOrder, all.firstOrder);
}

TEST(BehindTheProof, EstimatesDependOnNoThreads) {
  const Study study = readStudyText(farPendulum("± 15 %", "[limits]\nadvice = 0\n"), "s.toml");
  RunOptions options;
  options.jobs = 3;
  const RequirementEstimate three = run(study, options).requirements[0].estimate,
                            one = run(study, {}).requirements[0].estimate;
  EXPECT_EQ(three.met, one.met);
  EXPECT_EQ(three.firstOrder, one.firstOrder);
}

}  // namespace
}  // namespace gamut
