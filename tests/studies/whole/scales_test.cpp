// What is great and what is small: outputs beside their own size over the whole motion.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "studies/running/run.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;

Study withOutputs(const std::string& text) {
  return readStudyText(sampleStudyWith("[stochastic]", text + "\n[stochastic]"), "s.toml");
}

std::string complaintAboutScale(const std::string& keys) {
  try {
    withOutputs("[[output]]\nname = \"own\"\nquantity = \"tip.position.y\"\nunit = \"mm\"\n" + keys + "\n");
  } catch (const StudyError& error) {
    return error.what();
  }
  return "";
}

TEST(Scales, AreStatedInAnyUnitOfTheOutput) {
  const Study study = withOutputs(R"([[output]]
name = "own"
quantity = "tip.position.y"
unit = "mm"
resolution = "20 um"
tightness = 1.3
[[output]]
name = "plain"
quantity = "hinge.rate"
resolution = 0.5
)");
  EXPECT_NEAR(study.outputs[2].resolution, 0.02, 1e-16);
  EXPECT_EQ(study.outputs[2].tightness, 1.3);
  EXPECT_EQ(study.outputs[3].resolution, 0.5);
  EXPECT_TRUE(std::isnan(study.outputs[3].tightness));
}

TEST(Scales, ThatMakeNoSenseAreRefused) {
  EXPECT_THAT(complaintAboutScale("resolution = \"1 kg\""), HasSubstr("output.resolution"));
  EXPECT_THAT(complaintAboutScale("resolution = -1"), HasSubstr("not negative"));
  EXPECT_THAT(complaintAboutScale("tightness = 1"), HasSubstr("above 1"));
  EXPECT_THAT(complaintAboutScale("tightness = \"2 m\""), HasSubstr("output.tightness"));
  EXPECT_EQ(complaintAboutScale("resolution = 0\ntightness = 1.001"), "");
}

/// sin² + cos² is one but for rounding, and 1 - that nothing at all.
TEST(Scales, OfWhatIsZeroOrConstantButForRoundingAreNotCompared) {
  const Study study = withOutputs(R"([[output]]
name = "nothing"
quantity = "sin(hinge.angle)*sin(hinge.angle) + cos(hinge.angle)*cos(hinge.angle) - 1"
[[output]]
name = "constant"
quantity = "3*sin(hinge.angle)*sin(hinge.angle) + 3*cos(hinge.angle)*cos(hinge.angle) + 1"
)");
  const Results results = run(study, {});
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_TRUE(std::isfinite(results.comparison.maximumOf[0]));
  EXPECT_TRUE(std::isnan(results.comparison.maximumOf[2])) << results.comparison.maximumOf[2];
  EXPECT_TRUE(std::isnan(results.comparison.maximumOf[3])) << results.comparison.maximumOf[3];
  EXPECT_LT(results.comparison.maximum, 1.1);
  EXPECT_EQ(results.interval.shortfall, "");
  EXPECT_LT(results.distribution.gap, 0.1);
  for (std::size_t i = 0; i < results.fuzzy.transformation.gap.data.size(); ++i)
    EXPECT_EQ(std::isnan(results.fuzzy.transformation.gap.data[i]) || i % 4 < 2, true) << i;
}

TEST(Scales, ThatAreStatedLeaveOutWhatIsBelow) {
  const std::string output = "[[output]]\nname = \"own\"\nquantity = \"tip.position.y\"\n";
  const Results all = run(withOutputs(output), {}), coarse = run(withOutputs(output + "resolution = \"1 m\"\n"), {});
  EXPECT_TRUE(std::isfinite(all.comparison.maximumOf[2]));
  EXPECT_TRUE(std::isnan(coarse.comparison.maximumOf[2]));
  EXPECT_EQ(coarse.outputs[2].resolution, 1);
}

}  // namespace
}  // namespace gamut
