// Programs that are interrupted or killed at any moment: what was whole before stays whole, what is stored is never a
// false alarm, and nothing half is left. Runs that are interrupted have so many samples that none comes to its end.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "reports/verdict.hpp"
#include "studies/results/results_file.hpp"
#include "tests/commands/program.hpp"
#include "tests/commands/started_program.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using Words = std::vector<std::string>;

constexpr int kinds[] = {SIGINT, SIGTERM, SIGHUP};
constexpr double delays[] = {0, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3};  // s

class Signals : public FromOutside {
 protected:
  /// Whole results of a study that is done at once, and the same study with samples for hours.
  Signals() {
    folder_.write("s.toml", sampleStudy);
    EXPECT_EQ(gamut("run s.toml --quiet").exitCode, 0);
    results_ = folder_.read("s.h5");
    page_ = folder_.read("s.html");
    before_ = folder_.count();
  }

  void expectUntouched() const {
    EXPECT_TRUE(folder_.read("s.h5") == results_);
    EXPECT_TRUE(folder_.read("s.html") == page_);
  }

  void expectNoParts() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path("")))
      EXPECT_FALSE(entry.path().filename().string().ends_with(".gamut-part")) << entry.path();
  }

  /// Partial results that a reader can rely on.
  void expectPart(const std::string& name) const {
    const Results results = readResults(folder_.path(name));
    EXPECT_EQ(results.stopped, "the run was interrupted");
    EXPECT_EQ(judge(results).word, Agreement::incomplete);
    for (const DisputedSample& sample : results.comparison.disputed) EXPECT_FALSE(sample.outside);
    EXPECT_EQ(gamut("check " + name).exitCode, 3);
  }

  TemporaryFolder& folder() { return folder_; }

  const Words run_{"run", "s.toml", "--samples", "10000000", "--force", "--quiet", "--jobs", "2"},
      extend_{"extend", "s.h5", "--samples", "10000000", "--quiet", "--jobs", "2"};
  std::string results_, page_;
  std::size_t before_ = 0;
};

TEST_F(Signals, AnInterruptedRunLeavesWholeResultsAsTheyAre) {
  std::size_t number = 0;
  for (const double delay : delays) {
    SCOPED_TRACE(delay);
    StartedProgram run(folder_, run_);
    run.awaitWork();
    run.signalAfter(delay, kinds[number++ % 3]);
    EXPECT_EQ(run.wait(), 3);
    expectUntouched();
    expectNoParts();
    expectPart("s.partial.h5");
    EXPECT_THAT(folder_.read("s.partial.html"), ::testing::EndsWith("</html>\n"));
    EXPECT_EQ(folder_.count(), before_ + 2);
  }
}

TEST_F(Signals, AnInterruptedExtensionLeavesWholeResultsAsTheyAre) {
  for (const double delay : delays) {
    SCOPED_TRACE(delay);
    StartedProgram run(folder_, extend_);
    run.awaitWork();
    run.signalAfter(delay, SIGINT);
    EXPECT_EQ(run.wait(), 3);
    expectUntouched();
    expectNoParts();
    if (folder_.has("s.partial.h5")) expectPart("s.partial.h5");  // else not even the first samples came again
  }
}

TEST_F(Signals, InterruptedSamplesLeaveAnOlderTableAsItIs) {
  folder_.write("t.csv", "older");
  for (const int kind : kinds) {
    StartedProgram sample(folder_, {"sample", "s.h5", "--samples", "6000000", "-o", "t.csv", "--force"});
    sample.await([&] { return folder_.has(".t.csv.gamut-part"); });
    sample.signalAfter(0.01, kind);
    EXPECT_EQ(sample.wait(), 3);
    EXPECT_EQ(folder_.read("t.csv"), "older");
    expectNoParts();
  }
}

TEST_F(Signals, AnyCommandEndsWithItsExitCodeAndLeavesNoParts) {
  folder_.write("limited.toml", sampleStudyWith("[stochastic]",
                                                "[[requirement]]\nname = \"limit\"\nalways = \"angle < 31 deg\"\n"
                                                "[stochastic]"));
  for (const Words& words :
       {Words{"report", "s.h5", "-o", "r.html", "--force"}, Words{"check", "s.h5"}, Words{"info", "s.h5"},
        Words{"compare", "s.h5", "s.h5"}, Words{"replay", "s.h5", "3", "-o", "r.csv", "--force"},
        Words{"validate", "s.toml"}, Words{"quantities", "s.toml"}, Words{"new", "n", "--force"},
        Words{"tolerance", "limited.toml", "--quiet"}, Words{"run", "s.toml", "--force", "--quiet", "-o", "o.h5"},
        Words{"extend", "s.h5", "--samples", "64", "-o", "e.h5", "--force", "--quiet"}})
    for (const double delay : delays) {
      SCOPED_TRACE(words[0] + " after " + std::to_string(delay));
      StartedProgram program(folder_, words);
      program.awaitBegin();
      program.signalAfter(delay, SIGTERM);
      EXPECT_THAT(program.wait(), ::testing::AnyOf(0, words[0] == "tolerance" ? 1 : 0, 3));
      expectUntouched();
      expectNoParts();
    }
}

TEST_F(Signals, ASecondInterruptEndsAtOnceAndLeavesNoParts) {
  for (const double delay : delays) {
    SCOPED_TRACE(delay);
    StartedProgram run(folder_, run_);
    run.awaitWork();
    run.signalAfter(0, SIGINT);
    run.signalAfter(delay / 10, SIGINT);
    EXPECT_EQ(run.wait(), 3);
    expectUntouched();
    expectNoParts();
    if (folder_.has("s.partial.h5")) expectPart("s.partial.h5");
  }
}

TEST_F(Signals, WithoutOlderResultsThoseOfAnInterruptedRunHaveItsName) {
  for (const char* name : {"s.h5", "s.html"}) std::filesystem::remove(folder_.path(name));
  StartedProgram run(folder_, run_);
  run.awaitWork();
  run.signalAfter(0.1, SIGINT);
  EXPECT_EQ(run.wait(), 3);
  expectPart("s.h5");
  EXPECT_TRUE(folder_.has("s.html"));
  EXPECT_EQ(folder_.count(), before_);
}

TEST_F(Signals, ARunThatIsKilledLeavesTheOldFilesAndTheNextRemovesWhatItLeft) {
  for (const double delay : delays) {
    SCOPED_TRACE(delay);
    StartedProgram run(folder_, run_);
    run.awaitWork();
    run.signalAfter(delay, SIGKILL);
    EXPECT_EQ(run.wait(), -SIGKILL);
    expectUntouched();
    EXPECT_EQ(folder_.count(), before_ + 2);  // both parts
  }
  EXPECT_EQ(StartedProgram(folder_, {"run", "s.toml", "--quiet", "-o", "other.h5"}).wait(), 0);
  EXPECT_EQ(folder_.count(), before_ + 2);  // what the other run wrote
}

TEST_F(Signals, ARunThatIsKilledWhileItWritesLeavesOldFilesOrWholeNewOnes) {
  for (const double delay : {0.0, 0.01, 0.02, 0.04, 0.08, 0.12, 0.16, 0.2, 0.3, 0.4}) {
    SCOPED_TRACE(delay);
    StartedProgram run(folder_, {"run", "s.toml", "--force", "--quiet"});
    run.awaitWork();
    run.signalAfter(delay, SIGKILL);
    run.wait();
    EXPECT_EQ(gamut("check s.h5").exitCode, 0);
    EXPECT_THAT(folder_.read("s.html"), ::testing::EndsWith("</html>\n"));
  }
}

TEST_F(Signals, ResultsWhosePageCannotBeWrittenAreKept) {
  StartedProgram run(folder_, {"run", "s.toml", "--samples", "10000000", "-o", "o.h5"}, "out", "error");
  run.awaitWork();
  std::filesystem::remove(folder_.path(".o.html.gamut-part"));
  run.signalAfter(0.1, SIGINT);
  EXPECT_EQ(run.wait(), 4);
  expectPart("o.h5");
  EXPECT_FALSE(folder_.has("o.html"));
  EXPECT_THAT(folder_.read("out"), ::testing::EndsWith("  results: o.h5\n  report:  none was written\n"));
  EXPECT_EQ(
      folder_.read("error"),
      "gamut: o.html: cannot be written; another program removed what was written; o.h5 is written; draw its page "
      "by: gamut report o.h5 -o o.html --force\n");
  EXPECT_EQ(gamut("report o.h5 -o o.html --force").exitCode, 0);
}

TEST_F(Signals, WhatWasFoundIsToldThoughItCannotBeWritten) {
  StartedProgram run(folder_, {"run", "s.toml", "--samples", "10000000", "-o", "o.h5"}, "out", "error");
  run.awaitWork();
  std::filesystem::remove(folder_.path(".o.h5.gamut-part"));
  run.signalAfter(0.1, SIGINT);
  EXPECT_EQ(run.wait(), 4);
  EXPECT_THAT(folder_.read("out"), ::testing::EndsWith("  results: none was written\n  report:  none was written\n"));
  EXPECT_THAT(folder_.read("error"), ::testing::StartsWith("gamut: o.h5: cannot be written; "));
  EXPECT_FALSE(folder_.has("o.html"));
  expectNoParts();
}

TEST_F(Signals, ATerminalThatIsClosedCostsNoResults) {
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_TRUE(terminal >= 0 && ::grantpt(terminal) == 0 && ::unlockpt(terminal) == 0);
  StartedProgram run(folder_, {"run", "s.toml", "--samples", "10000000", "-o", "o.h5"}, "out", ::ptsname(terminal));
  run.awaitWork();
  ::close(terminal);
  run.signalAfter(0.5, SIGINT);  // the bar is drawn anew every 0.1 s
  EXPECT_EQ(run.wait(), 3);
  expectPart("o.h5");
}

TEST_F(Signals, ReadersThatGoAwayCostNoResults) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  const std::string pipe = "/proc/self/fd/" + std::to_string(ends[1]);
  StartedProgram run(folder_, {"run", "s.toml", "--samples", "10000000", "-o", "o.h5"}, pipe, pipe);
  ::close(ends[1]);
  run.awaitWork();
  ::close(ends[0]);
  run.signalAfter(0.1, SIGINT);
  EXPECT_EQ(run.wait(), 4);
  expectPart("o.h5");
  EXPECT_TRUE(folder_.has("o.html"));
}

/// Whoever reads what the program says must not wait for its child, which reads results files for it.
TEST_F(Signals, NobodyKeepsTheOutputOfAProgramThatWasKilled) {
  for (const double delay : delays) {
    SCOPED_TRACE(delay);
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    StartedProgram info(folder_, {"info", "s.h5"}, "/proc/self/fd/" + std::to_string(ends[1]));
    ::close(ends[1]);
    info.awaitBegin();
    info.signalAfter(delay / 10, SIGKILL);
    info.wait();
    pollfd reading{ends[0], POLLIN, 0};
    std::array<char, 4096> text{};
    do ASSERT_EQ(::poll(&reading, 1, 60000), 1) << "somebody keeps it";
    while (::read(ends[0], text.data(), text.size()) > 0);
    ::close(ends[0]);
  }
}

}  // namespace
}  // namespace gamut
