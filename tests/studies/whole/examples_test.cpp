// Every study in studies/examples, run as it is with fewer samples: to its horizon, tight, its samples inside.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
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

/// Every bound holds those of higher levels, and the proved cut that of the samples: without any tolerance.
void expectNestedCuts(const FuzzyResult& fuzzy) {
  ASSERT_EQ(fuzzy.outer.size(), fuzzy.alpha.size());
  ASSERT_EQ(fuzzy.inner.size(), fuzzy.alpha.size());
  const auto escapes = [](const Envelope& within, const Envelope& wider) {
    int count = 0;
    for (std::size_t i = 0; i < within.lower.data.size(); ++i)
      count += within.lower.data[i] < wider.lower.data[i] || within.upper.data[i] > wider.upper.data[i] ? 1 : 0;
    return count;
  };
  for (std::size_t level = 0; level < fuzzy.alpha.size(); ++level) {
    EXPECT_EQ(escapes(fuzzy.inner[level], fuzzy.outer[level]), 0) << fuzzy.alpha[level];
    if (level == 0) continue;
    EXPECT_EQ(escapes(fuzzy.outer[level], fuzzy.outer[level - 1]), 0) << fuzzy.alpha[level];
    EXPECT_EQ(escapes(fuzzy.inner[level], fuzzy.inner[level - 1]), 0) << fuzzy.alpha[level];
  }
}

/// Of all outputs at all levels and times.
double greatestGap(const FuzzyResult& fuzzy) {
  double greatest = -1;
  for (const double gap : fuzzy.transformation.gap.data) greatest = std::fmax(greatest, gap);
  EXPECT_GE(greatest, 0);
  return greatest;
}

class Examples : public ::testing::TestWithParam<std::string> {
 protected:
  std::string file() const { return (examples / GetParam() / "study.toml").string(); }
};

TEST_P(Examples, ArriveTightlyWithAllSamplesInside) {
  Study study = readStudy(file());
  study.shares.requirements = study.shares.probabilities = 0.05;  // what they find is not looked at
  EXPECT_THAT(study.notes, ::testing::Each(::testing::HasSubstr(" is assumed, not proved")));
  EXPECT_NE(study.title, GetParam());
  RunOptions options;
  options.jobs = 2;
  options.samples = 64;
  const Results results = run(study, options);
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_EQ(results.interval.shortfall, "");
  EXPECT_FALSE(results.uncertain.empty());
  expectNestedCuts(results.fuzzy);
  // Corners and samples span hardly less than all motions do, but for those of what varies in time, of which the worst
  // courses are sampled for some output times alone: such a study is held against all, in shipped_studies_test.cpp.
  if (std::ranges::none_of(study.uncertain, &UncertainQuantity::varies)) {
    constexpr double unspanned = 0.03;
    EXPECT_LE(results.comparison.maximum, study.flow.tightness + unspanned);
  }
  const bool hasCuts = !results.fuzzy.alpha.empty();
  if (hasCuts) {
    EXPECT_LE(greatestGap(results.fuzzy), 0.05);
  }
  if (study.analysisName() == "kinematics") return;
  EXPECT_EQ(results.interval.reached, results.horizon) << results.interval.why;
  EXPECT_EQ(results.stochastic.reached, results.horizon) << results.stochastic.why;
  if (hasCuts) {
    EXPECT_EQ(results.fuzzy.reached, results.horizon) << results.fuzzy.why;
  }
}

/// Of the smallest ones.
TEST(AlphaCuts, AreNestedByAllMethods) {
  for (const std::string name : {"tip_position", "simple_pendulum", "electric_oscillator"}) {
    double gap = 1;
    for (const Transformation method : {Transformation::reduced, Transformation::extended, Transformation::general}) {
      SCOPED_TRACE(name + " " + std::string(nameOf(method)));
      Study study = readStudy((examples / name / "study.toml").string());
      if (method == Transformation::general && study.uncertain.size() > 4) continue;
      study.ensemble.transformation = method;
      study.distribution.count = 0;
      study.requirements.clear();
      RunOptions options;
      options.jobs = 2;
      options.samples = 64;
      const Results results = run(study, options);
      EXPECT_EQ(results.comparison.verdict, Agreement::inside);
      EXPECT_EQ(results.fuzzy.transformation.method, nameOf(method));
      expectNestedCuts(results.fuzzy);
      const double greatest = greatestGap(results.fuzzy);
      EXPECT_LE(greatest, gap + 1e-9) << "than with fewer points";
      gap = greatest;
    }
  }
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
