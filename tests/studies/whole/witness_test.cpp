// Samples followed once more in balance: machines of many kinds, what is refused, and what is said.
#include "studies/analyses/witness.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <utility>

#include "studies/machine.hpp"
#include "studies/results/verdict.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut::witness {
namespace {

using ::testing::HasSubstr;

std::string shipped(const std::string& name) {
  return readStudy(std::string(GAMUT_SOURCE_DIR "/studies/examples/") + name + "/study.toml").text;
}

/// A shipped study with few samples and no enclosure, three motions followed once more.
Results followed(const std::string& name) {
  std::string text = shipped(name);
  text = text.substr(0, text.find("\n[witness]")) + "\n[witness]\nsamples = 3\n";
  const std::size_t compare = text.find("\ncompare = ");
  text.replace(compare, text.find('\n', compare + 1) - compare, "\ncompare = [\"stochastic\"]");
  RunOptions options;
  options.samples = 8;
  return run(Machine(readStudyText(text, name + ".toml")), options);
}

class FollowedMachines : public ::testing::TestWithParam<const char*> {};

TEST_P(FollowedMachines, MoveAlikeInBalance) {
  const Results results = followed(GetParam());
  const WitnessResult& found = results.of<WitnessResult>();
  EXPECT_EQ(found.why, "");
  ASSERT_EQ(found.number.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < found.size.size(); ++i) {
      EXPECT_TRUE(found.agrees(k, i)) << results.outputs[i].name;
      EXPECT_LT(found.error(k, i), 1e-5 * found.size[i]) << results.outputs[i].name;  // else it says little
    }
}

INSTANTIATE_TEST_SUITE_P(Of, FollowedMachines,
                         ::testing::Values("double_pendulum", "four_bar", "slider_crank", "spatial_rocker",
                                           "stewart_released", "stewart_driven", "cart_and_pole", "electric_oscillator",
                                           "drive_train"),
                         [](const auto& test) { return std::string(test.param); });

TEST(Witness, IsAskedForWhereItCanBe) {
  EXPECT_THAT(messageOf(sampleStudyWith("\"stochastic\", ", "") + "[witness]\nsamples = 2\n"),
              HasSubstr("there are no samples to follow; expected \"stochastic\" in study.compare"));
  EXPECT_THAT(messageOf(sampleStudyWith("\"dynamics\"\nhorizon = 0.5\noutput_step = 0.1", "\"kinematics\"") +
                        "[witness]\nsamples = 2\n"),
              HasSubstr("nothing is integrated that a witness could follow"));
  EXPECT_THAT(messageOf(shipped("spinning_top") + "\n[witness]\nsamples = 2\n"),
              HasSubstr("is no angle or displacement of a joint, which no witness follows; expected hinges and"));
  EXPECT_EQ(messageOf(sampleStudy + "[witness]\nsamples = 2\n"), "it was read");
  EXPECT_THAT(messageOf(sampleStudy + "[witness]\nsamples = 2000\n"), HasSubstr("witness.samples"));
}

TEST(Witness, SaysThatItFollowsNoJumps) {
  const Results results = followed("robot_joint_friction");
  EXPECT_THAT(results.of<WitnessResult>().why, HasSubstr("something jumps, as dry friction does"));
  EXPECT_EQ(findVerdict(results).gap, Finding::Gap::noAnswers);
}

TEST(Witness, SeesWhatErrorsDoNotExplain) {
  Results results = run(Machine(readStudyText(sampleStudy + "[witness]\nsamples = 2\n", "s.toml")), {});
  EXPECT_EQ(findVerdict(results).word, Agreement::inside);
  WitnessResult& found = results.of<WitnessResult>();
  ASSERT_EQ(found.number.size(), 2U);
  EXPECT_EQ(found.number[1], results.stochastic.centre());
  EXPECT_TRUE(found.agrees(1, 0));
  EXPECT_GT(found.apart(1, 0), 0);
  found.apart(1, 0) = 1e-3;
  EXPECT_FALSE(found.agrees(1, 0));
  EXPECT_THAT(found.told().front(), HasSubstr("2 samples, followed by forces and multipliers in balance"));
}

/// Found from the numbers, whatever else is said.
TEST(Witness, LeavesTheVerdictIncompleteWhereErrorsDoNotExplainADifference) {
  Results results = run(Machine(readStudyText(sampleStudy + "[witness]\nsamples = 2\n", "s.toml")), {});
  WitnessResult& found = results.of<WitnessResult>();
  found.why = "sample 0 ends early";
  EXPECT_EQ(findVerdict(results).word, Agreement::inside);
  for (const double apart : {2 * found.error(0, 0) + 1e-9 * found.size[0], std::nan("")}) {
    found.apart(0, 0) = apart;
    EXPECT_EQ(found.unexplained(), (std::pair<std::size_t, std::size_t>{0, 0}));
    const Finding finding = findVerdict(results);
    EXPECT_EQ(finding.word, Agreement::incomplete);
    EXPECT_EQ(finding.gap, Finding::Gap::further);
    EXPECT_EQ(whyIncomplete(results, finding), found.why);
  }
}

}  // namespace
}  // namespace gamut::witness
