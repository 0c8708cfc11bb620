// How much is computed is counted, not timed: results are the same however many threads there are and however busy the
// machine is, also where the work that answers may do ends them.
#include "analyses/work.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "studies/results/results_file.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::IsEmpty;

/// Two links; angles, lengths and a mass are uncertain.
std::string pendulums(const std::string& limits) {
  std::string text = R"([study]
title = "Two links"
analysis = "dynamics"
horizon = 0.6
output_step = 0.05
compare = ["interval", "stochastic", "fuzzy"]
[limits]
)" + limits + R"(
[mechanism]
gravity = [0, 0, -9.81]
)";
  const std::vector<std::string> names{"upper", "lower"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    text += "[[mechanism.element]]\ntype = \"revolute\"\nname = \"" + name + "_joint\"\nfrom = \"" +
            (i == 0 ? "inertial" : names[i - 1] + "_end") + "\"\nto = \"" + name +
            "_frame\"\naxis = \"x\"\ninitial = { angle = \"60 deg\", rate = 0 }\n" +
            "[[mechanism.element]]\ntype = \"link\"\nname = \"" + name + "\"\nfrom = \"" + name + "_frame\"\nto = \"" +
            name + "_end\"\nvector = [0, 0, \"-" + name + ".length\"]\nparameters = { length = 0.3 }\n" +
            "[[mechanism.element]]\ntype = \"mass\"\nname = \"" + name + "_bob\"\nat = \"" + name +
            "_end\"\nmass = \"300 g\"\n";
  }
  for (const char* quantity : {"upper_joint.angle", "lower_joint.angle", "upper.length", "lower_bob.mass"})
    text += std::string("[[uncertain]]\nquantity = \"") + quantity +
            "\"\ninterval = \"± 2 %\"\ndistribution = { type = \"uniform\" }\nmembership = { type = \"triangular\" }\n";
  return text + R"([[output]]
quantity = "lower_joint.angle"
[[output]]
quantity = "lower_end.position.z"
[[requirement]]
always = "lower_end.position.y < 0.4352"
[interval]
tightness = 1.1
[distribution]
gap = 0.001
times = 3
[stochastic]
samples = 128
)";
}

Results runOf(const std::string& text, int jobs) {
  RunOptions options;
  options.jobs = jobs;
  const TemporaryFolder folder;
  writeResults(run(readStudyText(text, "s.toml"), options), folder.path("r.h5"));
  return readResults(folder.path("r.h5"));
}

/// Paths of all that was stored and differs, but times and memory.
std::vector<std::string> differing(const Results& one, const Results& other) {
  std::vector<std::string> paths = differences(one, other);
  std::erase_if(paths, [](const std::string& path) {
    return path.ends_with("/cpu") || path == "/study/date" || path == "/study/memory";
  });
  return paths;
}

TEST(CountedWork, MakesResultsTheSameOnAnyNumberOfThreadsUnderAnyLoad) {
  for (const char* limits : {"", "cuts = 0.01\nrequirements = 0.04\nprobabilities = 0.06"}) {
    SCOPED_TRACE(limits);
    const std::string text = pendulums(limits);
    const Results one = runOf(text, 1);
    EXPECT_THAT(differing(one, runOf(text, 3)), IsEmpty());
    std::jthread busy([](const std::stop_token& token) {  // the process's clock of CPU time goes twice as fast
      while (!token.stop_requested()) {
      }
    });
    EXPECT_THAT(differing(one, runOf(text, 2)), IsEmpty());
  }
}

/// With so little work that it ends what is computed.
TEST(CountedWork, MakesShippedStudiesTheSameOnAnyNumberOfThreads) {
  for (const char* name : {"tumbling_body", "spring_pendulum", "drive_train"}) {
    SCOPED_TRACE(name);
    Study study = readStudy(std::string(GAMUT_SOURCE_DIR "/studies/examples/") + name + "/study.toml");
    study.shares = {0.05, 0.05, 0.1};
    study.ensemble.samples = 64;
    const auto resultsOn = [&](int jobs) {
      RunOptions options;
      options.jobs = jobs;
      const TemporaryFolder folder;
      writeResults(run(study, options), folder.path("r.h5"));
      return readResults(folder.path("r.h5"));
    };
    EXPECT_THAT(differing(resultsOn(1), resultsOn(3)), IsEmpty());
  }
}

TEST(CountedWork, IsStatedInTimesOfEnclosureAndSamples) {
  const Shares shares =
      readStudyText(pendulums("cuts = 0.25\nrequirements = 3\nprobabilities = 0\nderivatives = 7"), "s.toml").shares;
  EXPECT_EQ(shares.cuts, 0.25);
  EXPECT_EQ(shares.requirements, 3);
  EXPECT_EQ(shares.probabilities, 0);
  EXPECT_EQ(shares.derivatives, 7);
  const Shares usual = readStudyText(pendulums(""), "s.toml").shares;
  EXPECT_EQ(usual.cuts + usual.requirements + usual.probabilities, 2);
  EXPECT_THROW(readStudyText(pendulums("cuts = -1"), "s.toml"), StudyError);
}

TEST(CountedWork, IsNoMoreThanItsShare) {
  const auto workOf = [](const std::string& limits) {
    const std::uint64_t began = Work::counted();
    runOf(pendulums(limits), 2);
    return static_cast<double>(Work::counted() - began) / Work::perSecond;
  };
  const double none = workOf("cuts = 0\nrequirements = 0\nprobabilities = 0");
  const double little = workOf("cuts = 0.01\nrequirements = 0.04\nprobabilities = 0.06");
  const double more = workOf("cuts = 0.02\nrequirements = 0.1\nprobabilities = 0.12");
  constexpr double least = 2.5, beside = 0.1;  // what single violations take is apart
  EXPECT_LT(little, none + 0.11 * std::max(none, least) * 1.2 + beside);
  EXPECT_LT(more, none + 0.24 * std::max(none, least) * 1.2 + beside);
  EXPECT_GT(more, little);
}

TEST(CountedWork, WinsCloserBoundsWhereThereIsMore) {
  const Results little = runOf(pendulums("requirements = 0.01\nprobabilities = 0.02"), 2);
  const Results more = runOf(pendulums("requirements = 0.5\nprobabilities = 0.5"), 2);
  EXPECT_LT(more.distribution.gap, little.distribution.gap);
  EXPECT_LE(more.requirements[0].probabilityUpper - more.requirements[0].probabilityLower,
            little.requirements[0].probabilityUpper - little.requirements[0].probabilityLower);
}

}  // namespace
}  // namespace gamut
