// gamut replay from outside: the table, what it is called by, and what is refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "studies/results/results_file.hpp"
#include "tests/commands/program.hpp"
#include "tests/studies/sample_results.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ReplayCommand : public FromOutside {
 protected:
  ReplayCommand() { folder_.write("s.toml", sampleStudy); }

  Results run(const std::string& options = "") const {
    EXPECT_EQ(gamut("run s.toml --quiet --force " + options).exitCode, 0);
    return readResults(folder_.path("s.h5"));
  }

  /// The numbers below the head.
  static std::vector<std::vector<double>> numbersOf(const std::string& table) {
    std::vector<std::vector<double>> rows;
    std::istringstream lines(table);
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line);) {
      rows.emplace_back();
      std::istringstream cells(line);
      for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::strtod(cell.c_str(), nullptr));
    }
    return rows;
  }
};

TEST_F(ReplayCommand, PrintsATableWithNamesUnitsAndTheSamplesOwnValues) {
  const Results results = run();
  const Outcome replay = gamut("replay s.h5 3");
  ASSERT_EQ(replay.exitCode, 0) << replay.error;
  EXPECT_THAT(replay.out, StartsWith("time (s),angle (rad),tip.position.z (m),uncertain start (deg)\n0,"));
  const auto rows = numbersOf(replay.out);
  ASSERT_EQ(rows.size(), results.time.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 4U);
    EXPECT_EQ(rows[i][0], results.time[i]);
    EXPECT_NEAR(rows[i][3], rows[0][1] * 180 / std::numbers::pi, 1e-12);  // as the angle at the start is stated
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_LE(results.stochastic.envelope.lower(i, j), rows[i][j + 1]);
      EXPECT_GE(results.stochastic.envelope.upper(i, j), rows[i][j + 1]);
    }
  }
}

/// One sample, so that the run's mean is that sample.
TEST_F(ReplayCommand, PrintsEveryBitOfWhatTheRunHad) {
  const Results results = run("--samples 1 --seed 99");
  const auto rows = numbersOf(gamut("replay s.h5 0").out);
  ASSERT_EQ(rows.size(), results.time.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < 2; ++j) EXPECT_EQ(rows[i][j + 1], results.stochastic.mean(i, j)) << i << ' ' << j;
}

TEST_F(ReplayCommand, KnowsCornersAndTheCentreByName) {
  const Results results = run();
  const std::int64_t corners = results.stochastic.samples, alphaCorners = corners + results.stochastic.corners,
                     centre = results.stochastic.centre();
  const auto byNumber = [&](std::int64_t number) { return gamut("replay s.h5 " + std::to_string(number)).out; };
  EXPECT_EQ(gamut("replay s.h5 corner 1").out, byNumber(corners + 1));
  EXPECT_EQ(gamut("replay s.h5 'corner 1'").out, byNumber(corners + 1));
  EXPECT_EQ(gamut("replay s.h5 alpha-corner 4").out, byNumber(alphaCorners + 4));
  EXPECT_EQ(gamut("replay s.h5 centre").out, byNumber(centre));
  EXPECT_EQ(results.stochastic.alphaPoints, 11);  // that looked for turns
  EXPECT_EQ(gamut("replay s.h5 alpha-point 10").out, byNumber(centre + 11));
  EXPECT_EQ(gamut("replay s.h5 point 10 of the alpha-cuts").out, byNumber(centre + 11));
  for (const std::int64_t number : {std::int64_t{5}, corners + 1, alphaCorners + 4, centre, centre + 11})
    EXPECT_EQ(gamut("replay s.h5 " + results.stochastic.nameOf(number)).out, byNumber(number)) << number;
  EXPECT_NE(byNumber(centre + 11), byNumber(centre + 10));
  EXPECT_NE(byNumber(corners), byNumber(corners + 1));
}

TEST_F(ReplayCommand, WritesAFileWholeAndOverwritesOnlyWhenForced) {
  run();
  const std::string table = gamut("replay s.h5 5").out;
  const Outcome written = gamut("replay s.h5 5 -o 'one of them.csv'");
  EXPECT_EQ(written.exitCode, 0);
  EXPECT_EQ(written.out, "");
  EXPECT_EQ(folder_.read("one of them.csv"), table);
  EXPECT_EQ(gamut("replay s.h5 6 -o 'one of them.csv'").exitCode, 2);
  EXPECT_EQ(folder_.read("one of them.csv"), table);
  EXPECT_EQ(gamut("replay s.h5 6 -o 'one of them.csv' --force").exitCode, 0);
  EXPECT_NE(folder_.read("one of them.csv"), table);
  EXPECT_EQ(gamut("replay s.h5 5 -o -").out, table);
  EXPECT_EQ(gamut("replay s.h5 5 -o s.h5 --force").error, "gamut: s.h5: cannot be written; it is the input\n");
}

TEST_F(ReplayCommand, QuotesNamesThatHoldCommas) {
  folder_.write("s.toml", sampleStudyWith("name = \"angle\"", "name = 'the \"first\", angle'"));
  run();
  EXPECT_THAT(gamut("replay s.h5 0").out,
              StartsWith("time (s),\"the \"\"first\"\", angle (rad)\",tip.position.z (m),"));
}

TEST_F(ReplayCommand, RefusesInOneLineWhatIsNoSample) {
  run();
  constexpr const char* expected =
      "; expected 0 to 47, corner 0 to 1, alpha-corner 0 to 17, alpha-point 0 to 10, or centre\n";
  for (const char* sample : {"48", "-1", "1.5", "corner", "corner 2", "corner -1", "alpha-corner 18", "center", "1 2",
                             "99999999999999999999", "'corner  1'", "''"}) {
    SCOPED_TRACE(sample);
    const Outcome replay = gamut("replay s.h5 " + std::string(sample));
    EXPECT_EQ(replay.exitCode, 2);
    EXPECT_EQ(replay.out, "");
    EXPECT_THAT(replay.error, StartsWith("gamut: s.h5: no sample is '"));
    EXPECT_THAT(replay.error, EndsWith(expected));
  }
  EXPECT_EQ(gamut("replay s.h5").error, "gamut: SAMPLE is missing; see gamut replay --help\n");
}

/// Of what varies in time a course that violates it, not the nominal one that does not.
TEST_F(ReplayCommand, PrintsOnlyMotionsThatViolate) {
  folder_.write("s.toml", R"([study]
analysis = "dynamics"
horizon = 4
output_step = 0.5
compare = ["interval", "stochastic"]
[mechanism.parameters]
u = 0
[[mechanism.element]]
type = "state"
name = "x"
initial = 0
rate = "u - x"
[[uncertain]]
quantity = "u"
interval = [-1, 1]
varies = "freely"
[[output]]
quantity = "x"
[[requirement]]
name = "small"
always = "x < 0.5"
[[requirement]]
name = "held"
always = "x < 1.5"
[stochastic]
samples = 16
[distribution]
times = 0
)");
  run();
  const Outcome small = gamut("replay s.h5 violation small");
  ASSERT_EQ(small.exitCode, 0) << small.error;
  double greatest = 0;
  for (const std::vector<double>& row : numbersOf(small.out)) greatest = std::max(greatest, row[1]);
  EXPECT_GT(greatest, 0.5);
  const Outcome held = gamut("replay s.h5 violation held");
  EXPECT_EQ(held.exitCode, 2);
  EXPECT_EQ(held.out, "");
  EXPECT_EQ(held.error, "gamut: s.h5: no motion violates 'held': it is met for every value\n");
}

TEST_F(ReplayCommand, RefusesResultsWithoutSamples) {
  folder_.write("s.toml", sampleStudyWith(R"(["interval", "stochastic", "fuzzy"])", R"(["interval"])"));
  run();
  const Outcome replay = gamut("replay s.h5 0");
  EXPECT_EQ(replay.exitCode, 2);
  EXPECT_EQ(replay.error, "gamut: s.h5: holds no samples; expected results of a study that compares \"stochastic\"\n");
}

TEST_F(ReplayCommand, NamesTheStudyInTheResultsThatItCannotRead) {
  writeResults(sampleResults(), folder_.path("r.h5"));
  const Outcome replay = gamut("replay r.h5 0");
  EXPECT_EQ(replay.exitCode, 2);
  EXPECT_THAT(replay.error, StartsWith("sample.toml in r.h5:1:1: "));
}

TEST_F(ReplayCommand, SaysWhereASampleEndedBeforeTheHorizon) {
  // A spring of growing pull lets the slider fall for ever faster.
  folder_.write("s.toml", R"([study]
analysis = "dynamics"
horizon = 100.0
output_step = 1.0
compare = ["stochastic"]
[mechanism]
[[mechanism.element]]
type = "prismatic"
name = "slide"
from = "inertial"
to = "K1"
axis = "x"
initial = { displacement = 1 }
[[mechanism.element]]
type = "mass"
name = "block"
at = "K1"
mass = 1
[[mechanism.element]]
type = "joint-spring"
name = "push"
joint = "slide"
stiffness = -100
rest = 0
[[uncertain]]
quantity = "slide.displacement"
interval = "± 1 %"
[[output]]
quantity = "slide.displacement"
[stochastic]
samples = 4
)");
  ASSERT_EQ(gamut("run s.toml --quiet").exitCode, 3);
  const Outcome replay = gamut("replay s.h5 1");
  EXPECT_EQ(replay.exitCode, 3);
  EXPECT_THAT(replay.error, HasSubstr("note: sample 1 ended at "));
  const auto rows = numbersOf(replay.out);
  EXPECT_GT(rows.size(), 10U);
  EXPECT_LT(rows.size(), 101U);
  for (const auto& row : rows) EXPECT_TRUE(std::isfinite(row[1]));
}

TEST_F(ReplayCommand, SaysThatTheTableDidNotArrive) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  run();
  const Outcome replay = gamut("replay s.h5 0 > /dev/full 2> .error; exit $?; true");
  EXPECT_EQ(replay.exitCode, 4);
  EXPECT_THAT(replay.error, StartsWith("gamut: standard output: cannot be written; "));
}

TEST_F(ReplayCommand, SaysThatASampleIsNotWhatTheRunHad) {
  Results results = run();
  results.stochastic.envelope.upper(3, 0) = results.stochastic.envelope.lower(3, 0);
  writeResults(results, folder_.path("s.h5"));
  EXPECT_THAT(gamut("replay s.h5 corner 1").error,
              HasSubstr("lies outside the envelope of the run, so it is not the same bit for bit"));
}

}  // namespace
}  // namespace gamut
