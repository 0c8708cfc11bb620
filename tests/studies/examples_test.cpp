// Every study in studies/examples, run as it is with fewer samples: to its horizon, tight, its samples inside.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "studies/running/run.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace {

const std::filesystem::path examples = GAMUT_SOURCE_DIR "/studies/examples";

std::vector<std::string> exampleNames() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(examples))
    if (entry.is_directory()) names.push_back(entry.path().filename());
  std::ranges::sort(names);
  return names;
}

class Examples : public ::testing::TestWithParam<std::string> {
 protected:
  std::string file() const { return (examples / GetParam() / "study.toml").string(); }
};

TEST_P(Examples, ArriveTightlyWithAllSamplesInside) {
  const Study study = readStudy(file());
  EXPECT_THAT(study.notes, ::testing::IsEmpty());
  EXPECT_NE(study.title, GetParam());
  RunOptions options;
  options.jobs = 2;
  options.samples = 64;
  const Results results = run(study, options);
  EXPECT_EQ(results.comparison.verdict, "inside");
  EXPECT_EQ(results.interval.shortfall, "");
  EXPECT_FALSE(results.uncertain.empty());
  // Corners and samples span hardly less than all motions do.
  constexpr double unspanned = 0.03;
  EXPECT_LE(results.comparison.maximum, study.flow.tightness + unspanned);
  if (study.analysisName() == "kinematics") return;
  EXPECT_EQ(results.interval.reached, results.horizon) << results.interval.why;
  EXPECT_EQ(results.stochastic.reached, results.horizon) << results.stochastic.why;
  EXPECT_EQ(results.fuzzy.reached, results.horizon) << results.fuzzy.why;
}

TEST_P(Examples, SayFirstWhatTheyTeach) {
  std::ifstream in(file());
  std::string line;
  ASSERT_TRUE(std::getline(in, line));
  EXPECT_EQ(line.substr(0, 2), "# ");
}

/// By name: `| [name](studies/examples/name) | ...`.
TEST_P(Examples, StandInTheReadme) {
  std::ifstream in(GAMUT_SOURCE_DIR "/README.md");
  const std::string readme(std::istreambuf_iterator<char>(in), {});
  EXPECT_THAT(readme, ::testing::HasSubstr("(studies/examples/" + GetParam() + ")"));
}

INSTANTIATE_TEST_SUITE_P(Study, Examples, ::testing::ValuesIn(exampleNames()),
                         [](const auto& example) { return example.param; });

}  // namespace
}  // namespace gamut
